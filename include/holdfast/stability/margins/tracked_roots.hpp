#pragma once

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "holdfast/control/gains.hpp"
#include "holdfast/control/loop_map.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/math/linalg/eigenvalue_derivative.hpp"
#include "holdfast/math/linalg/spectral_radius.hpp"
#include "holdfast/math/roots/first_crossing.hpp"
#include "holdfast/plant/ports.hpp"
#include "holdfast/stability/polynomial/characteristic_polynomial.hpp"
#include "holdfast/stability/polynomial/loop_derivatives.hpp"
#include "holdfast/stability/polynomial/loop_polynomial.hpp"
#include "holdfast/stability/polynomial/root_sensitivity.hpp"

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

/// λ − 1 of all roots of the two masses' loop.
template <class Scalar>
std::vector<std::complex<Scalar>> roots_from_one(const SampledLoop<Scalar>& loop,
                                                 const PdGains<Undeduced<Scalar>>& gains) {
  return roots(characteristic_polynomial(loop).at(gains));
}

/// ρ − 1 of the two masses' loop.
template <class Scalar>
Scalar loop_excess(const SampledLoop<Scalar>& loop, const PdGains<Undeduced<Scalar>>& gains) {
  return loop_polynomial(loop).excess(gains);
}

/// The roots of a loop of any order, given by μ = λ − 1 so that nothing is lost where sampling is
/// fast.
template <class Scalar>
Vector<std::complex<Scalar>, Eigen::Dynamic> roots_from_one(const LoopMap<Scalar>& map,
                                                            const PdGains<Scalar>& gains) {
  return balanced_eigenvalues<Scalar, Eigen::Dynamic>(map.closed_increment(gains));
}

/// |1 + μ| − 1 without cancellation.
template <class Scalar>
Scalar excess_from_one(const std::complex<Scalar>& mu) {
  return (Scalar(2) * mu.real() + std::norm(mu)) / (Scalar(1) + std::abs(Scalar(1) + mu));
}

/// ρ − 1 of a loop of any order.
template <class Scalar>
Scalar loop_excess(const LoopMap<Scalar>& map, const PdGains<Scalar>& gains) {
  Scalar largest(-1);
  for (const std::complex<Scalar>& mu : roots_from_one(map, gains))
    largest = std::max(largest, excess_from_one(mu));
  return largest;
}

/// What is watched along a line through the samplings: the roots, on spirals (`moving_loop_root`)
/// where τ varies, and beside them what vanishes where a real root passes −1, Π (1 + λ_i) = −p(−1).
///
/// A pair that meets on the real axis near −1, sends one root through −1 and takes it back leaves
/// no trace in the roots' speeds before and after; that product is smooth all the way. It is
/// watched as the point 1 − Π, which lies inside as long as the product is positive.
/// @param rate          of the loop's matrices, per unit of what varies
/// @param varies_period  whether that is τ
template <class Scalar>
TrackedPointSets tracked_roots(const SampledLoop<Scalar>& loop,
                               const BasicLoopDerivative<Scalar>& rate,
                               const PdGains<Undeduced<Scalar>>& gains, bool varies_period) {
  const auto polynomial = characteristic_polynomial(dual_loop<1>(loop, {rate}));
  TrackedPoints points;
  for (const RootSensitivity<1>& root : root_sensitivities<1>(polynomial, gains)) {
    points.push_back(moving_loop_root(root.value(), root.rates[0], root.logarithm(), root.excess(),
                                      varies_period, loop.sampling.period));
  }
  const auto dual =
      polynomial.at({DualNumber<1>(gains.proportional), DualNumber<1>(gains.differential)});
  const double product = -evaluate(values_of<1, 5>(dual), -2.0);
  const double slope = -evaluate(derivative_of<1, 5>(dual, 0), -2.0);
  return {points, {TrackedPoint{1.0 - product, -slope, 0.0, false, -product}}};
}

/// The same of a loop of any order, 1 − Π being 1 − det(I + S).
template <class Scalar>
TrackedPointSets tracked_roots(const LoopMap<Scalar>& map, const LoopMapDerivative<Scalar>& rate,
                               const PdGains<Undeduced<Scalar>>& gains, bool varies_period) {
  using Square = Matrix<Scalar, Eigen::Dynamic>;
  const Square increment = map.closed_increment(gains), moved = rate.closed_map(map, gains);
  TrackedPoints points;
  for (const std::complex<Scalar>& mu : balanced_eigenvalues<Scalar, Eigen::Dynamic>(increment)) {
    const Scalar square = Scalar(2) * mu.real() + std::norm(mu);  // |λ|² − 1
    const std::complex<Scalar> value = Scalar(1) + mu;
    const Scalar logarithm =
        square > Scalar(-0.5) ? Scalar(0.5) * std::log1p(square) : std::log(std::abs(value));
    points.push_back(moving_loop_root(value, eigenvalue_derivative(increment, moved, mu), logarithm,
                                      excess_from_one(mu), varies_period, map.sampling.period));
  }
  const Square sum = increment + Scalar(2) * Square::Identity(map.size(), map.size());
  const Eigen::PartialPivLU<Square> factors(sum);
  const Scalar product = factors.determinant();
  const Scalar slope = product * factors.solve(moved).trace();
  return {points, {TrackedPoint{Scalar(1) - product, -slope, 0.0, false, -product}}};
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template TrackedPointSets tracked_roots(const SampledLoop<double>&, const LoopDerivative&,
                                               const PdGains<double>&, bool);
extern template TrackedPointSets tracked_roots(const LoopMap<double>&,
                                               const LoopMapDerivative<double>&,
                                               const PdGains<double>&, bool);
extern template double loop_excess(const LoopMap<double>&, const PdGains<double>&);
#endif

}  // namespace holdfast::detail
