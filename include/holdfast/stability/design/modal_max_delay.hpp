#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "holdfast/core/errors.hpp"
#include "holdfast/plant/conductor_with_absorber.hpp"
#include "holdfast/plant/modal_plant.hpp"
#include "holdfast/stability/boundary/resolved_circle.hpp"
#include "holdfast/stability/design/max_delay.hpp"
#include "holdfast/stability/response/modal_response.hpp"
#include "holdfast/stability/response/modal_steady_response.hpp"

namespace holdfast {

namespace detail {

/// Walks the sampling period until no D serves.
template <class Scalar>
class ModalDelayWalk {
 public:
  ModalDelayWalk(const ConductorWithAbsorber& plant, const MaxDelayOptions& options, double ratio)
      : plant_(plant),
        poles_(with_hardware(plant.poles, plant.hardware)),
        options_(options),
        ratio_(ratio) {}

  MaxDelay answer() const {
    double feasible = std::min(options_.shortest_period, 1e-3 / options_.frequency);
    if (!gain_at(feasible))
      return {MaxDelayOutcome::never, 0.0, none,
              lacking(options_, feasible, offer_at(feasible), none)};
    const double end = longest();
    while (feasible < end) {
      if (options_.watch) options_.watch();
      const double next = std::min(end, ratio_ * feasible);
      if (!gain_at(next)) return found_between(feasible, next);
      feasible = next;
    }
    const double gain = gain_at(end).value_or(none);
    if (!shows_vibration(options_, end * (1.0 + 1e-9)))
      return {MaxDelayOutcome::found, end, gain, MaxDelayLimit::nyquist};
    return {MaxDelayOutcome::beyond_search, end, gain, MaxDelayLimit::none};
  }

 private:
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();

  DelayOffer<double> offer_at(double period) const {
    const auto sampling = options_.sampling(period);
    const ResolvedCircle<Scalar> circle(
        modal_response<Scalar>(poles_, sampling).with_sensor(plant_.hardware.has_velocity_sensor));
    DelayOffer<double> offer{
        circle.stable_gains(FreeGain::differential, {options_.proportional_gain, 0.0}), {}};
    if (options_.criterion == DelayCriterion::stable || offer.stable.empty()) return offer;
    const double omega = options_.angular_frequency();
    offer.response = steady_response<Scalar>(plant_, sampling, options_.hold, omega);
    if (options_.relative_to_true_force)
      offer.response = offer.response->relative_to(true_amplitude_per_force(plant_, omega));
    return offer;
  }

  /// The D that serves best at a period, if one does.
  std::optional<double> gain_at(double period) const {
    return serving_gain(options_, period, offer_at(period));
  }

  double longest() const {
    if (options_.criterion == DelayCriterion::attenuates) return longest_that_shows(options_);
    double limit = options_.longest_period;
    const auto slowest = std::min_element(plant_.modes.begin(), plant_.modes.end(),
                                          [](const auto& one, const auto& other) {
                                            return one.angular_frequency < other.angular_frequency;
                                          });
    if (limit == 0.0) limit = 20.0 * 2.0 * pi<double> / slowest->angular_frequency;
    return std::max(limit, options_.shortest_period);
  }

  MaxDelay found_between(double feasible, double infeasible) const {
    constexpr double close = 1.0 + 1e-9;
    while (infeasible > close * feasible) {
      const double middle = std::sqrt(feasible * infeasible);
      (gain_at(middle) ? feasible : infeasible) = middle;
    }
    return {MaxDelayOutcome::found, feasible, gain_at(feasible).value_or(none),
            lacking(options_, infeasible, offer_at(infeasible),
                    least_ratio(options_, offer_at(feasible)))};
  }

  const ConductorWithAbsorber& plant_;
  std::vector<PlantPole> poles_;  // with those of the hardware
  MaxDelayOptions options_;
  double ratio_;
};

}  // namespace detail

/// The largest sampling period of the computer on a conductor by its modes: as
/// `max_sampling_period` of two masses asks, but walked, each period so many times the one before,
/// with every interval of stable D at each and the amplitude in closed form; where none serves the
/// edge is halved to 10⁻⁹. A stretch of periods narrower than a step is missed, and nothing is
/// shown of what lies in between or beyond.
/// @tparam Scalar  double; a parameter so that nothing is compiled where this is not called
/// @param plant    kept outside while this runs, its poles not none and none of its hardware's
/// @param options  within their ranges; search ratio and most steps do not count
/// @param ratio    of two neighbouring periods, > 1
/// @throws InvalidParameter outside these ranges
template <class Scalar = double>
MaxDelay modal_max_sampling_period(const ConductorWithAbsorber& plant,
                                   const MaxDelayOptions& options, double ratio = 1.03) {
  validate(plant.modes, plant.absorber);
  validate(options);
  require_positive("number of poles", static_cast<double>(plant.poles.size()), "");
  require_positive("ratio of neighbouring periods minus one", ratio - 1.0, "");
  return detail::ModalDelayWalk<Scalar>(plant, options, ratio).answer();
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template MaxDelay modal_max_sampling_period<double>(const ConductorWithAbsorber&,
                                                           const MaxDelayOptions&, double);
#endif

}  // namespace holdfast
