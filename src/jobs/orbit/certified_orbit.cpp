#include "jobs/orbit/certified_orbit.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <string>

#include "case/model/conditioning.hpp"
#include "case/model/plant_of_case.hpp"
#include "holdfast/core/rational.hpp"
#include "holdfast/orbit/modal/modal_itinerary_maps.hpp"
#include "holdfast/orbit/modal/modal_orbit_search.hpp"
#include "holdfast/orbit/region_of_attraction.hpp"
#include "holdfast/plant/plant_poles.hpp"
#include "jobs/job_texts.hpp"
#include "process/errors.hpp"
#include "process/exit.hpp"
#include "process/interrupt.hpp"
#include "text/names.hpp"
#include "text/text.hpp"

namespace holdfast::program {
namespace {

constexpr Named<OrbitOutcome> reasons[] = {{OrbitOutcome::incommensurate, "incommensurate"},
                                           {OrbitOutcome::diverges, "diverges"},
                                           {OrbitOutcome::on_surface, "on surface"},
                                           {OrbitOutcome::approaching, "approaching"},
                                           {OrbitOutcome::not_reproduced, "not reproduced"},
                                           {OrbitOutcome::none_found, "none found"},
                                           {OrbitOutcome::neutral, "neutral"}};

/// Reason why an orbit has no certificate, as a sentence without its full stop.
/// @param found   search result for switching at samples or for exact switching
/// @param cycles  f τ, periods of the excitation per sample
/// @param ratio   f τ as a fraction; nullopt if it is irrational
template <class Result>
std::string reason_for(const Result& found, double cycles, const std::optional<Rational>& ratio,
                       std::int64_t largest_period) {
  const bool unlooked = found.outcome == OrbitOutcome::none_found && found.samples == 0;
  const std::int64_t coincidence = ratio ? ratio->denominator : 0;
  return text_of(
      job_texts()["no orbit"][unlooked ? "not looked for" : name_in(reasons, found.outcome)],
      {{"cycles", format_number(cycles)},
       {"period", std::to_string(found.orbit ? found.orbit->period_samples() : 0)},
       {"samples", std::to_string(found.samples)},
       {"state", std::to_string(found.neutral_state.value_or(0) + 1)},
       {"coincidence", std::to_string(coincidence)},
       {"longest", std::to_string(largest_period)}});
}

/// Result of the search for a motion's orbit; throws NoAnswer where it is not certified.
template <class Moving>
auto certified_result(const JobContext& context, const Moving& moving,
                      std::int64_t largest_period) {
  auto found = orbit_of(moving, {largest_period, 0, throw_if_interrupted});
  if (found.outcome != OrbitOutcome::certified) {
    const auto& clock = clock_of(moving);
    const double frequency = motion_excitation_of(context.case_data).frequency;
    throw NoAnswer(
        reason_for(found, frequency * clock.sampling.period, forcing_ratio(clock), largest_period));
  }
  report_warning(near_border_warning(found.orbit->border_share()), context.quiet);
  return found;
}

/// Keeps the ten largest multipliers.
void keep_largest(std::vector<Multiplier>& multipliers) {
  constexpr std::size_t most = 10;
  if (multipliers.size() > most) multipliers.resize(most);
}

/// Orbit with states of conductor and absorber at the absorber's place instead of all plant states.
template <class Readings>
EventOrbit as_seen(const EventOrbitOf<Eigen::Dynamic>& orbit, const Readings& readings) {
  EventOrbit seen{};
  seen.ratio = orbit.ratio;
  seen.sampling_period = orbit.sampling_period;
  seen.states.reserve(orbit.states.size());
  for (const auto& state : orbit.states) seen.states.push_back(readings.both_sides(state));
  seen.multipliers = orbit.multipliers;
  keep_largest(seen.multipliers);
  seen.closure_error = orbit.closure_error;
  seen.modes = orbit.modes;
  seen.forces = orbit.forces;
  seen.switches = orbit.switches;
  seen.reversals = orbit.reversals;
  seen.margins = orbit.margins;
  seen.time_share = orbit.time_share;
  seen.largest_displacement = orbit.largest_displacement;
  seen.largest_sample = orbit.largest_sample;
  seen.extent = orbit.extent;
  return seen;
}

}  // namespace

PeriodicOrbit certified_orbit(const JobContext& context, const SampledMasses& moving,
                              std::int64_t largest_period) {
  return *certified_result(context, moving, largest_period).orbit;
}

EventOrbit certified_orbit(const JobContext& context, const BuiltMasses& moving,
                           std::int64_t largest_period) {
  return *certified_result(context, moving, largest_period).orbit;
}

EventOrbitResult<DriveContact<>> certified_event_orbit(const JobContext& context,
                                                       const BuiltMasses& moving,
                                                       std::int64_t largest_period) {
  return certified_result(context, moving, largest_period);
}

PeriodicOrbit certified_orbit(const JobContext& context, const SampledModes& moving,
                              std::int64_t largest_period) {
  PeriodicOrbit orbit = *certified_result(context, moving, largest_period).orbit;
  keep_largest(orbit.multipliers);
  return orbit;
}

EventOrbit certified_orbit(const JobContext& context, const BuiltPlant& moving,
                           std::int64_t largest_period) {
  return as_seen(*certified_result(context, moving, largest_period).orbit,
                 motion_of(moving).readings());
}

CaptureRadii capture_radii_of(const ModalLoop& loop, const PeriodicOrbit& orbit) {
  const ModalItineraryMaps maps(loop, plant_poles(loop.modes, loop.absorber), orbit.ratio);
  const auto region = modal_attraction(loop, maps, orbit);
  if (!region) return {0.0, 0.0};
  const double clearance = region->stays_inside ? std::min(region->lowest - orbit.memory.lower,
                                                           orbit.memory.upper - region->highest)
                                                : 1.0;
  const double radius = region->radius * clearance;
  return {radius * region->inscribed_share, radius};
}

CaptureRadii capture_radii_of(const IdealLoop<double>& loop, const PeriodicOrbit& orbit) {
  const auto points = attraction_balls(loop, orbit);
  double smallest = std::numeric_limits<double>::infinity(), largest = 0.0;
  for (const AttractionBall& point : points) {
    const double radius = attraction_radius(point, point.memory);
    smallest = std::min(smallest, radius);
    largest = std::max(largest, radius);
  }
  return {points.empty() ? 0.0 : smallest, largest};
}

}  // namespace holdfast::program
