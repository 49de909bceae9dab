#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "holdfast/control/gains.hpp"
#include "holdfast/control/loop_map.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/math/enclosure/enclosure.hpp"
#include "holdfast/plant/enclosed_poles.hpp"
#include "holdfast/stability/chart/circle_arcs.hpp"
#include "holdfast/stability/chart/proved_chart.hpp"
#include "holdfast/stability/margins/margins.hpp"
#include "holdfast/stability/margins/sampling_proof.hpp"
#include "holdfast/stability/response/enclosed_response.hpp"

namespace holdfast {

/// Reason for the end of a stability proof by `proved_margins` in one direction.
enum class ProofStop {
  at_end,     ///< stability is proved up to the goal, or an unstable loop was found before it
  work,       ///< the largest number of steps was taken before the goal was reached
  undecided,  ///< enclosures could not decide whether a root reaches the unit circle
};

/// Proved stability margin of a quantity (D, P, τ or δ) in one direction from its given value.
struct ProvedMarginEnd {
  /// Value up to which the loop is proved stable, starting from the given value; NaN where the loop
  /// is not proved stable at the given value.
  double stable_to = std::numeric_limits<double>::quiet_NaN();
  /// A value beyond `stable_to` at which the loop is proved to be unstable; NaN if none was found.
  /// The values between `stable_to` and `unstable_at` are undecided.
  double unstable_at = std::numeric_limits<double>::quiet_NaN();
  ProofStop stop = ProofStop::undecided;  ///< reason for the end of the proof
};

/// Proved stability margins of a quantity (D, P, τ or δ), downwards and upwards from its value.
struct ProvedMargin {
  ProvedMarginEnd below;  ///< towards smaller values
  ProvedMarginEnd above;  ///< towards larger values
};

/// Shortest step and largest number of steps of `proved_margins`.
struct ProvedMarginsOptions {
  double resolution = 1e-6;  ///< ratio > 0 of the shortest step to the distance from value to goal
  int most_steps = 20000;    ///< largest number of steps of the proof in one direction
};

/// The margins of `StabilityMargins`, proved in interval arithmetic for the loop whose parameters
/// are exactly the given decimal numbers.
struct ProvedMargins {
  ProvedStability stability = ProvedStability::undecided;  ///< stability of the loop itself
  ProvedMargin differential_gain;                          ///< margin of D (N s/m)
  ProvedMargin proportional_gain;                          ///< margin of P (N/m)
  ProvedMargin sampling_period;   ///< margin of τ (s), with δ/τ constant
  ProvedMargin processing_delay;  ///< margin of δ (s), with τ constant
};

namespace detail {

inline GainBox box_of(const Enclosure& proportional, const Enclosure& differential) {
  return {proportional.lower(), proportional.upper(), differential.lower(), differential.upper()};
}

/// Whether it is proved that no loop with gains in a box has a root on the unit circle.
inline bool is_off_circle(CircleArcs& arcs, const GainBox& box) {
  return arcs.meeting(box, arcs.all()).empty();
}

/// Stability proved for all loops with gains in a box; `undecided` without a proof.
inline ProvedStability stability_of(CircleArcs& arcs, const GainBox& box) {
  if (!is_off_circle(arcs, box)) return ProvedStability::undecided;
  const auto outside = arcs.roots_outside(middle_of(box));
  if (!outside) return ProvedStability::undecided;
  return *outside == 0 ? ProvedStability::stable : ProvedStability::unstable;
}

/// One-parameter path of loops: one gain varies; the other gain and the sampling are constant.
struct GainPath {
  CircleArcs& arcs;
  FreeGain free;
  PdGains<double> gains;

  bool keeps_stability(double from, double to) const { return is_off_circle(arcs, box(from, to)); }
  ProvedStability at(double position) const { return stability_of(arcs, box(position, position)); }
  GainBox box(double from, double to) const {
    const Enclosure moved = Enclosure::of_decimals(from, to);
    if (free == FreeGain::differential)
      return box_of(Enclosure::of_decimal(gains.proportional), moved);
    return box_of(moved, Enclosure::of_decimal(gains.differential));
  }
};

/// One-parameter path of loops: the sampling period or the delay varies, the gains are constant.
struct SamplingPath {
  const std::vector<EnclosedPole>& poles;
  PdGains<double> gains;
  EnclosedSamplings line;
  SamplingProof<double> proof{poles, gains, line};

