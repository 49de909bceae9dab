#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <mutex>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "holdfast/control/gains.hpp"
#include "holdfast/control/loop_input.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/core/interval.hpp"
#include "holdfast/core/interval_sets.hpp"
#include "holdfast/math/roots/first_crossing.hpp"
#include "holdfast/plant/conductor_with_absorber.hpp"
#include "holdfast/plant/linear_plant.hpp"
#include "holdfast/plant/ports.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "holdfast/stability/boundary/unit_circle_crossings.hpp"
#include "holdfast/stability/design/attenuating_stretch.hpp"
#include "holdfast/stability/margins/loop_form.hpp"
#include "holdfast/stability/margins/slow_sampling.hpp"
#include "holdfast/stability/response/modal_response.hpp"
#include "holdfast/stability/response/modal_steady_response.hpp"
#include "holdfast/stability/response/response.hpp"

namespace holdfast {

/// Condition for a sampling period τ (s) to be feasible at an excitation frequency f (Hz).
enum class DelayCriterion {
  stable,      ///< at least one differential gain D stabilises the loop
  attenuates,  ///< the samples resolve the vibration, τ < 1/(2f), and some stabilising D gives a
               ///< smaller steady amplitude than without control
};

/// The options of the search for the largest feasible sampling period at one frequency.
struct MaxDelayOptions {
  double frequency;          ///< excitation frequency f (Hz), > 0
  double proportional_gain;  ///< gain P (N/m), finite; see `tuned_proportional_gain`
  DelayCriterion criterion = DelayCriterion::attenuates;  ///< condition for a feasible period
  ForceHold hold = ForceHold::sampled;  ///< hold of the excitation; used by `attenuates` only
  double delay_fraction = 0.0;  ///< constant δ/τ: 0 … 1, or 0 … 1000 for a conductor given by modes
  double shortest_period = 1e-5;  ///< start of the search (s), > 0; reduced to 1/(1000 f) if larger
  /// The end of the search (s), > `shortest_period`, or 0 for a default. For `attenuates` the
  /// default is 1/(2f). For `stable` it is the period beyond which the loop with D = 0 is proved
  /// stable, if this is at most 200 periods of the plant's slowest mode, else 20 of these periods.
  double longest_period = 0.0;
  double search_ratio = 1.00001;  ///< ratio > 1; all periods between two feasible periods with at
                                  ///< most this ratio are assumed to be feasible
  int most_steps = 20000;  ///< largest number of steps, ≥ 1; for two masses one takes 40 µs or more
  std::function<void()> watch = {};  ///< called at each step; may throw to end the search
  /// Whether `attenuates` compares with the amplitude without control under the true force. If
  /// false, it compares with that under the force according to `hold`; see `AmplitudeOptions`.
  bool relative_to_true_force = false;

  /// The angular frequency ω = 2π f (rad/s).
  double angular_frequency() const { return 2.0 * pi<double> * frequency; }

