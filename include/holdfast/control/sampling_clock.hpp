#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <sstream>

#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/core/errors.hpp"

namespace holdfast {

/// The random deviation of the sampling instants from the grid j τ; by default zero.
struct Jitter {
  double half_width = 0;   ///< largest deviation J (s), ≥ 0
  std::uint64_t seed = 1;  ///< seed of the random sequence
};

/// Rejects a jitter so large that a sample could precede the force of the previous sample.
/// @throws InvalidParameter unless the sampling (period τ, delay δ) is admissible and the half
/// width J satisfies 0 ≤ J < τ / 2 and, apart from round-off, 2 J + δ ≤ τ
inline void validate(const Sampling<double>& sampling, const Jitter& jitter) {
  validate(sampling);
  const double half_width = jitter.half_width;
  require_non_negative("jitter half width", half_width, "s");
  // 2 · 0.1 + 0.1 exceeds 0.3 by one unit in the last place.
  const double room = sampling.period * (1 + 4 * std::numeric_limits<double>::epsilon());
  const bool keeps_order =
      half_width < sampling.period / 2 && 2 * half_width + sampling.processing_delay <= room;
  if (keeps_order) return;
  std::ostringstream admissible;
  admissible << "less than tau / 2 = " << sampling.period / 2
             << " and at most (tau - processing delay) / 2 = "
             << (sampling.period - sampling.processing_delay) / 2;
  throw InvalidParameter("jitter half width", half_width, "s", admissible.str());
}

namespace detail {

/// Output number `index` (1, 2, …) of the random generator SplitMix64 started from `seed`:
///
///     s = seed + index · γ,   s ← (s ⊕ s≫30) a,   s ← (s ⊕ s≫27) b,   s ⊕ s≫31   (mod 2⁶⁴)
///
/// with γ = 9e3779b97f4a7c15, a = bf58476d1ce4e5b9, b = 94d049bb133111eb (hexadecimal).
/// Source: G. L. Steele, D. Lea and C. H. Flood, Fast splittable pseudorandom number generators,
/// OOPSLA 2014; a and b are D. Stafford's thirteenth pair.
constexpr std::uint64_t split_mix_64(std::uint64_t seed, std::uint64_t index) {
  std::uint64_t state = seed + index * 0x9e3779b97f4a7c15U;
  state = (state ^ (state >> 30U)) * 0xbf58476d1ce4e5b9U;
  state = (state ^ (state >> 27U)) * 0x94d049bb133111ebU;
  return state ^ (state >> 31U);
}

}  // namespace detail

/// The sampling instants t_j of a clock with period τ and jitter of half width J:
///
///     t_j = j τ + e_j,   e_0 = 0,   e_j uniform over (−J, J) and independent, j = 1, 2, …
///
/// The deviations do not accumulate: |t_j − j τ| ≤ J for all j. e_j depends on the seed and on j
/// only, so that the instants may be computed in any order. Only integer arithmetic and correctly
/// rounded multiply-adds are used, so that the instants are the same on every machine. J = 0 gives
/// the grid j τ and the period τ without further rounding.
class SamplingClock {
 public:
  /// @param period  sampling period τ (s), > 0
  /// @param jitter  half width J < τ / 2, so that t_j increases with j; a processing delay δ also
  ///                needs 2 J + δ ≤ τ, which `validate(sampling, jitter)` checks
  /// @throws InvalidParameter where an argument is not admissible
  explicit SamplingClock(double period, const Jitter& jitter = {})
      : period_(period), jitter_(jitter) {
    validate(Sampling<double>{period}, jitter);
  }

  /// Instant t_j (s) of sample j = `index`, j ≥ 0.
  double time(std::int64_t index) const {
    const double on_grid = static_cast<double>(index) * period_;
    if (jitter_.half_width == 0) return on_grid;
    return std::fma(jitter_.half_width, share(index), on_grid);
  }

  /// The period t_{j+1} − t_j (s) after sample j = `index`, j ≥ 0. It is computed as τ + e_{j+1} −
  /// e_j, since a difference of two large instants would lose digits.
  double period_of(std::int64_t index) const {
    if (jitter_.half_width == 0) return period_;
    return std::fma(jitter_.half_width, share(index + 1) - share(index), period_);
  }

  /// Deviation e_j (s) of sample j = `index` from the grid, j ≥ 0.
  double deviation(std::int64_t index) const { return jitter_.half_width * share(index); }

  /// The nominal period τ (s).
  double period() const { return period_; }
  /// The half width J (s) and the seed of the deviations.
  const Jitter& jitter() const { return jitter_; }

 private:
  /// The deviation e_j of instant j from j τ, over its bound J: 0 for j = 0, else an odd multiple
  /// of 2⁻⁵³, symmetric about zero, so that the difference of two is exact.
  double share(std::int64_t index) const {
    if (index == 0) return 0;
    const std::uint64_t bits =
        detail::split_mix_64(jitter_.seed, static_cast<std::uint64_t>(index));
    constexpr std::int64_t half_range = std::int64_t{1} << 53U;
    const std::int64_t odd = static_cast<std::int64_t>((bits >> 10U) | 1U) - half_range;
    return static_cast<double>(odd) * 0x1.0p-53;
  }

  double period_;
  Jitter jitter_;
};

}  // namespace holdfast