  bool keeps_stability(double from, double to) const { return proof.is_stable(from, to); }
  ProvedStability at(double position) const {
    CircleArcs arcs({poles, line.over(Enclosure::of_decimal(position))});
    return stability_of(arcs, box_of(Enclosure::of_decimal(gains.proportional),
                                     Enclosure::of_decimal(gains.differential)));
  }
};

/// Proves stability step by step along a path, from a value at which the loop is proved stable. A
/// step proves that no root reaches the unit circle; as roots move continuously, none gets outside.
/// If the proof stops before `limit` with steps left, an unstable loop is sought beyond.
/// @param watch  called for each step; an exception from it ends the work
template <class Path, class Watch>
ProvedMarginEnd walked_end(const Path& path, double value, double limit,
                           const ProvedMarginsOptions& options, const Watch& watch) {
  if (limit == value) return {value, std::nan(""), ProofStop::at_end};
  const double direction = limit < value ? -1.0 : 1.0, way = std::abs(limit - value);
  const double least_step = options.resolution * way;  // what may be left undecided
  const auto ahead = [&](double from, double step) {
    const double to = from + direction * step;
    return direction < 0.0 ? std::max(to, limit) : std::min(to, limit);
  };
  ProvedMarginEnd end{value};
  double step = 0.01 * way;
  for (int steps = 0; end.stable_to != limit && step >= least_step; ++steps) {
    if (steps == options.most_steps) {
      end.stop = ProofStop::work;
      return end;
    }
    watch();
    const double next = ahead(end.stable_to, step);
    const auto [from, to] = std::minmax(end.stable_to, next);
    const bool free = path.keeps_stability(from, to);
    if (free) end.stable_to = next;
    step *= free ? 1.5 : 0.5;
  }
  for (double gap = least_step; end.stable_to != limit; gap *= 4.0) {
    watch();
    const double position = ahead(end.stable_to, gap);
    if (path.at(position) == ProvedStability::unstable) end.unstable_at = position;
    if (std::isfinite(end.unstable_at) || position == limit || gap > 1e6 * least_step) break;
  }
  if (end.stable_to == limit || std::isfinite(end.unstable_at)) end.stop = ProofStop::at_end;
  return end;
}

/// The intended end of a proof, slightly beyond the boundary found in doubles. Without a boundary
/// it is the end of the search in doubles, or `otherwise` if that end is infinite.
inline double limit_beyond(const MarginEnd& end, double value, double otherwise) {
  if (end.outcome == MarginEndOutcome::boundary) return value + 1.1 * (end.position - value);
  if (end.outcome == MarginEndOutcome::undefined) return value;
  return std::isfinite(end.position) ? end.position : otherwise;
}

template <class Watch>
struct MarginProver {
  const std::vector<EnclosedPole>& poles;
  const Sampling<double>& sampling;
  const PdGains<double>& gains;
  const StabilityMargins& found;
  const ProvedMarginsOptions& options;
  const Watch& watch;
  CircleArcs arcs = CircleArcs({poles, sampling});

  ProvedMargins prove() {
    ProvedMargins proved;
    const GainPath along_d{arcs, FreeGain::differential, gains};
    proved.stability = along_d.at(gains.differential);
    if (proved.stability != ProvedStability::stable) return proved;
    proved.differential_gain = of_gain(along_d, found.differential_gain);
    proved.proportional_gain =
        of_gain({arcs, FreeGain::proportional, gains}, found.proportional_gain);
    of_sampling(proved);
    return proved;
  }
  void of_sampling(ProvedMargins& proved) const {
    proved.sampling_period = of_period();
    proved.processing_delay = {of_delay(found.processing_delay.below, -1),
                               of_delay(found.processing_delay.above, +1)};
  }