  /// The sampling with the period τ = `period` (s) and the delay δ = `delay_fraction` · τ (s).
  Sampling<double> sampling(double period) const { return {period, delay_fraction * period}; }
};

/// Validates the options. @throws InvalidParameter where a member is outside its stated range
inline void validate(const MaxDelayOptions& options) {
  require_positive("frequency", options.frequency, "Hz");
  require_finite("proportional gain", options.proportional_gain, "N/m");
  require_within("delay fraction", options.delay_fraction, "", 0.0, 1000.0);
  require_positive("shortest sampling period", options.shortest_period, "s");
  require_finite("longest sampling period", options.longest_period, "s");
  if (options.longest_period != 0.0)
    require_positive("range of periods", options.longest_period - options.shortest_period, "s");
  require_positive("search ratio minus one", options.search_ratio - 1.0, "");
  require_positive("largest number of steps", options.most_steps, "");
}

namespace detail {

/// Stabilising gains D and the steady response at one sampling period, for a given gain P.
struct DelayOffer {
  std::vector<Interval<double>> stable;                 ///< intervals of D (N s/m) that stabilise
  std::optional<SteadyResponse<double>> response = {};  ///< steady response; empty for `stable`
};

template <class Plant>
DelayOffer delay_offer(const Plant& plant, const MaxDelayOptions& options, double sampling_period) {
  const auto loop = loop_of(plant, options.sampling(sampling_period));
  DelayOffer offer{stable_gains(loop, FreeGain::differential, {options.proportional_gain, 0.0})};
  if (options.criterion == DelayCriterion::stable || offer.stable.empty()) return offer;
  offer.response = response_of_loop(plant, loop, options.hold, options.angular_frequency(),
                                    options.relative_to_true_force);
  return offer;
}

/// The steady response of a conductor given by its modes, at one sampling period.
template <class Scalar = double>
SteadyResponse<Scalar> delay_response(const ConductorWithAbsorber& plant,
                                      const MaxDelayOptions& options, double period) {
  const double omega = options.angular_frequency();
  const auto held = steady_response<Scalar>(plant, options.sampling(period), options.hold, omega);
  if (!options.relative_to_true_force) return held;
  return held.relative_to(true_amplitude_per_force(plant, omega));
}

/// The stabilising D and the steady response of a conductor given by its modes.
template <class Scalar = double>
DelayOffer delay_offer(const ConductorWithAbsorber& plant, const MaxDelayOptions& options,
                       double period) {
  const UnitCircleCrossings<Scalar> circle(modal_response<Scalar>(plant, options.sampling(period)));
  DelayOffer offer{circle.stable_gains(FreeGain::differential, {options.proportional_gain, 0.0})};
  if (options.criterion != DelayCriterion::stable && !offer.stable.empty())
    offer.response = delay_response<Scalar>(plant, options, period);
  return offer;
}

/// Whether the samples resolve the vibration, τ < 1/(2f); true if the criterion is `stable`.
inline bool shows_vibration(const MaxDelayOptions& options, double sampling_period) {
  return options.criterion == DelayCriterion::stable ||
         2.0 * options.frequency * sampling_period < 1.0;
}

/// The best D for a period: the D of minimum amplitude for `attenuates`, else a D inside the first
/// stable interval; NaN where no D is feasible.
inline double serving_gain(const MaxDelayOptions& options, double period, const DelayOffer& offer) {
  if (!shows_vibration(options, period) || offer.stable.empty()) return std::nan("");
  if (!offer.response) return offer.stable.front().representative();
  const auto best = offer.response->best_differential_gain(options.proportional_gain, offer.stable);
  return best.ratio_to_uncontrolled < 1.0 ? best.differential_gain : std::nan("");
}

/// The least amplitude ratio over the stabilising D; NaN for `stable` or where no D stabilises.
inline double least_ratio(const MaxDelayOptions& options, const DelayOffer& offer) {
  if (!offer.response) return std::numeric_limits<double>::quiet_NaN();
  return offer.response->best_differential_gain(options.proportional_gain, offer.stable)
      .ratio_to_uncontrolled;
}

}  // namespace detail

/// The open intervals of D (N s/m), ascending, that make a sampling period feasible. Each D in them
/// stabilises the loop and, for `attenuates`, gives an amplitude below that without control.
/// @tparam Plant           two masses (closed form), or a plant of any order with `Ports`
/// @param plant            plant within its ranges, which are not checked here
/// @param options          options within their ranges (`validate`), which are not checked here
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

/// The outcome of the search for the largest sampling period.
enum class MaxDelayOutcome {
  found,      ///< every period up to `sampling_period` is feasible; a slightly longer one is not
  unlimited,  ///< every period is feasible, as the loop is proved to be stable for all periods
              ///< beyond the end of the search (`SlowSamplingBound`); `sampling_period` is infinite
  beyond_search,  ///< every period up to `sampling_period`, where the search ended, is feasible;
                  ///< longer periods were not examined
  never,          ///< the shortest period of the search is infeasible; `sampling_period` is 0
};

/// Reason why sampling periods just beyond the largest feasible one are infeasible.
enum class MaxDelayLimit {
  none,         ///< no reason is known: the outcome is `unlimited` or `beyond_search`
  stability,    ///< no D stabilises the loop, or the stable interval of the best D has vanished
  attenuation,  ///< no stabilising D gives an amplitude below that without control
  nyquist,      ///< τ = 1/(2f): the samples no longer resolve the vibration
};

/// The largest sampling period τ* such that every τ from the start of the search to τ* is feasible.
struct MaxDelay {
  MaxDelayOutcome outcome;  ///< outcome of the search
  double sampling_period;   ///< largest feasible period τ* (s); 0 for `never`
  /// A feasible D (N s/m) at τ*; NaN for `never`. For `attenuates` it is the D of least amplitude.
  /// It is chosen without a stability margin and is not a recommended gain.
  double differential_gain;
  MaxDelayLimit limit;  ///< reason for the limit τ*; for `never`, that at the shortest period
};

/// Cache of the `UnitCircleCrossings` of one conductor's loop, with one entry per sampling (τ, δ).
/// It serves searches at several frequencies over the same sampling periods. Thread-safe.
class SharedCircles {
 public:
  /// The crossings for a sampling (τ, δ). `make()` computes them at the first call with a sampling.
  template <class Make>
  const UnitCircleCrossings<double>& at(const Sampling<double>& sampling, const Make& make) {
    const std::lock_guard lock(guard_);
    const std::pair key(sampling.period, sampling.processing_delay);
    const auto found = circles_.find(key);
    return found != circles_.end() ? found->second : circles_.emplace(key, make()).first->second;
  }

