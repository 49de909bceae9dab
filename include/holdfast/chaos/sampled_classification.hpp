#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include "holdfast/chaos/chaos_indicators.hpp"
#include "holdfast/chaos/classification.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/motion/ideal_loop.hpp"
#include "holdfast/orbit/orbit_search.hpp"

namespace holdfast {

/// What a motion of the sampled loop with backlash is, with its certificate or the indicators.
struct SampledClassification {
  Classification classification;  ///< what the motion is, and what that rests on
  OrbitResult search;             ///< the orbit, where there is one
  ChaosIndicators indicators;     ///< of a certified orbit its period and its exponent alone
};

namespace detail {

/// How a sampled loop is looked at: as many samples as the 0–1 test wants forcing periods for.
/// @param cycles  f τ, periods of the forcing in a sample, > 0
inline IndicatorOptions indicator_options(double cycles) {
  IndicatorOptions options;
  const double samples_of_period = std::clamp(std::round(1.0 / cycles), 1.0, 200.0);
  options.zero_one_stride = static_cast<std::int64_t>(samples_of_period);
  options.samples = std::clamp<std::int64_t>(1008 * options.zero_one_stride, 20160, 100000);
  options.transient = options.samples;
  options.base_frequency = cycles;
  return options;
}

/// The indicators of a motion from its samples.
template <class Scalar>
ChaosIndicators indicators_of_motion(const IdealLoop<Scalar>& loop,
                                     const Vector<double, 4>& initial_state,
                                     const IndicatorOptions& options) {
  auto motion = harmonically_forced_motion(loop, initial_state);
  const Matrix<double, 5> maps[] = {motion.loop().backlash_map(),
                                    motion.loop().engaged_map(loop.gains)};
  bool engaged = true;
  const auto advance = [&](Vector<double, 5>& state) {
    engaged = motion.sense().engaged;
    motion.advance();
    state << motion.state(), motion.memory().previous_force;
  };
  const auto displacement = [](const Vector<double, 5>& state) { return state[0]; };
  const auto tangent = [&](const Vector<double, 5>&) { return maps[engaged ? 1 : 0]; };
  const auto contact = [&] { return engaged; };
  Vector<double, 5> first;
  first << initial_state, 0.0;
  ChaosIndicators indicators =
      chaos_indicators<5>(first, advance, displacement, options, tangent, contact);
  if (loop.excitation.amplitude > 0.0)
    indicators.forcing_periods = options.base_frequency * static_cast<double>(options.samples);
  return indicators;
}

/// @tparam Orbit  PeriodicOrbit or EventOrbit
template <class Orbit>
ChaosIndicators indicators_of_orbit(const Orbit& orbit) {
  ChaosIndicators indicators;
  indicators.certified_period = orbit.period_samples();
  const double samples = static_cast<double>(orbit.period_samples());
  indicators.largest_exponent =
      ExponentEstimate{orbit.multipliers.front().log_modulus / samples, 0.0, "sample"};
  return indicators;
}

/// @param shown  what it shows of the orbit's contacts
template <class Orbit>
std::string certificate_text(const Orbit& orbit, const std::string& shown) {
  const auto counted = [](std::int64_t count, const char* what) {
    return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
  };
  std::string text = "Certified orbit of " + counted(orbit.period_samples(), "sample");
  if (orbit.forcing_periods() > 0)
    text += ", " + counted(orbit.forcing_periods(), "forcing period");
  const double modulus = orbit.largest_multiplier();
  text += ": " + shown + ", its largest multiplier is " +
          (modulus > 0.0 ? IndicatorText::number(modulus)
                         : "e^" + IndicatorText::number(orbit.multipliers.front().log_modulus)) +
          ", and it closes to " + IndicatorText::number(orbit.closure_error) + " in m and m/s.";
  return text;
}

/// Takes the classification from the search where that has certified an orbit or seen the motion
/// diverge.
/// @tparam Found  SampledClassification or EventClassification, its search done
/// @param shown   what a certificate shows of the orbit's contacts
/// @return whether it has
template <class Found>
bool is_decided_by_search(Found& found, const std::string& shown) {
  const bool certified = found.search.outcome == OrbitOutcome::certified;
  if (!certified && found.search.outcome != OrbitOutcome::diverges) return false;
  if (certified)
    found.indicators = indicators_of_orbit(*found.search.orbit);
  else
    found.indicators.diverged_at = found.search.samples;
  found.classification = classify(found.indicators);
  if (certified) found.classification.rests_on = certificate_text(*found.search.orbit, shown);
  return true;
}

}  // namespace detail

/// Says what a motion is: by the exact orbit that it comes to, or, where none is found, by the
/// indicators of its samples.
///
///     classify_motion(loop, Vector<double, 4>::Zero()).classification.kind;   //
///     AttractorType::periodic
///
/// @param loop           the loop with its excitation and backlash
/// @param initial_state  [z₁, ż₁, z₂, ż₂] (m, m/s), finite
/// @param limits         of the search for an orbit
/// Work: that of find_periodic_orbit() and of chaos_indicators() for up to 10⁵ samples.
/// @throws InvalidParameter where one of them is not admissible
template <class Scalar>
SampledClassification classify_motion(const IdealLoop<Scalar>& loop,
                                      const Vector<double, 4>& initial_state,
                                      const OrbitLimits& limits = {}) {
  SampledClassification found{{}, find_periodic_orbit(loop, initial_state, limits), {}};
  if (detail::is_decided_by_search(found, "it reproduces its own contacts")) return found;
  IndicatorOptions options =
      detail::indicator_options(loop.excitation.frequency * loop.sampling.period);
  options.forcing_incommensurate = found.search.outcome == OrbitOutcome::incommensurate;
  found.indicators = detail::indicators_of_motion(loop, initial_state, options);
  found.classification = classify(found.indicators);
  return found;
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template SampledClassification classify_motion(const IdealLoop<double>&,
                                                      const Vector<double, 4>&, const OrbitLimits&);
#endif

}  // namespace holdfast
