#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "holdfast/cable/conductor.hpp"
#include "holdfast/core/types.hpp"

namespace holdfast {

/// Symmetry of an in-plane mode about mid-span.
enum class ModeFamily {
  symmetric,      ///< the mode stretches the cable; its frequency depends on Irvine's λ²
  antisymmetric,  ///< no stretch to first order; the frequency is that of the taut string
};

/// One in-plane mode of a shallow cable.
struct CableMode {
  ModeFamily family;               ///< symmetry of the mode, see shape()
  double dimensionless_frequency;  ///< dimensionless frequency ω̄ = ω L/√(H/μ), > 0
  double frequency;                ///< natural frequency ω/2π (Hz)

  /// Vertical shape at `place` x̂ = x/L, 0 … 1, with largest magnitude near 1: sin(ω̄ x̂) of an
  /// antisymmetric mode, [cos(ω̄/2) − cos(ω̄/2 − ω̄ x̂)]/(1 + |cos(ω̄/2)|) of a symmetric one. The
  /// latter is Irvine's shape, scaled to be finite at cos(ω̄/2) = 0 too, the case of a taut string.
  double shape(double place) const {
    if (family == ModeFamily::antisymmetric) return std::sin(dimensionless_frequency * place);
    const double half = dimensionless_frequency / 2, at_support = std::cos(half);
    return (at_support - std::cos(half - dimensionless_frequency * place)) /
           (1.0 + std::abs(at_support));
  }
};

/// The dimensionless frequency ω̄ = ω L/√(H/μ) of the n-th symmetric mode, n ≥ 1, for Irvine's
/// parameter λ² > 0. With y = ω̄/2 it is the root between (n − 1/2) π and (n + 1/2) π of
///
///     tan y = y − (4/λ²) y³.
///
/// Bisection finds it for every λ² > 0 from the equation times cos y. Source: H. M. Irvine, T. K.
/// Caughey, The linear theory of free vibrations of a suspended cable, Proc. R. Soc. A 341 (1974).
template <class Scalar>
Scalar symmetric_frequency(int n, const Scalar& irvine_parameter) {
  const auto residual = [irvine_parameter](const Scalar& y) {
    return std::sin(y) - (y - Scalar(4) / irvine_parameter * y * y * y) * std::cos(y);
  };
  const Scalar half(0.5);
  Scalar below = (Scalar(n) - half) * pi<Scalar>, above = (Scalar(n) + half) * pi<Scalar>;
  const bool rising = n % 2 == 0;  // sin(below) = −1 for even n
  while (true) {
    const Scalar middle = half * (below + above);
    if (middle <= below || middle >= above) return Scalar(2) * middle;
    const bool left_of_root = (residual(middle) < Scalar(0)) == rising;
    (left_of_root ? below : above) = middle;
  }
}

/// The `count` lowest in-plane modes of a conductor as a shallow cable (Irvine's linear theory), in
/// ascending order of frequency. Of two equal frequencies the symmetric mode comes first.
/// @throws InvalidParameter for an inadmissible conductor, or a count outside 1 … 10⁵
inline std::vector<CableMode> irvine_modes(const Conductor<double>& conductor, int count) {
  validate(conductor);
  require_within("number of modes", count, "", 1, 100000);
  const double to_hertz = conductor.transverse_wave_speed() / conductor.span / (2.0 * pi<double>);
  std::vector<CableMode> modes;
  for (int n = 1; n <= count; ++n) {
    const double symmetric = symmetric_frequency(n, conductor.irvine_parameter());
    const double antisymmetric = 2.0 * n * pi<double>;
    modes.push_back({ModeFamily::symmetric, symmetric, symmetric * to_hertz});
    modes.push_back({ModeFamily::antisymmetric, antisymmetric, antisymmetric * to_hertz});
  }
  std::stable_sort(modes.begin(), modes.end(), [](const CableMode& a, const CableMode& b) {
    return a.dimensionless_frequency < b.dimensionless_frequency;
  });
  modes.resize(static_cast<std::size_t>(count));
  return modes;
}

}  // namespace holdfast
