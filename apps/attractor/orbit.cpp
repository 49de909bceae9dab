#include <limits>

#include "case/case_keys.hpp"
#include "case/model/loop_of_case.hpp"
#include "case/model/modal/modes_warning.hpp"
#include "case/model/moving_loop.hpp"
#include "holdfast/math/linalg/multipliers.hpp"
#include "holdfast/orbit/orbit_continuation.hpp"
#include "job.hpp"
#include "jobs/motion/motion_columns.hpp"
#include "jobs/orbit/certified_orbit.hpp"
#include "jobs/orbit/motion_borders.hpp"
#include "jobs/orbit/proved_orbit.hpp"
#include "text/names.hpp"

namespace holdfast::program {
namespace {

struct OrbitQuestion {
  std::int64_t largest_period = OrbitLimits{}.largest_period;
  bool trace = false;
  bool certificate = false;
  std::optional<std::string> follow;
  bool prove = false;
  std::vector<std::string> map;
  Switching switching = Switching::sampled;

  void add_to(const Job& job) {
    job.add("--max-period", largest_period);
    job.add("--trace", trace);
    job.add("--certificate", certificate);
    job.add("--follow", follow);
    job.add("--prove", prove);
    job.add("--map", map);
    job.add("--switching", switching);
  }
  void run(const JobContext& context) const;
};

/// Sets the margins to NaN (unknown): those of switching between samples are meaningless for a law
/// that switches at samples only.
void forget_margins(PeriodicOrbit& /*orbit*/) {}
void forget_margins(EventOrbit& orbit) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  orbit.margins = {unknown, unknown, unknown, unknown, unknown, unknown};
}

/// Calls `visit` with the motion's loop and its certified orbit, in the model of the case.
template <class Visit>
void with_orbit(const JobContext& context, const OrbitQuestion& options, const Visit& visit) {
  const std::string& law = context.case_data.backlash.law;
  const bool at_samples =
      options.switching == Switching::sampled && (law == "immediate" || law == "play");
  report_warning(dense_work_warning(context.case_data, options.switching), context.quiet);
  const auto certify = [&](const auto& moving) {
    auto orbit = certified_orbit(context, moving, options.largest_period);
    if (at_samples) forget_margins(orbit);
    visit(moving, orbit);
  };
  std::visit(certify, smooth_loop_of(context.case_data, options.switching));
}

double border_distance(const PeriodicOrbit& orbit) { return orbit.borders.displacement.distance; }
/// Smallest distance (m) from a reversal inside the gap to the ends of the gap.
double border_distance(const EventOrbit& orbit) { return orbit.margins.border_distance; }

void write_orbit(const JobContext& context, const OrbitQuestion& options) {
  Table table(context, columns_of("orbit"));
  with_orbit(context, options, [&](const auto&, const auto& orbit) {
    table.row(orbit.period_samples(), orbit.period(), orbit.forcing_periods(),
              orbit.largest_multiplier(), orbit.closure_error, border_distance(orbit),
              orbit.engaged_fraction());
  });
  table.commit();
}

/// Writes period, amplitude, engaged share and closure error of an orbit.
/// @param amplitude  largest displacement (m)
template <class Orbit>
void write_size(Table& table, const Orbit& orbit, double amplitude) {
  table.row("coincidence_samples", static_cast<double>(orbit.ratio.denominator), "");
  table.row("coincidence_forcing_periods", static_cast<double>(orbit.ratio.numerator), "");
  table.row("period_samples", static_cast<double>(orbit.period_samples()), "");
  table.row("period", orbit.period(), "s");
  table.row("forcing_periods", static_cast<double>(orbit.forcing_periods()), "");
  table.row("amplitude", amplitude, "m");
  table.row("engaged_fraction", orbit.engaged_fraction(), "");
  table.row("closure_error", orbit.closure_error, "m");
}

/// Writes modulus, angle and exponent per sample of each multiplier of an orbit.
template <class Orbit>
void write_multipliers(Table& table, const Orbit& orbit) {
  int number = 1;
  for (const Multiplier& multiplier : orbit.multipliers) {
    const std::string name = "multiplier_" + std::to_string(number++);
    table.row(name + "_modulus", std::abs(multiplier.value()), "");
    table.row(name + "_angle", multiplier.angle, "rad");
    table.row(name + "_exponent",
              multiplier.log_modulus / static_cast<double>(orbit.period_samples()), "per sample");
  }
}

void write_border(Table& table, const std::string& name, const Border& border, const char* unit,
                  double sampling_period) {
  table.row(name, border.distance, unit);
  const bool there = border.sample >= 0;
  table.row(name + "_at",
            there ? static_cast<double>(border.sample) * sampling_period : std::nan(""), "s");
}

void write_radii(Table& table, const CaptureRadii& radii) {
  table.row("capture_radius_smallest", radii.smallest, "m");
  table.row("capture_radius_largest", radii.largest, "m");
}

/// Writes period and size of an orbit, and its distances to the two switching surfaces with the
/// times at which it is nearest to them.
void write_distances(Table& table, const PeriodicOrbit& orbit) {
  write_size(table, orbit, orbit.amplitude());
  write_border(table, "gap_distance", orbit.borders.displacement, "m", orbit.sampling_period);
  write_border(table, "reversal_distance", orbit.borders.velocity, "m/s", orbit.sampling_period);
}
void write_quantities(Table& table, const SampledModes& moving, const PeriodicOrbit& orbit) {
  write_distances(table, orbit);
  write_radii(table, capture_radii_of(moving.loop, orbit));
  write_multipliers(table, orbit);
}
void write_quantities(Table& table, const SampledMasses& moving, const PeriodicOrbit& orbit) {
  write_distances(table, orbit);
  write_radii(table, capture_radii_of(moving.loop, orbit));
  write_multipliers(table, orbit);
  const OrbitVerification wide = verify_orbit<long double>(moving.loop, orbit);
  table.row("extended_precision_same_contacts", wide.same_itinerary ? 1.0 : 0.0, "");
  table.row("extended_precision_displacement_difference", wide.displacement_difference, "m");
  table.row("extended_precision_velocity_difference", wide.velocity_difference, "m/s");
  table.row("extended_precision_closure_error", wide.closure_error, "m");
}

/// Writes margins, time share and number of phases of each contact mode, and the multipliers.
template <class Built>
void write_quantities(Table& table, const Built&, const EventOrbit& orbit) {
  write_size(table, orbit, orbit.largest_displacement);
  const SwitchingMargins& margins = orbit.margins;
  table.row("gap_distance", margins.border_distance, "m");
  table.row("exit_velocity", margins.exit_velocity, "m/s");
  table.row("reversal_velocity", margins.reversal_velocity, "m/s");
  table.row("reversal_acceleration", margins.reversal_acceleration, "m/s2");
  table.row("stick_acceleration", margins.stick_acceleration, "m/s2");
  for (const ContactMode mode : {ContactMode::engaged, ContactMode::gap, ContactMode::stick}) {
    const std::string name = word_for(mode);
    table.row(name + "_time_share", orbit.time_share[static_cast<std::size_t>(mode)], "");
    table.row(name + "_phases", static_cast<double>(orbit.entries(mode)), "");
  }
  write_multipliers(table, orbit);
}

/// Writes the certificate of the orbit, one quantity per row.
void write_certificate(const JobContext& context, const OrbitQuestion& options) {
  Table table(context, columns_of("certificate"));
  with_orbit(context, options, [&](const auto& moving, const auto& orbit) {
    write_quantities(table, moving, orbit);
  });
  table.commit();
}

/// Sample j of the orbit; its index and time are 0.
EventSample sample_of(const PeriodicOrbit& orbit, std::size_t j) {
  const bool engaged = orbit.itinerary[j] != 0;
  const double force = orbit.states[(j + 1) % orbit.states.size()][4];
  return {{0, 0.0, orbit.states[j].head<4>(), force, engaged},
          engaged ? ContactMode::engaged : ContactMode::gap};
}
EventSample sample_of(const EventOrbit& orbit, std::size_t j) {
  const ContactMode mode = orbit.modes[j];
  return {{0, 0.0, orbit.states[j], orbit.forces[j], mode == ContactMode::engaged}, mode};
}

/// Writes the samples of one period, and the first one again, with the columns of `simulate`.
void write_orbit_trace(const JobContext& context, const OrbitQuestion& options) {
  Table table(context, motion_columns(options.switching));
  with_orbit(context, options, [&](const auto&, const auto& orbit) {
    for (std::size_t k = 0; k <= orbit.states.size(); ++k) {
      EventSample row = sample_of(orbit, k % orbit.states.size());
      row.time = static_cast<double>(k) * orbit.sampling_period;
      write_motion_row(table, options.switching, row);
    }
  });
  table.commit();
}

constexpr Named<BranchEndOutcome> branch_end_names[] = {
    {BranchEndOutcome::border_collision, "border_collision"},
    {BranchEndOutcome::unit_circle, "unit_circle"},
    {BranchEndOutcome::range_end, "range_end"}};

/// Writes two rows: the values of a key, below and above the case's, at which the orbit ends.
/// @param axis  KEY=MIN:MAX
void write_branch_ends(const JobContext& context, std::int64_t largest_period,
                       const std::string& axis) {
  const auto [key, range, value] = followed_key(context.case_data, "--follow", axis);
  Table table(context, columns_of("branch ends"));
  const PeriodicOrbit orbit =
      certified_orbit(context, sampled_masses_of(context.case_data), largest_period);
  const auto path = [&, name = key](double position) {
    return ideal_loop_of(case_with(context.case_data, name, position));
  };
  for (const bool above : {false, true}) {
    const BranchEnd end = continue_orbit(path, orbit, value, above ? range.max : range.min);
    const bool collides = end.outcome == BranchEndOutcome::border_collision;
    table.row(above ? "above" : "below", name_in(branch_end_names, end.outcome), end.parameter,
              std::abs(end.parameter - value),
              collides ? name_in(surface_names, end.border.surface) : "", end.border.sample,
              std::abs(end.multiplier.value()), end.multiplier.angle);
  }
  table.commit();
}

/// Writes the period of a proved orbit, the bound of its multipliers and the errors of its states.
template <class Orbit>
void write_proved_errors(Table& table, const Orbit& orbit, const ProvedBounds& proof) {
  table.row("period_samples", static_cast<double>(orbit.period_samples()), "");
  table.row("period", orbit.period(), "s");
  table.row("multiplier_bound", proof.multiplier_bound, "");
  table.row("displacement_error", proof.displacement_error, "m");
  table.row("velocity_error", proof.velocity_error, "m/s");
}

/// Writes the results of the orbit's proof for switching at samples, one quantity per row.
void write_proof(const JobContext& context, std::int64_t largest_period) {
  Table table(context, columns_of("certificate"));
  const PeriodicOrbit orbit =
      certified_orbit(context, sampled_masses_of(context.case_data), largest_period);
  const OrbitProof proof = proved_orbit_of(context.case_data, orbit);
  const bool reverses = proof.nearest.surface == SwitchingSurface::reversal;
  write_proved_errors(table, orbit, proof);
  table.row("attraction_radius", proof.radius, "m");
  table.row("backlash_width_from", proof.widths.from, "m");
  table.row("backlash_width_to", proof.widths.to, "m");
  write_border(table, "nearest_decision", proof.nearest, reverses ? "m/s" : "m",
               orbit.sampling_period);
  table.row("nearest_decided_by", proof.decided_by, "errors");
  table.commit();
}

/// Writes the results of the orbit's proof for exact switching, one quantity per row.
void write_event_proof(const JobContext& context, std::int64_t largest_period) {
  Table table(context, columns_of("certificate"));
  const auto found = certified_event_orbit(
      context, std::get<BuiltMasses>(built_loop_of(context.case_data, {Switching::exact})),
      largest_period);
  const EventOrbitProof proof =
      proved_orbit_of(exactly_switched_loop_of(context.case_data).value(), found);
  const ContactTest& nearest = proof.nearest;
  const bool there = nearest.sample >= 0;
  write_proved_errors(table, *found.orbit, proof);
  table.row("instant_error", proof.instant_error, "s");
  table.row("attraction_radius", proof.radius, "m");
  table.row("nearest_decision", nearest.distance, unit_of(nearest));
  table.row(
      "nearest_decision_at",
      there ? static_cast<double>(nearest.sample) * found.orbit->sampling_period + nearest.instant
            : std::nan(""),
      "s");
  table.row("nearest_decided_by", there ? nearest.decided_by() : HUGE_VAL, "errors");
  table.commit();
}

/// Writes the ranges of one key in which the orbit is proved, one range per row.
/// @param axis  KEY=MIN:MAX
void write_proved_ranges(const JobContext& context, std::int64_t largest_period,
                         const std::string& axis) {
  const FollowedKey key = followed_key(context.case_data, "--follow", axis);
  Table table(context, columns_of("proved ranges"));
  const PeriodicOrbit orbit =
      certified_orbit(context, sampled_masses_of(context.case_data), largest_period);
  for (const auto& [from, to, proof] :
       proved_orbit_along(context.case_data, orbit, key.name, key.range)) {
    const bool decides = proof.nearest.sample >= 0;
    const bool proved = proof.outcome == OrbitProofOutcome::proved;
    table.row(from, to, proved ? "proved" : "not_shown",
              proved || decides ? proof.decided_by : std::nan(""),
              decides ? name_in(surface_names, proof.nearest.surface) : "", proof.nearest.sample,
              proved ? "" : name_in(orbit_proof_names, proof.outcome));
  }
  table.commit();
}

void OrbitQuestion::run(const JobContext& context) const {
  if (!map.empty()) return write_motion_borders(context, map, largest_period, switching);
  if (prove && !follow && switching == Switching::exact)
    return write_event_proof(context, largest_period);
  if (prove) {
    follow ? write_proved_ranges(context, largest_period, *follow)
           : write_proof(context, largest_period);
  } else if (trace) {
    write_orbit_trace(context, *this);
  } else if (certificate) {
    write_certificate(context, *this);
  } else if (follow) {
    write_branch_ends(context, largest_period, *follow);
  } else {
    write_orbit(context, *this);
  }
}

}  // namespace

void add_orbit(CLI::App& program) { add_job<OrbitQuestion>(program, "orbit"); }

}  // namespace holdfast::program