 private:
  ProvedMargin of_gain(const GainPath& path, const TwoSidedMargin& by_doubles) const {
    constexpr double farthest = 1e12;  // where doubles have found no end
    const double value = gain_of(gains, path.free);
    return {towards(path, value, limit_beyond(by_doubles.below, value, -farthest)),
            towards(path, value, limit_beyond(by_doubles.above, value, farthest))};
  }
  template <class Path>
  ProvedMarginEnd towards(const Path& path, double value, double limit) const {
    return walked_end(path, value, limit, options, watch);
  }

  ProvedMargin of_period() const {
    const double period = sampling.period;
    const SamplingPath path{poles, gains, EnclosedSamplings::of_period(sampling)};
    const auto& [below, above] = found.sampling_period;
    const double shortest = 1e-3 * period, longest = 100.0 * period;
    return {towards(path, period, std::max(limit_beyond(below, period, shortest), shortest)),
            towards(path, period, limit_beyond(above, period, longest))};
  }

  /// The proved end for δ, by ranges (k − 1) τ … k τ; a root is at λ = 0 where two ranges meet.
  ProvedMarginEnd of_delay(const MarginEnd& by_doubles, int direction) const {
    const double delay = sampling.processing_delay;
    const double limit =
        std::max(limit_beyond(by_doubles, delay, delay + 10.0 * sampling.period), 0.0);
    ProvedMarginEnd end{delay};
    double from = delay;
    for (int k = held_commands(sampling); k >= 1; k += direction) {
      // Neighbouring stretches overlap by the rounding of the seam.
      const Enclosure seam = Enclosure(static_cast<double>(direction < 0 ? k - 1 : k)) *
                             Enclosure::of_decimal(sampling.period);
      const double goal =
          direction < 0 ? std::max(seam.lower(), limit) : std::min(seam.upper(), limit);
      const SamplingPath path{poles, gains, EnclosedSamplings::of_delay(sampling.period, k)};
      end = towards(path, from, goal);
      if (end.stable_to != goal || goal == limit) break;
      from = direction < 0 ? seam.upper() : seam.lower();
    }
    return end;
  }
};

}  // namespace detail

/// Proves up to which values D, P, τ and δ, one at a time, may change while the loop stays stable.
/// First the loop with the given decimal numbers is proved stable. Then, in steps from the given
/// value, it is proved that no root reaches the unit circle; no unstable range is missed. The goal
/// of the steps is 10 % beyond the boundary in `found`, or the end of the search in `found`.
/// @param poles       poles of `enclosed_poles`
/// @param sampling    τ (s) > 0 and δ (s), 0 … 1000 τ
/// @param gains       P (N/m) and D (N s/m), finite
/// @param found       margins computed in double precision; they only determine the goals
/// @param options     resolution and largest number of steps
/// @param watch       called for each step; an exception from it ends the work
/// @throws InvalidParameter where sampling or gains are not admissible
template <class Watch>
ProvedMargins proved_margins(const std::vector<EnclosedPole>& poles,
                             const Sampling<double>& sampling, const PdGains<double>& gains,
                             const StabilityMargins& found, const ProvedMarginsOptions& options,
                             const Watch& watch) {
  validate(gains);
  return detail::MarginProver<Watch>{poles, sampling, gains, found, options, watch}.prove();
}

/// Proves the margins of τ and δ only, for a loop known to be stable with the given values. Other
/// members of the result keep their defaults. The arguments are those of `proved_margins`.
/// @throws InvalidParameter where sampling or gains are not admissible
template <class Watch>
ProvedMargins proved_sampling_margins(const std::vector<EnclosedPole>& poles,
                                      const Sampling<double>& sampling,
                                      const PdGains<double>& gains, const StabilityMargins& found,
                                      const ProvedMarginsOptions& options, const Watch& watch) {
  validate(gains);
  ProvedMargins proved;
  detail::MarginProver<Watch>{poles, sampling, gains, found, options, watch}.of_sampling(proved);
  return proved;
}

}  // namespace holdfast
