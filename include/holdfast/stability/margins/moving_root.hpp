#pragma once

#include <cmath>
#include <complex>

#include "holdfast/core/types.hpp"
#include "holdfast/math/roots/first_crossing.hpp"

namespace holdfast::detail {

/// A root λ of a sampled loop that moves with τ or δ, as `first_crossing` watches it; on a spiral
/// where τ varies and the root has not decayed within a sample.
///
/// Roots e^{sτ} are expected on a spiral: with σ = ln λ/τ, of which a root of the plant itself does
/// not move at all, σ is continued as a straight line,
///
///     ln λ(τ + Δ) = (σ + σ′Δ)(τ + Δ),   σ′ = (λ′/λ − σ)/τ
///
/// and of the branches of the logarithm the one is meant whose σ is nearest to λ′/λ.
/// @param rate       λ′; one that is no number, at a multiple root, counts as 0: the other end of a
///                   step must then tell
/// @param logarithm  ln |λ|
/// @param excess     |λ| − 1
/// @param spiral     whether τ varies
inline TrackedPoint moving_loop_root(const std::complex<double>& value,
                                     const std::complex<double>& rate, double logarithm,
                                     double excess, bool spiral, double period) {
  const bool finite = std::isfinite(rate.real()) && std::isfinite(rate.imag());
  spiral = spiral && std::abs(value) > 0.3;
  TrackedPoint point{value, finite ? rate : 0.0, 0.0, spiral, excess};
  if (spiral) {
    point.rate /= value;
    const double turns =
        std::round((point.rate.imag() * period - std::arg(value)) / (2.0 * pi<double>));
    const std::complex<double> sigma =
        std::complex<double>(logarithm, std::arg(value) + 2.0 * pi<double> * turns) / period;
    point.bend = (point.rate - sigma) / period;
  }
  return point;
}

}  // namespace holdfast::detail
