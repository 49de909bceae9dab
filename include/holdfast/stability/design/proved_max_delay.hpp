#pragma once

#include <algorithm>
#include <vector>

#include "holdfast/core/errors.hpp"
#include "holdfast/core/interval.hpp"
#include "holdfast/plant/enclosed_poles.hpp"
#include "holdfast/stability/margins/sampling_proof.hpp"

namespace holdfast {

/// How far sampling periods are walked for a proof.
struct ProvedPeriodWalk {
  double from = 0.0;         ///< s, > 0; the shortest period
  double to = 0.0;           ///< s, ≥ from; the longest
  double resolution = 1e-6;  ///< > 0; the shortest step, as a share of the period
  int most_steps = 20000;    ///< after which the walk ends
};

/// The largest period T (s) such that every period from the shortest to T is proved to have a D
/// (N s/m) that stabilises: stretch by stretch one D, of which `SamplingProof` shows it for all
/// periods of the stretch. Below the shortest nothing is said, and beyond T nothing is refuted.
/// @param poles              as EnclosedResponse takes them
/// @param proportional_gain  P (N/m)
/// @param line               along which the period moves
/// @param walk               from where to where, and how finely
/// @param gains_at           period → open intervals of D that doubles find to stabilise
/// @param watch              called for each step; what it throws ends the work
/// @return 0 where none is proved to serve at the shortest
/// @throws InvalidParameter for another walk
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