 private:
  std::mutex guard_;
  std::map<std::pair<double, double>, UnitCircleCrossings<double>> circles_;
};

namespace detail {

/// The period (s) beyond which D = 0 is proved to stabilise; infinite where nothing is proved.
template <class Plant>
double certain_from(const Plant& plant, const MaxDelayOptions& options) {
  return SlowSamplingBound(plant, {options.proportional_gain, 0.0}, options.delay_fraction)
      .certain_from();
}
inline double certain_from(const ConductorWithAbsorber& /*plant*/, const MaxDelayOptions&) {
  return std::numeric_limits<double>::infinity();
}

/// The default end of the search (s) for the criterion `stable`.
template <class Plant>
double longest_of_stability(const Plant& plant, double certain) {
  const double slowest = slowest_mode_period(plant);
  return certain <= 200.0 * slowest ? certain : 20.0 * slowest;
}
inline double longest_of_stability(const ConductorWithAbsorber& plant, double /*certain*/) {
  double slowest = std::numeric_limits<double>::infinity();
  for (const auto& mode : plant.modes) slowest = std::min(slowest, mode.angular_frequency);
  return 20.0 * 2.0 * pi<double> / slowest;
}

/// Stepwise search for the largest feasible period. Over each step one D is proved feasible. For a
/// conductor given by its modes nothing is proved, and `search_ratio` determines the steps.
template <class Plant>
class DelaySearch {
 public:
  using Intervals = std::vector<Interval<double>>;

  /// @param shared  circles of this plant, also used by other searches; or null
  DelaySearch(const Plant& plant, const MaxDelayOptions& options, SharedCircles* shared = nullptr)
      : plant_(plant),
        options_(options),
        shared_(shared),
        reference_(options.relative_to_true_force
                       ? true_amplitude_per_force(plant, options.angular_frequency())
                       : std::numeric_limits<double>::quiet_NaN()) {
    if constexpr (is_walked_)
      shown_ = std::min(nyquist_period(with_hardware(plant.poles, plant.hardware)),
                        0.5 / options.frequency);
  }

