#include "jobs/orbit/event_orbit_tables.hpp"

#include <optional>

#include "case/model/loop_of_case.hpp"
#include "holdfast/motion/implemented_loop.hpp"
#include "holdfast/orbit/event/event_orbit_search.hpp"
#include "io/text/table.hpp"
#include "jobs/charts/conditioning.hpp"
#include "jobs/motion/motion_columns.hpp"
#include "jobs/orbit/orbit_failure.hpp"
#include "jobs/orbit/orbit_rows.hpp"
#include "process/errors.hpp"
#include "process/exit.hpp"
#include "process/interrupt.hpp"

namespace holdfast::program {
namespace {

/// f τ of the first harmonic.
double cycles_per_sample(const ImplementedLoop& loop) {
  return loop.digital.force.harmonics.front().frequency * loop.digital.sampling.period;
}

void write_margins(QuantityRows& rows, const SwitchingMargins& margins) {
  rows.row("gap_distance", margins.border_distance, "m");
  rows.row("exit_velocity", margins.exit_velocity, "m/s");
  rows.row("reversal_velocity", margins.reversal_velocity, "m/s");
  rows.row("reversal_acceleration", margins.reversal_acceleration, "m/s2");
  rows.row("stick_acceleration", margins.stick_acceleration, "m/s2");
}

void write_modes(QuantityRows& rows, const EventOrbit& orbit) {
  for (const ContactMode mode : {ContactMode::engaged, ContactMode::gap, ContactMode::stick}) {
    const std::string name = word_for(mode);
    rows.row(name + "_time_share", orbit.time_share[static_cast<std::size_t>(mode)]);
    rows.row(name + "_phases", static_cast<double>(orbit.entries(mode)));
  }
}

}  // namespace

EventOrbit certified_orbit(const JobContext& context, const ImplementedLoop& loop,
                           std::int64_t largest_period) {
  const std::optional<Rational> ratio = forcing_ratio(loop.digital);
  const OrbitLimits limits{largest_period, 0, throw_if_interrupted};
  return with_motion(loop, initial_state_of(context.case_data), [&](const auto& motion) {
    auto found = find_event_orbit(motion, limits);
    if (found.outcome != OrbitOutcome::certified) {
      throw NoAnswer(reason_for(failure_of(found, ratio, cycles_per_sample(loop), largest_period)));
    }
    report_warning(near_border_warning(found.orbit->border_share()), context.quiet);
    return *found.orbit;
  });
}

void write_orbit(const JobContext& context, const ImplementedLoop& loop,
                 std::int64_t largest_period) {
  Table table(context, orbit_columns());
  const EventOrbit orbit = certified_orbit(context, loop, largest_period);
  table.row(orbit.period_samples(), orbit.period(), orbit.forcing_periods(),
            orbit.largest_multiplier(), orbit.closure_error, orbit.margins.border_distance,
            orbit.engaged_fraction());
  table.commit();
}

void write_certificate(const JobContext& context, const ImplementedLoop& loop,
                       std::int64_t largest_period) {
  Table table(context, certificate_columns());
  const EventOrbit orbit = certified_orbit(context, loop, largest_period);
  QuantityRows rows(table);
  write_orbit_rows(rows, orbit, orbit.largest_displacement);
  write_margins(rows, orbit.margins);
  write_modes(rows, orbit);
  write_multipliers(rows, orbit.multipliers, orbit.period_samples());
  table.commit();
}

void write_orbit_trace(const JobContext& context, const ImplementedLoop& loop,
                       std::int64_t largest_period) {
  Table table(context, motion_columns(loop.switching));
  const EventOrbit orbit = certified_orbit(context, loop, largest_period);
  const std::size_t samples = orbit.states.size();
  for (std::size_t k = 0; k <= samples; ++k) {
    const std::size_t j = k % samples;
    MotionRow row{static_cast<double>(k) * orbit.sampling_period, orbit.states[j], orbit.forces[j],
                  orbit.modes[j]};
    write_motion_row(table, loop.switching, row);
  }
  table.commit();
}

}  // namespace holdfast::program
