#pragma once

#include <cmath>
#include <functional>
#include <optional>
#include <vector>

#include "holdfast/control/gains.hpp"
#include "holdfast/control/loop_input.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/core/interval.hpp"
#include "holdfast/core/interval_sets.hpp"
#include "holdfast/plant/linear_plant.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "holdfast/stability/margins/loop_form.hpp"
#include "holdfast/stability/response/response.hpp"

namespace holdfast {

/// What a sampling period must allow to count as feasible.
enum class DelayCriterion {
  stable,      ///< some differential gain stabilises the loop
  attenuates,  ///< τ < 1/(2f), so that the samples show the vibration, and some stabilising
               ///< differential gain brings the steady amplitude below that of no
               ///< control
};

/// A question about the slowest computer that still serves, for one excitation frequency.
struct MaxDelayOptions {
  double frequency;          ///< f (Hz), > 0
  double proportional_gain;  ///< P (N/m), finite; Eq. (6) tunes it to f
  DelayCriterion criterion = DelayCriterion::attenuates;  ///< what counts as feasible
  ForceHold hold = ForceHold::sampled;  ///< how the excitation enters; of `attenuates` only
  double delay_fraction = 0.0;    ///< δ/τ, 0 … 1000, kept while τ varies; by matrices ≤ 1
  double shortest_period = 1e-5;  ///< s; the search starts there, or at 1/(1000 f) if less
  /// s; where it gives up, > `shortest_period`; 0: where every longer period is shown to be stable
  /// if that is within 200 periods of the plant's slowest mode, else at 20 of them.
  double longest_period = 0.0;
  double search_ratio = 1.00001;  ///< > 1: infeasible windows narrower than this may be missed
                                  ///< where no D is shown to serve all over a step of this ratio
  int most_steps = 20000;  ///< ≥ 1; of the search, each some 40 µs or more for two masses,
                           ///< after which it gives up
  std::function<void()> watch = {};  ///< called at each step; may throw to end the search
  /// What `attenuates` compares with: the plant without control under the true force, or under the
  /// force held as with control, as `AmplitudeOptions` has it.
  bool relative_to_true_force = false;

  /// ω = 2π f (rad/s).
  double angular_frequency() const { return 2.0 * pi<double> * frequency; }

  /// τ and the δ that belongs to it.
  Sampling<double> sampling(double period) const { return {period, delay_fraction * period}; }
};

/// @throws InvalidParameter outside the ranges that the members of `MaxDelayOptions` state
inline void validate(const MaxDelayOptions& options) {
  require_positive("frequency", options.frequency, "Hz");
  require_finite("proportional gain", options.proportional_gain, "N/m");
  require_within("delay fraction", options.delay_fraction, "", 0.0, 1000.0);
  require_positive("shortest sampling period", options.shortest_period, "s");
  require_finite("longest sampling period", options.longest_period, "s");
  if (options.longest_period != 0.0)
    require_positive("search span", options.longest_period - options.shortest_period, "s");
  require_positive("search ratio minus one", options.search_ratio - 1.0, "");
  require_positive("most steps", options.most_steps, "");
}

namespace detail {

/// What one sampling period offers at the question's P.
template <class Scalar>
struct DelayOffer {
  std::vector<Interval<Scalar>> stable;            ///< D that stabilise
  std::optional<SteadyResponse<Scalar>> response;  ///< nothing for the criterion `stable`
};

template <class Plant>
DelayOffer<double> delay_offer(const Plant& plant, const MaxDelayOptions& options,
                               double sampling_period) {
  const auto loop = loop_of(plant, options.sampling(sampling_period));
  DelayOffer<double> offer{
      stable_gains(loop, FreeGain::differential, {options.proportional_gain, 0.0}), {}};
  if (options.criterion == DelayCriterion::stable || offer.stable.empty()) return offer;
  offer.response = response_of_loop(plant, loop, options.hold, options.angular_frequency(),
                                    options.relative_to_true_force);
  return offer;
}

/// The D of an offer that serves best: of minimum amplitude where that is asked, or inside the
/// first stable interval; nothing where none serves.
inline std::optional<double> serving_gain(const DelayOffer<double>& offer,
                                          double proportional_gain) {
  if (offer.stable.empty()) return std::nullopt;
  if (!offer.response) return offer.stable.front().representative();
  const auto best = offer.response->best_differential_gain(proportional_gain, offer.stable);
  if (!(best.ratio_to_uncontrolled < 1.0)) return std::nullopt;
  return best.differential_gain;
}

/// False where the criterion asks for samples that show the vibration and they do not.
inline bool shows_vibration(const MaxDelayOptions& options, double sampling_period) {
  return options.criterion == DelayCriterion::stable ||
         2.0 * options.frequency * sampling_period < 1.0;
}

/// The longest period (s) whose samples show the vibration, as `attenuates` asks.
inline double longest_that_shows(const MaxDelayOptions& options) {
  double nyquist = 0.5 / options.frequency;
  while (!shows_vibration(options, nyquist)) nyquist = std::nextafter(nyquist, 0.0);
  return nyquist;
}

}  // namespace detail

/// The open intervals of D (N s/m) that make one sampling period feasible, exact and ascending:
/// those that stabilise and, to attenuate, those of them with an amplitude below that of no
/// control.
/// @tparam Plant           two masses, in closed form, or a plant of any order with ports
/// @param plant            within its ranges, which are not checked here
/// @param options          within its ranges (`validate`), which are not checked here
/// @param sampling_period  τ (s), > 0
template <class Plant>
std::vector<Interval<double>> feasible_differential_gains(const Plant& plant,
                                                          const MaxDelayOptions& options,
                                                          double sampling_period) {
  if (!detail::shows_vibration(options, sampling_period)) return {};
  const auto offer = detail::delay_offer(plant, options, sampling_period);
  if (!offer.response) return offer.stable;
  return intersection(offer.stable,
                      offer.response->differential_gains_below(options.proportional_gain));
}

/// The differential gain that makes one sampling period feasible, if there is one: of minimum
/// amplitude over the stabilising gains, or inside the first interval of these.
///
/// The stabilising gains are known as exact intervals (`stable_gains`) and the minimum
/// amplitude over them in closed form (`SteadyResponse`), so nothing is scanned over D.
/// @tparam Plant           two masses, in closed form, or a plant of any order with ports
/// @param plant            within its ranges, which are not checked here
/// @param options          within its ranges (`validate`), which are not checked here
/// @param sampling_period  τ (s), > 0
template <class Plant>
std::optional<double> feasible_differential_gain(const Plant& plant, const MaxDelayOptions& options,
                                                 double sampling_period) {
  if (!detail::shows_vibration(options, sampling_period)) return std::nullopt;
  return detail::serving_gain(detail::delay_offer(plant, options, sampling_period),
                              options.proportional_gain);
}

}  // namespace holdfast
