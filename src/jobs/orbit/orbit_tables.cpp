#include "jobs/orbit/orbit_tables.hpp"

#include <cmath>
#include <utility>

#include "case/axes/axis.hpp"
#include "case/case_keys.hpp"
#include "case/model/loop_of_case.hpp"
#include "holdfast/math/linalg/multipliers.hpp"
#include "holdfast/orbit/orbit_continuation.hpp"
#include "holdfast/orbit/orbit_search.hpp"
#include "io/text/table.hpp"
#include "io/text/text.hpp"
#include "jobs/charts/conditioning.hpp"
#include "jobs/motion/motion_columns.hpp"
#include "jobs/orbit/orbit_certificate.hpp"
#include "jobs/orbit/orbit_failure.hpp"
#include "jobs/orbit/orbit_rows.hpp"
#include "process/errors.hpp"
#include "process/exit.hpp"
#include "process/interrupt.hpp"

namespace holdfast::program {
namespace {

const char* word_for(SwitchingSurface surface) {
  switch (surface) {
    case SwitchingSurface::reversal:
      return "reversal";
    case SwitchingSurface::gap_lower:
      return "gap_lower";
    case SwitchingSurface::gap_upper:
      return "gap_upper";
  }
  return "";
}

void write_border(QuantityRows& rows, const std::string& name, const Border& border,
                  const char* unit, double sampling_period) {
  rows.row(name, border.distance, unit);
  const bool there = border.sample >= 0;
  rows.row(name + "_at",
           there ? static_cast<double>(border.sample) * sampling_period : std::nan(""), "s");
}

void write_verification(QuantityRows& rows, const OrbitVerification& verification) {
  rows.row("extended_precision_same_contacts", verification.same_itinerary ? 1.0 : 0.0);
  rows.row("extended_precision_displacement_difference", verification.displacement_difference, "m");
  rows.row("extended_precision_velocity_difference", verification.velocity_difference, "m/s");
  rows.row("extended_precision_closure_error", verification.closure_error, "m");
}

struct KeyRange {
  std::string key;
  Range range;
};

KeyRange parse_key_range(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) throw WrongInput("--follow " + text + ": expected KEY=MIN:MAX");
  return {text.substr(0, equals), parse_range("--follow", text.substr(equals + 1))};
}

bool moves_the_orbit(const std::string& key) {
  const bool of_the_loop = key == "control.proportional_gain" ||
                           key == "control.differential_gain" || key == "control.processing_delay";
  return of_the_loop || key.rfind("plant.", 0) == 0 || key == "backlash.width" ||
         key == "excitation.amplitude";
}

/// The case's value of the key, which the orbit can be followed along within the range.
double followed_value(const Case& the_case, const std::string& key, const std::string& axis,
                      const Range& range) {
  const double value = case_value(the_case, key);
  if (key == "control.sampling_period" || key == "excitation.frequency")
    throw WrongInput("--follow " + key +
                     ": another value changes how sampling and excitation coincide, so the orbit "
                     "cannot be followed along it");
  if (!moves_the_orbit(key))
    throw WrongInput(
        "--follow " + key +
        ": expected control.proportional_gain, differential_gain or processing_delay, a key "
        "of [plant], backlash.width or excitation.amplitude");
  const CaseKey& known = *find_case_key(key);
  for (const double end : {range.min, range.max}) {
    if (!known.range.contains(end))
      throw WrongInput("--follow " + axis + ": " + key + " must be " + known.admissible());
  }
  if (!(range.min <= value && value <= range.max))
    throw WrongInput("--follow " + axis + ": the case's " + key + " = " + format_number(value) +
                     " lies outside");
  if (key == "backlash.width" && value == 0.0)
    throw WrongInput(
        "--follow backlash.width: the case has no backlash, where the rule is another one; set a "
        "width greater than 0 m");
  return value;
}

const char* word_for(const BranchEnd& end) {
  switch (end.outcome) {
    case BranchEndOutcome::border_collision:
      return "border_collision";
    case BranchEndOutcome::unit_circle:
      return "unit_circle";
    case BranchEndOutcome::range_end:
      return "range_end";
  }
  return "";
}

}  // namespace

