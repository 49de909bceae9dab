#include "jobs/orbit/certified_orbit.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "case/model/loop_of_case.hpp"
#include "holdfast/core/rational.hpp"
#include "holdfast/orbit/event/event_orbit_search.hpp"
#include "holdfast/orbit/orbit_search.hpp"
#include "holdfast/orbit/region_of_attraction.hpp"
#include "io/text/text.hpp"
#include "jobs/charts/conditioning.hpp"
#include "process/errors.hpp"
#include "process/exit.hpp"
#include "process/interrupt.hpp"

namespace holdfast::program {
namespace {

/// How sampling and excitation go together: f τ, as a number and as a fraction where it is one.
struct Ratio {
  std::optional<Rational> fraction;
  double cycles_per_sample;
};

/// Why there is no certificate, as a sentence without its end.
/// @param found  of either model
template <class Result>
std::string reason_for(const Result& found, const Ratio& ratio, std::int64_t largest_period) {
  const std::string looked_at = std::to_string(found.samples) + " samples";
  const std::string period = std::to_string(found.orbit ? found.orbit->period_samples() : 0);
  switch (found.outcome) {
    case OrbitOutcome::incommensurate:
      return "sampling and excitation never coincide: f tau = " +
             format_number(ratio.cycles_per_sample) +
             " is no fraction p/q with q up to 1000000, or the force is a record, or the samples "
             "jitter; so no motion repeats, and the job verdict says what it is";
    case OrbitOutcome::diverges:
      return "the motion diverges, so it comes to no orbit";
    case OrbitOutcome::on_surface:
      return "the motion repeats after " + period +
             " sample(s) but touches a switching surface, so that rounding decides its contacts: "
             "there is no certificate";
    case OrbitOutcome::approaching:
      return "the motion comes near a certified orbit of " + period + " sample(s), but in " +
             looked_at + " not within its radius of capture; a larger --max-period looks longer";
    case OrbitOutcome::not_reproduced:
      return "the contacts repeat, but their exact solution switches otherwise: no orbit in " +
             looked_at + "; the job verdict says more";
    default:
      if (found.samples == 0)
        return "sampling and excitation coincide only every " +
               std::to_string(ratio.fraction->denominator) +
               " samples; give --max-period at least as many";
      return "no periodic orbit of up to " + std::to_string(largest_period) + " samples in " +
             looked_at +
             " of the motion; a larger --max-period looks further, the job verdict weighs "
             "the evidence";
  }
}

template <class Result>
auto certified(Result found, const Ratio& ratio, const OrbitLimits& limits, bool quiet) {
  if (found.outcome != OrbitOutcome::certified)
    throw NoAnswer(reason_for(found, ratio, limits.largest_period));
  report_warning(near_border_warning(found.orbit->border_share()), quiet);
  return std::move(*found.orbit);
}

}  // namespace

PeriodicOrbit certified_orbit(const JobContext& context, std::int64_t largest_period) {
  const IdealLoop<double> loop = ideal_loop_of(context.case_data);
  const OrbitLimits limits{largest_period, 0, throw_if_interrupted};
  return certified(find_periodic_orbit(loop, initial_state_of(context.case_data), limits),
                   {forcing_ratio(loop), loop.excitation.frequency * loop.sampling.period}, limits,
                   context.quiet);
}

EventOrbit certified_orbit(const JobContext& context, const ImplementedLoop& loop,
                           std::int64_t largest_period) {
  const DigitalLoop& digital = loop.digital;
  const Ratio ratio{forcing_ratio(digital),
                    digital.force.harmonics.front().frequency * digital.sampling.period};
  const OrbitLimits limits{largest_period, 0, throw_if_interrupted};
  return with_motion(loop, initial_state_of(context.case_data), [&](const auto& motion) {
    return certified(find_event_orbit(motion, limits), ratio, limits, context.quiet);
  });
}

OrbitCertificate certificate_of(const IdealLoop<double>& loop, const PeriodicOrbit& orbit) {
  const auto points = attraction_balls(loop, orbit);
  double smallest = std::numeric_limits<double>::infinity(), largest = 0.0;
  for (const AttractionBall& point : points) {
    const double radius = attraction_radius(point, point.memory);
    smallest = std::min(smallest, radius);
    largest = std::max(largest, radius);
  }
  return {points.empty() ? 0.0 : smallest, largest, verify_orbit<long double>(loop, orbit)};
}

}  // namespace holdfast::program