  MaxDelay answer() {
    feasible_ = std::min(options_.shortest_period, 1e-3 / options_.frequency);
    gains_ = gains_at(feasible_);
    if (gains_.empty()) return {MaxDelayOutcome::never, 0.0, none, limit_at(feasible_, none)};
    const double certain = certain_from(plant_, options_), end = longest(certain);
    double goal = end, boundary = end;
    while (const std::optional<double> infeasible = advance(goal)) {
      boundary = boundary_between(feasible_, *infeasible);
      goal = std::max(feasible_, boundary / options_.search_ratio);
      if (goal == feasible_) break;
    }
    const auto unknown_beyond = [this](double last) -> MaxDelay {
      return {MaxDelayOutcome::beyond_search, last, gain_at(last), MaxDelayLimit::none};
    };
    if (is_exhausted()) return unknown_beyond(feasible_);
    if (boundary == end && options_.criterion == DelayCriterion::stable && !(end < certain))
      return {MaxDelayOutcome::unlimited, infinity, gain_at(end), MaxDelayLimit::none};
    if (boundary == end && shows_vibration(options_, end * (1.0 + 1e-9)))
      return unknown_beyond(end);
    return {MaxDelayOutcome::found, boundary, gain_at(boundary),
            limit_at(boundary * (1.0 + 1e-9), least_ratio(options_, offer_at(boundary)))};
  }

 private:
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  static constexpr bool is_walked_ = std::is_same_v<Plant, ConductorWithAbsorber>;
  static constexpr double longest_link_ = 8.0;  // as a ratio of its ends
  static constexpr int most_stretches_ = 2000;  // of a link; a shorter link is tried then

  DelayOffer offer_at(double period) const { return delay_offer(plant_, options_, period); }
  Intervals gains_at(double period) const {
    return feasible_differential_gains(plant_, options_, period);
  }
  /// The best D at a period, or any that serves there if round-off hides the interval around it.
  double gain_at(double period) {
    const double best = serving_gain(options_, period, offer_at(period));
    return std::isnan(best) && is_served_coarsely(period, nullptr) ? start_ : best;
  }

  /// The cause of infeasibility at a period. Where the least amplitude ratio jumps, an interval of
  /// stabilising D has vanished, so that the cause is stability.
  /// @param before  least amplitude ratio just below the period, NaN without one
  MaxDelayLimit limit_at(double period, double before) const {
    const DelayOffer offer = offer_at(period);
    if (!shows_vibration(options_, period)) return MaxDelayLimit::nyquist;
    if (offer.stable.empty() || !offer.response) return MaxDelayLimit::stability;
    return least_ratio(options_, offer) - before > 1e-3 ? MaxDelayLimit::stability
                                                        : MaxDelayLimit::attenuation;
  }

  /// The end of the search, or the longest period before it whose samples resolve the vibration.
  double longest(double certain) const {
    const double asked = options_.longest_period;
    if (options_.criterion == DelayCriterion::stable)
      return std::max(asked > 0.0 ? asked : longest_of_stability(plant_, certain), feasible_);
    double nyquist = 0.5 / options_.frequency;
    while (!shows_vibration(options_, nyquist)) nyquist = std::nextafter(nyquist, 0.0);
    return asked > 0.0 ? std::min(asked, nyquist) : nyquist;
  }

  bool is_exhausted() const { return steps_ >= options_.most_steps; }

  void count_step() {
    ++steps_;
    if (options_.watch) options_.watch();
  }

  /// Increases the period `feasible_` up to `goal` while steps are left and periods are feasible.
  /// @return the infeasible period that ended the search, if any
  std::optional<double> advance(double goal) {
    const double longest_step = is_walked_ ? options_.search_ratio : longest_link_;
    double ratio = longest_step;
    while (feasible_ < goal && !is_exhausted()) {
      count_step();
      const double part = std::clamp(shown_, feasible_, 10.0 * feasible_);
      const double next = std::min(goal, feasible_ + (ratio - 1.0) * part);
      if constexpr (is_walked_) {
        if (!is_served(next, shared_)) return next;
        feasible_ = next;
      } else {
        Intervals gains = gains_at(next);
        if (gains.empty()) return next;
        if (next <= feasible_ * options_.search_ratio || links(next, gains)) {
          feasible_ = next;
          gains_ = std::move(gains);
          ratio = longest_step;
        } else {
          ratio = std::sqrt(next / feasible_);
        }
      }
    }
    return std::nullopt;
  }

