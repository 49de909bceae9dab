#pragma once

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>

#include "holdfast/control/gains.hpp"
#include "holdfast/control/loop_map.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/math/linalg/eigenvalue_derivative.hpp"
#include "holdfast/math/linalg/spectral_radius.hpp"
#include "holdfast/math/roots/first_crossing.hpp"
#include "holdfast/plant/linear_plant.hpp"
#include "holdfast/stability/margins/moving_root.hpp"

namespace holdfast {

namespace detail {

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

/// What is watched of a loop of any order: its roots, and 1 − Π(1 + λ_i) = 1 − det(I + S), which
/// leaves the inside where a real root passes −1 (`SamplingFamily::tracked_at`).
/// @param rate          of S, per unit of what varies
/// @param varies_period  whether that is τ
template <class Scalar>
TrackedPointSets tracked_roots(const LoopMap<Scalar>& map, const LoopMapDerivative<Scalar>& rate,
                               const PdGains<Scalar>& gains, bool varies_period) {
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

}  // namespace detail

/// A line through the samplings of a plant of any order, as `SamplingFamily` of the two masses: the
/// period τ, the delay keeping its share of it, or the delay δ at a fixed period, as long as the
/// number of commands on their way stays.
/// @tparam Plant  any order; its ports say what is measured
template <class Plant>
class MapFamily {
 public:
  /// τ varies, δ = delay_fraction · τ.
  /// @param plant           within its ranges, which are not checked here
  /// @param delay_fraction  ≥ 0
  static MapFamily of_period(const Plant& plant, double delay_fraction) {
    return {plant, 0.0, delay_fraction, held_commands({1.0, delay_fraction})};
  }

  /// δ varies from (k − 1) τ to k τ.
  /// @param plant   within its ranges, which are not checked here
  /// @param period  τ (s), > 0
  /// @param held    k, ≥ 1
  static MapFamily of_delay(const Plant& plant, double period, int held = 1) {
    return {plant, period, 0.0, held};
  }

  /// The sampling at a position (s): τ, or δ at the fixed period.
  Sampling<double> at(double position) const {
    if (fixed_period_ > 0.0) return {fixed_period_, position};
    return {position, delay_fraction_ * position};
  }

  /// The loop's map at a position (s); costs two matrix exponentials.
  LoopMap<double> loop_at(double position) const {
    return detail::loop_map_keeping<Plant, double>(plant_, at(position), held_);
  }

  /// How the map moves along the path, per second of it.
  LoopMapDerivative<double> rate(const LoopMap<double>& map) const {
    return varies_period() ? loop_map_derivative(plant_, map, 1.0, delay_fraction_)
                           : loop_map_derivative(plant_, map, 0.0, 1.0);
  }

  /// The loop's roots λ and how they move along the path, and 1 − Π(1 + λ_i), which leaves the
  /// inside where a real root passes −1. Stable ⇔ all inside the unit circle.
  TrackedPointSets tracked_at(const LoopMap<double>& map, const PdGains<double>& gains) const {
    return detail::tracked_roots<double>(map, rate(map), gains, varies_period());
  }

  /// True on a path of τ, false on one of δ.
  bool varies_period() const { return !(fixed_period_ > 0.0); }

 private:
  MapFamily(const Plant& plant, double fixed_period, double delay_fraction, int held)
      : plant_(plant), fixed_period_(fixed_period), delay_fraction_(delay_fraction), held_(held) {}

  Plant plant_;
  double fixed_period_;  // 0 where the period varies
  double delay_fraction_;
  int held_;
};

#ifdef HOLDFAST_EXTERN_TEMPLATES
namespace detail {
extern template TrackedPointSets tracked_roots(const LoopMap<double>&,
                                               const LoopMapDerivative<double>&,
                                               const PdGains<double>&, bool);
extern template double loop_excess(const LoopMap<double>&, const PdGains<double>&);
}  // namespace detail
extern template class MapFamily<LinearPlant<double>>;
#endif

}  // namespace holdfast
