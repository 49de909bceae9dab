#pragma once

#include <algorithm>
#include <vector>

#include "holdfast/core/errors.hpp"
#include "holdfast/core/interval.hpp"
#include "holdfast/plant/enclosed_poles.hpp"
#include "holdfast/stability/margins/sampling_proof.hpp"

namespace holdfast {

/// Range of sampling periods and limits of the steps for `proved_max_sampling_period`.
struct ProvedPeriodWalk {
  double from = 0.0;         ///< shortest sampling period (s), > 0; start of the proof
  double to = 0.0;           ///< longest sampling period (s), ≥ `from`; goal of the proof
  double resolution = 1e-6;  ///< ratio > 0 of a step to the period, below which the proof ends
  int most_steps = 20000;    ///< largest number of steps of the proof, ≥ 0
};

/// The sampling period T (s) up to which the loop is proved to be stabilisable: for every period
/// from `walk.from` to T, some D (N s/m) is proved to stabilise it. D is constant within a step of
/// the proof (`SamplingProof`). Periods below `walk.from` or above T are left undecided.
/// @param poles              poles of `enclosed_poles`, at least one, none of which may be 0
/// @param proportional_gain  gain P (N/m), finite
/// @param line               samplings with varying period τ and constant δ/τ
/// @param walk               range of the periods and limits of the steps
/// @param gains_at           period (s) → open intervals of stabilising D, computed without proof
/// @param watch              called for each step; an exception from it ends the work
/// @return T; 0 where no D is proved to stabilise the loop at `walk.from`
/// @throws InvalidParameter where a member of `walk` is out of range
template <class GainsAt, class Watch>
double proved_max_sampling_period(const std::vector<EnclosedPole>& poles, double proportional_gain,
                                  const EnclosedSamplings& line, const ProvedPeriodWalk& walk,
                                  const GainsAt& gains_at, const Watch& watch) {
  require_positive("shortest sampling period", walk.from, "s");
  require_within("longest sampling period", walk.to, "s", walk.from, 1e300);
  require_positive("resolution", walk.resolution, "");
  std::vector<SamplingProof<double>> candidates;  // the one that served last comes last
  const auto propose = [&](double period) {
    for (const Interval<double>& gains : gains_at(period))
      candidates.insert(
          candidates.begin(),
          SamplingProof<double>(poles, {proportional_gain, gains.representative()}, line));
    if (candidates.size() > 4) candidates.erase(candidates.begin() + 3, candidates.end() - 1);
  };
  const auto one_serves = [&](double from, double to) {
    const auto found =
        std::find_if(candidates.rbegin(), candidates.rend(),
                     [&](const auto& candidate) { return candidate.is_stable(from, to); });
    if (found == candidates.rend()) return false;
    std::iter_swap(found, candidates.rbegin());
    return true;
  };
  propose(walk.from);
  if (!one_serves(walk.from, walk.from)) return 0.0;
  double proved = walk.from, step = 0.1 * walk.from;
  for (int steps = 0; proved < walk.to && steps < walk.most_steps; ++steps) {
    watch();
    const double next = std::min(proved + step, walk.to);
    bool serves = one_serves(proved, next);
    if (!serves) {
      propose(next);
      serves = one_serves(proved, next);
    }
    if (serves) proved = next;
    step *= serves ? 1.5 : 0.5;
    if (step < walk.resolution * proved) break;
  }
  return proved;
}

}  // namespace holdfast