  /// Whether a period is feasible with some D; such a D is stored.
  bool is_served(double period, SharedCircles* shared = nullptr) {
    if (is_served_coarsely(period, shared)) return true;
    const Intervals gains = gains_at(period);
    if (!gains.empty()) start_ = gains.front().representative();
    return !gains.empty();
  }

  /// Whether a period is feasible, from fewer angles, for a conductor given by its modes. A stable
  /// interval may be missed if both its ends are crossings between two angles.
  bool is_served_coarsely(double period, SharedCircles* shared) {
    if constexpr (is_walked_) {
      const double p = options_.proportional_gain;
      Intervals below{{-infinity, infinity}};
      if (options_.criterion == DelayCriterion::attenuates)
        below = delay_response(plant_, options_, period).differential_gains_below(p);
      if (below.empty() || !shows_vibration(options_, period)) return false;
      const auto sampling = options_.sampling(period);
      const auto circle = [&] {
        using Circle = UnitCircleCrossings<double>;
        return Circle(modal_response<double>(plant_, sampling), Circle::coarse);
      };
      const auto serves = [&](const UnitCircleCrossings<double>& on) {
        const auto is_stable = [&](double d) { return on.roots_outside({p, d}) == 0; };
        const bool attenuates =
            std::any_of(below.begin(), below.end(),
                        [&](const Interval<double>& gains) { return gains.contains(start_); });
        if (attenuates && is_stable(start_)) return true;
        const auto stable = on.stable_gains(FreeGain::differential, {p, 0.0}, false);
        const Intervals gains = intersection(stable, below);
        if (gains.empty() || !is_stable(gains.front().representative())) return false;
        start_ = gains.front().representative();
        return true;
      };
      return shared ? serves(shared->at(sampling, circle)) : serves(circle());
    }
    return false;
  }

  /// Whether one D is proved to be feasible at all periods from `feasible_` to `next`.
  bool links(double next, const Intervals& gains) {
    Intervals common = intersection(gains_, gains);
    std::sort(common.begin(), common.end(),
              [](const auto& a, const auto& b) { return b.upper - b.lower < a.upper - a.lower; });
    return std::any_of(common.begin(), common.end(), [&](const Interval<double>& interval) {
      return serves(interval.representative(), next);
    });
  }

  bool serves(double differential_gain, double next) {
    const PdGains<double> gains{options_.proportional_gain, differential_gain};
    const auto family = SamplingFamily<Plant>::of_period(plant_, options_.delay_fraction);
    const auto shown = [&](double period, double radius) {
      return options_.criterion == DelayCriterion::stable
                 ? family.stability(gains, period, radius)
                 : attenuation(plant_, family, gains, options_.hold, options_.angular_frequency(),
                               period, radius, reference_);
    };
    const auto edge = [](double, double failing) { return failing; };
    const double first = 0.25 * (next - feasible_);
    const WalkLimits limits{0.1 * (options_.search_ratio - 1.0), most_stretches_};
    bool fails = false;  // once true, the rest of the range is not examined
    const auto until_failure = [&](double period, double radius) {
      if (fails || is_exhausted()) return Stretch::open;
      count_step();
      const Stretch stretch = shown(period, radius);
      fails = stretch == Stretch::fails;
      return fails ? Stretch::open : stretch;
    };
    return first_crossing(until_failure, edge, feasible_, next, first, limits).outcome ==
           WalkOutcome::clear;
  }

