#pragma once

#include <algorithm>
#include <vector>

#include "holdfast/core/errors.hpp"
#include "holdfast/core/interval.hpp"
#include "holdfast/plant/enclosed_poles.hpp"
#include "holdfast/stability/margins/sampling_proof.hpp"

namespace holdfast {

/// The range of sampling periods and the steps of a proof.
struct ProvedPeriodWalk {
  double from = 0.0;         ///< shortest period (s), > 0
  double to = 0.0;           ///< longest period (s), ≥ `from`
  double resolution = 1e-6;  ///< shortest step, as a share of the period, > 0
  int most_steps = 20000;    ///< largest number of steps of the proof
};

/// The largest period T (s) such that for every period from `walk.from` to T some D (N s/m) is
/// proved to stabilise the loop. Within a step (`SamplingProof`) D is the same. Nothing is claimed
/// for periods below `walk.from`. Longer periods than T may have a stabilising D too.
/// @param poles              poles as for EnclosedResponse
/// @param proportional_gain  gain P (N/m)
/// @param line               samplings with constant δ/τ and varying period
/// @param walk               range and steps of the periods
/// @param gains_at           period (s) → open intervals of stabilising D, computed without proof
/// @param watch              called for each step; an exception from it ends the work
/// @return 0 where no D is proved to stabilise at the shortest period
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