PeriodicOrbit certified_orbit(const JobContext& context, std::int64_t largest_period) {
  const IdealLoop<double> loop = ideal_loop_of(context.case_data);
  OrbitResult found = find_periodic_orbit(loop, initial_state_of(context.case_data),
                                          {largest_period, 0, throw_if_interrupted});
  if (found.outcome != OrbitOutcome::certified) {
    throw NoAnswer(
        reason_for(failure_of(found, forcing_ratio(loop),
                              loop.excitation.frequency * loop.sampling.period, largest_period)));
  }
  report_warning(near_border_warning(found.orbit->border_share()), context.quiet);
  return std::move(*found.orbit);
}

void write_orbit(const JobContext& context, std::int64_t largest_period) {
  Table table(context, orbit_columns());
  const PeriodicOrbit orbit = certified_orbit(context, largest_period);
  table.row(orbit.period_samples(), orbit.period(), orbit.forcing_periods(),
            orbit.largest_multiplier(), orbit.closure_error, orbit.borders.displacement.distance,
            orbit.engaged_fraction());
  table.commit();
}

void write_certificate(const JobContext& context, std::int64_t largest_period) {
  Table table(context, certificate_columns());
  const IdealLoop<double> loop = ideal_loop_of(context.case_data);
  const PeriodicOrbit orbit = certified_orbit(context, largest_period);
  QuantityRows rows(table);
  write_orbit_rows(rows, orbit, orbit.amplitude());
  write_border(rows, "gap_distance", orbit.borders.displacement, "m", orbit.sampling_period);
  write_border(rows, "reversal_distance", orbit.borders.velocity, "m/s", orbit.sampling_period);
  const OrbitCertificate certificate = certificate_of(loop, orbit);
  rows.row("capture_radius_smallest", certificate.smallest_radius, "m");
  rows.row("capture_radius_largest", certificate.largest_radius, "m");
  write_multipliers(rows, orbit.multipliers, orbit.period_samples());
  write_verification(rows, certificate.verification);
  table.commit();
}

void write_orbit_trace(const JobContext& context, std::int64_t largest_period) {
  Table table(context, motion_columns());
  const PeriodicOrbit orbit = certified_orbit(context, largest_period);
  const std::size_t samples = orbit.states.size();
  for (std::size_t k = 0; k <= samples; ++k) {
    const std::size_t j = k % samples;
    write_motion_row(table, Switching::sampled,
                     {static_cast<double>(k) * orbit.sampling_period, orbit.states[j].head<4>(),
                      orbit.states[(k + 1) % samples][4],
                      orbit.itinerary[j] != 0 ? ContactMode::engaged : ContactMode::gap});
  }
  table.commit();
}

void write_branch_ends(const JobContext& context, std::int64_t largest_period,
                       const std::string& axis) {
  const auto [key, range] = parse_key_range(axis);
  const double value = followed_value(context.case_data, key, axis, range);
  Table table(context, {{"side", "", "below or above the case's value", "string"},
                        {"outcome", "",
                         "border_collision: a sample reaches a switching surface; unit_circle: a "
                         "multiplier does; range_end: neither",
                         "string"},
                        {"position", "", "of the key, in its unit"},
                        {"distance", "", "from the case's value"},
                        {"surface", "", "reversal, gap_lower or gap_upper", "string"},
                        {"sample", "", "of the orbit; -1 without a collision", "integer"},
                        {"largest_multiplier", "", "modulus there"},
                        {"multiplier_angle_rad", "rad", "0: fold, pi: flip, else a pair"}});
  const PeriodicOrbit orbit = certified_orbit(context, largest_period);
  const auto path = [&, name = key](double position) {
    return ideal_loop_with(context.case_data, name, position);
  };
  for (const bool above : {false, true}) {
    const BranchEnd end = continue_orbit(path, orbit, value, above ? range.max : range.min);
    const bool collides = end.outcome == BranchEndOutcome::border_collision;
    table.row(above ? "above" : "below", word_for(end), end.parameter,
              std::abs(end.parameter - value), collides ? word_for(end.border.surface) : "",
              end.border.sample, std::abs(end.multiplier.value()), end.multiplier.angle);
  }
  table.commit();
}

}  // namespace holdfast::program