  /// The last feasible period between a feasible and an infeasible one, by bisection.
  double boundary_between(double feasible, double infeasible) {
    constexpr double wide = 1.0 + (is_walked_ ? 1e-9 : 1e-13);
    const double beyond = infeasible;
    const auto halve = [&](const auto& is_feasible) {
      while (infeasible > wide * feasible) {
        const double middle = std::sqrt(feasible * infeasible);
        (is_feasible(middle) ? feasible : infeasible) = middle;
      }
    };
    if (is_walked_) halve([&](double period) { return is_served_coarsely(period, nullptr); });
    if (is_walked_ && gains_at(infeasible).empty()) return feasible;
    infeasible = beyond;
    halve([&](double period) { return is_served(period); });
    return feasible;
  }

  Plant plant_;
  MaxDelayOptions options_;
  SharedCircles* shared_;
  double feasible_ = 0.0;  // every period up to it is feasible
  Intervals gains_;        // that serve there
  int steps_ = 0;          // of the search so far
  double start_ = 0.0;     // D that serves at a neighbouring period
  double reference_;       // m/N, of the true force; NaN where the held one is it
  double shown_ = 0.0;     // s; the longest period that shows all, by parts of which it is walked
};

}  // namespace detail

/// The largest feasible sampling period τ*, found in steps that are proved to be feasible.
///
/// For each step one D is proved to be feasible at all periods of the step (`MovingSpectrum`,
/// `detail::attenuation`). If the end of a step is infeasible, bisection finds the boundary. Steps
/// whose ends have at most the ratio `search_ratio`, such as the last step to τ*, are tested only
/// at their ends and assumed to be feasible in between. Source: Kollár 2022, Fig. 5.
/// @param plant    two masses (closed form), or a plant of any order with `Ports`
/// @param options  options within their ranges, with a delay fraction δ/τ of 0 … 1
/// @throws InvalidParameter where the plant or an option is outside its admissible range
template <class Plant>
MaxDelay max_sampling_period(const Plant& plant, const MaxDelayOptions& options) {
  validate(plant);
  validate(options);
  require_within("delay fraction", options.delay_fraction, "", 0.0, 1.0);
  return detail::DelaySearch(plant, options).answer();
}

/// The largest feasible sampling period for a conductor given by its modes, found in steps.
///
/// A step has the length (ratio − 1) T. T is the longest period that resolves all natural motions
/// and the excitation, but at least 1 and at most 10 times the present period. The end of a step is
/// tested with the last feasible D, then with all stable intervals of D. If it is infeasible,
/// bisection finds the last feasible period to a relative 10⁻⁹. Feasibility is not proved within a
/// step: infeasible ranges of periods shorter than a step may be missed.
/// @param plant    conductor with its poles, without the poles of measurement filter and drive
/// @param options  options within their ranges; `search_ratio` and `most_steps` have no effect
/// @param ratio    number > 1 that determines the step length (ratio − 1) T
/// @param shared   cache for several searches with this plant; or null
/// @throws InvalidParameter where the plant, an option or `ratio` is outside its admissible range
template <class Scalar = double>
MaxDelay modal_max_sampling_period(const ConductorWithAbsorber& plant,
                                   const MaxDelayOptions& options, double ratio = 1.03,
                                   SharedCircles* shared = nullptr) {
  validate(plant.modes, plant.absorber);
  validate(options);
  require_positive("number of poles", static_cast<double>(plant.poles.size()), "");
  require_positive("ratio of neighbouring periods minus one", ratio - 1.0, "");
  MaxDelayOptions walked = options;
  walked.search_ratio = ratio;
  walked.most_steps = std::numeric_limits<int>::max();
  return detail::DelaySearch(plant, walked, shared).answer();
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template MaxDelay max_sampling_period(const TwoMass<double>&, const MaxDelayOptions&);
extern template MaxDelay max_sampling_period(const LinearPlant<double>&, const MaxDelayOptions&);
extern template MaxDelay modal_max_sampling_period<double>(const ConductorWithAbsorber&,
                                                           const MaxDelayOptions&, double,
                                                           SharedCircles*);
#endif

}  // namespace holdfast
