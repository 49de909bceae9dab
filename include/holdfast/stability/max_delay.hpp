#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "holdfast/control/gains.hpp"
#include "holdfast/control/harmonic_input.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/plant/two_dof.hpp"
#include "holdfast/stability/characteristic_polynomial.hpp"
#include "holdfast/stability/response.hpp"
#include "holdfast/stability/stable_intervals.hpp"

namespace holdfast {

/// What a sampling period must allow to count as feasible.
enum class DelayCriterion {
  stable,      ///< some differential gain stabilises the loop
  attenuates,  ///< τ < 1/(2f), so that the samples show the vibration, and some stabilising
               ///< differential gain brings the steady amplitude below that of no
               ///< control
};

/// How the search for the largest sampling period ended.
enum class MaxDelayOutcome {
  found,      ///< every period up to `sampling_period` is feasible, a slightly longer one is not
  unlimited,  ///< every period up to the search limit is feasible; `sampling_period` is infinite
  never,      ///< not even the shortest period of the search is feasible; `sampling_period` is 0
};

/// A question about the slowest computer that still serves, for one excitation frequency.
struct MaxDelayQuestion {
  double frequency;          ///< f (Hz), > 0
  double proportional_gain;  ///< P (N/m), finite; Eq. (6) tunes it to f
  DelayCriterion criterion = DelayCriterion::attenuates;
  ForceHold hold = ForceHold::sampled;
  double delay_fraction = 0.0;    ///< δ/τ, 0 … 1, kept while τ varies
  double shortest_period = 1e-5;  ///< s; the search starts there, or at 1/(1000 f) if less
  double longest_period = 1.0;    ///< s; where it gives up
  double search_ratio = 1.01;     ///< > 1: infeasible windows narrower than this may be missed
};

/// The largest sampling period τ* such that every τ in (0, τ*] is feasible.
struct MaxDelay {
  MaxDelayOutcome outcome;
  double sampling_period;    ///< τ* (s)
  double differential_gain;  ///< D (N s/m) at τ*: of least amplitude, or amid the stable interval;
                             ///< a limit of gains that serve, not one to use without a margin
};

/// The differential gain that makes one sampling period feasible, if there is one.
///
/// The stabilising gains are known as exact intervals (`stable_differential_gains`) and the least
/// amplitude over them in closed form (`SteadyResponse`), so nothing is scanned over D.
inline std::optional<double> feasible_differential_gain(const TwoDof<double>& plant,
                                                        const MaxDelayQuestion& question,
                                                        double sampling_period) {
  const Sampling<double> sampling{sampling_period, question.delay_fraction * sampling_period};
  const auto loop = sampled_loop(plant, sampling);
  const auto intervals =
      stable_differential_gains(characteristic_polynomial(loop), question.proportional_gain);
  if (intervals.empty()) return std::nullopt;
  if (question.criterion == DelayCriterion::stable) return intervals.front().representative();
  if (2.0 * question.frequency * sampling_period >= 1.0) return std::nullopt;

  const double omega = 2.0 * pi<double> * question.frequency;
  const SteadyResponse<double> response(loop, harmonic_input(plant, loop, question.hold, omega),
                                        omega);
  const auto best = response.best_differential_gain(question.proportional_gain, intervals);
  if (!(best.ratio_to_uncontrolled < 1.0)) return std::nullopt;
  return best.differential_gain;
}

/// @throws InvalidParameter outside the ranges that the members of `MaxDelayQuestion` state
inline void validate(const MaxDelayQuestion& question) {
  require_positive("frequency", question.frequency, "Hz");
  require_finite("proportional gain", question.proportional_gain, "N/m");
  require_within("delay fraction", question.delay_fraction, "", 0.0, 1.0);
  require_positive("shortest sampling period", question.shortest_period, "s");
  require_positive("search span", question.longest_period - question.shortest_period, "s");
  require_positive("search ratio minus one", question.search_ratio - 1.0, "");
}

/// Walks τ upwards in steps of `search_ratio` until infeasible, then bisects the last step to 1e−12
/// relative. Source: Kollár 2022, Fig. 5.
/// @throws InvalidParameter for a plant or question outside the admissible ranges
inline MaxDelay max_sampling_period(const TwoDof<double>& plant, const MaxDelayQuestion& question) {
  validate(plant);
  validate(question);
  const auto gain_at = [&](double period) {
    return feasible_differential_gain(plant, question, period);
  };

  double feasible = std::min(question.shortest_period, 1e-3 / question.frequency);
  std::optional<double> gain = gain_at(feasible);
  if (!gain) return {MaxDelayOutcome::never, 0.0, std::numeric_limits<double>::quiet_NaN()};

  double infeasible = feasible;
  while (true) {
    if (feasible >= question.longest_period) {
      return {MaxDelayOutcome::unlimited, std::numeric_limits<double>::infinity(), *gain};
    }
    infeasible = feasible * question.search_ratio;
    const std::optional<double> next = gain_at(infeasible);
    if (!next) break;
    feasible = infeasible;
    gain = next;
  }
  while (infeasible - feasible > 1e-12 * feasible) {
    const double middle = feasible + (infeasible - feasible) / 2.0;
    if (middle == feasible || middle == infeasible) break;
    if (const std::optional<double> next = gain_at(middle)) {
      feasible = middle;
      gain = next;
    } else {
      infeasible = middle;
    }
  }
  return {MaxDelayOutcome::found, feasible, *gain};
}

}  // namespace holdfast
