#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <vector>

#include "holdfast/control/gains.hpp"
#include "holdfast/control/loop_map.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/math/linalg/balancing.hpp"
#include "holdfast/math/linalg/moving_spectrum.hpp"
#include "holdfast/math/linalg/spectral_radius.hpp"
#include "holdfast/math/roots/first_crossing.hpp"
#include "holdfast/plant/linear_plant.hpp"
#include "holdfast/plant/ports.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "holdfast/stability/polynomial/characteristic_polynomial.hpp"
#include "holdfast/stability/polynomial/loop_polynomial.hpp"

namespace holdfast {

namespace detail {

/// The offsets λ − 1 of all roots of the two masses' loop.
template <class Scalar>
std::vector<std::complex<Scalar>> roots_from_one(const SampledLoop<Scalar>& loop,
                                                 const PdGains<Undeduced<Scalar>>& gains) {
  return roots(characteristic_polynomial(loop).at(gains));
}

/// The excess ρ − 1 of the spectral radius of the two masses' loop.
template <class Scalar>
Scalar loop_excess(const SampledLoop<Scalar>& loop, const PdGains<Undeduced<Scalar>>& gains) {
  return loop_polynomial(loop).excess(gains);
}

/// The offsets μ = λ − 1 of a loop's roots, which lose no digits with fast sampling.
template <class Scalar>
Vector<std::complex<Scalar>, Eigen::Dynamic> roots_from_one(const LoopMap<Scalar>& map,
                                                            const PdGains<Scalar>& gains) {
  return balanced_eigenvalues<Scalar, Eigen::Dynamic>(map.closed_increment(gains));
}

/// The excess ρ − 1 of a loop's spectral radius; |1 + μ| − 1 is computed without cancellation.
template <class Scalar>
Scalar loop_excess(const LoopMap<Scalar>& map, const PdGains<Scalar>& gains) {
  Scalar largest(-1);
  for (const std::complex<Scalar>& mu : roots_from_one(map, gains))
    largest = std::max(
        largest, (Scalar(2) * mu.real() + std::norm(mu)) / (Scalar(1) + std::abs(Scalar(1) + mu)));
  return largest;
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template double loop_excess(const LoopMap<double>&, const PdGains<double>&);
#endif

}  // namespace detail

/// One-parameter family of samplings of a plant. Its parameter, the position (s), is the period τ
/// with constant δ/τ, or the delay δ with constant τ. The number k of delayed commands is constant.
/// @tparam Plant  two masses (the loop is a `SampledLoop`), or a plant of any order with `Ports`
///                (the loop is a `LoopMap`)
template <class Plant>
class SamplingFamily {
 public:
  /// The family with varying period τ and δ = `delay_fraction` · τ.
  /// @param plant           plant within its ranges, which are not checked here
  /// @param delay_fraction  ratio δ/τ, 0 … 1 for two masses, ≥ 0 for a plant with ports
  static SamplingFamily of_period(const Plant& plant, double delay_fraction) {
    return {plant, 0.0, delay_fraction, holdfast::held_commands({1.0, delay_fraction})};
  }

  /// The family with varying delay δ from (k − 1) τ to k τ.
  /// @param plant   plant within its ranges, which are not checked here
  /// @param period  constant τ (s), > 0
  /// @param held    number k of delayed commands, 1 for two masses, ≥ 1 for a plant with ports
  static SamplingFamily of_delay(const Plant& plant, double period, int held = 1) {
    return {plant, period, 0.0, held};
  }

  /// The sampling at a position (s), which is its τ or its δ.
  Sampling<double> at(double position) const {
    if (fixed_period_ > 0.0) return {fixed_period_, position};
    return {position, delay_fraction_ * position};
  }

  /// The loop of the plant at a position (s). Work: two matrix exponentials.
  auto loop_at(double position) const {
    if constexpr (has_closed_forms<Plant>) {
      return sampled_loop(plant_, at(position));
    } else {
      return map_at(position);
    }
  }

  /// The `LoopMap` of the plant's loop at a position (s).
  LoopMap<double> map_at(double position) const {
    return detail::loop_map_keeping<Plant, double>(plant_, at(position), held_);
  }

  /// The derivative of τ with respect to the position: 1 if the position is τ, 0 if it is δ.
  double period_rate() const { return fixed_period_ > 0.0 ? 0.0 : 1.0; }
  /// The derivative with respect to the position of k τ − δ, the time a command acts in a sample.
  double action_rate() const { return fixed_period_ > 0.0 ? -1.0 : held_ - delay_fraction_; }

  /// The Taylor series of the closed loop's map in x = (position − centre)/radius, |x| ≤ 1, up to
  /// x¹². The plant has the state matrix A and the control input b; h = k τ − δ, and ′ is the
  /// derivative with respect to the position. The map's rows of the plant's states contain A_d, Γ₁
  /// and Γ₀ of `LoopMap` (k = 1: Γ₀ K, K: feedback row). The j-th derivative of [A_d, Γ₁, Γ₀] is
  ///
  ///     A^{j−1} ((τ′)ʲ [A A_d, A_d b, 0] + (h′)ʲ e^{Ah} b [0, −1, 1]),   j ≥ 1
  ///
  /// The remainder is a bound of the omitted terms by a geometric series; ∞ if the series diverges.
  /// @param map     map of `map_at` at the centre
  /// @param gains   P (N/m) and D (N s/m)
  /// @param radius  half width (s) of the interval of positions, ≥ 0
  TaylorMatrix moving(const LoopMap<double>& map, const PdGains<double>& gains,
                      double radius) const {
    constexpr int order = 12;
    const Eigen::Index size = map.size(), n = size - map.held_commands;
    const Eigen::MatrixXd a = plant_.state_matrix();
    Eigen::MatrixXd by_period = period_rate() * rate_by_period(map);
    Eigen::MatrixXd by_action = action_rate() * rate_by_action(map, gains);
    TaylorMatrix result{{map.closed_increment(gains)}, Eigen::MatrixXd::Zero(size, size)};
    double factor = radius;  // radiusʲ/j!
    for (int j = 1; j <= order; ++j) {
      result.terms.emplace_back(Eigen::MatrixXd::Zero(size, size));
      result.terms.back().topRows(n) = factor * (by_period + by_action);
      by_period = period_rate() * (a * by_period).eval();
      by_action = action_rate() * (a * by_action).eval();
      factor *= radius / (j + 1);
    }
    const BalancedMatrix<double, Eigen::Dynamic> similar(a);
    const double ratio =
        similar.balanced.cwiseAbs().rowwise().sum().maxCoeff() * radius / (order + 2);
    const double tail =
        ratio < 1.0 ? factor / (1.0 - ratio) : std::numeric_limits<double>::infinity();
    const Eigen::RowVectorXd next = (similar.factors.cwiseInverse().asDiagonal() *
                                     (by_period.cwiseAbs() + by_action.cwiseAbs()))
                                        .colwise()
                                        .maxCoeff();
    result.remainder.topRows(n) = tail * similar.factors * next;
    return result;
  }

  /// The Taylor series of `LoopMap::command`, with arguments and symbols as in `moving`. For k = 1
  /// the plant's rows are Γ₀, with j-th derivative A^{j−1} (h′)ʲ e^{Ah} b; else it is constant.
  MovingVector moving_command(const LoopMap<double>& map, double radius) const {
    // The map with feedback from state 0 alone: the bound of its first column holds for s.
    const Eigen::Index size = map.size(), n = size - map.held_commands;
    LoopMap<double> alone = map;
    alone.displacement = Eigen::RowVectorXd::Zero(size);
    alone.velocity = Eigen::RowVectorXd::Unit(size, 0);
    const TaylorMatrix fed = moving(alone, {0.0, 1.0}, radius);
    MovingVector result{{map.command.cast<std::complex<double>>()},
                        fed.remainder.rowwise().maxCoeff()};
    const Eigen::MatrixXd a = plant_.state_matrix();
    Eigen::VectorXd moved = Eigen::VectorXd::Zero(n);
    if (map.held_commands == 1) moved = plant_.control_input() + a * map.command.head(n);
    for (std::size_t j = 1; j < fed.terms.size(); ++j) {
      moved *= action_rate() * radius / static_cast<double>(j);
      result.terms.emplace_back(Eigen::VectorXcd::Zero(size));
      result.terms.back().head(n) = moved.cast<std::complex<double>>();
      moved = a * moved.eval();
    }
    return result;
  }

  /// Result of a proof of stability at all positions within `radius` (s) of `centre` (s): proved
  /// (`holds`), undecided (`open`), or not stable at the centre (`fails`).
  Stretch stability(const PdGains<double>& gains, double centre, double radius) const {
    const MovingSpectrum roots(moving(map_at(centre), gains, radius));
    return roots.inside()             ? Stretch::holds
           : roots.inside_at_centre() ? Stretch::open
                                      : Stretch::fails;
  }

 private:
  /// The matrix [A A_d, A_d b, 0], N × (N + k), the factor of (τ′)ʲ in `moving`.
  Eigen::MatrixXd rate_by_period(const LoopMap<double>& map) const {
    const Eigen::Index size = map.size(), n = size - map.held_commands;
    const Eigen::MatrixXd transition = map.open_map.topLeftCorner(n, n);
    Eigen::MatrixXd rate = Eigen::MatrixXd::Zero(n, size);
    rate.leftCols(n) = plant_.state_matrix() * transition;
    rate.col(n) = transition * plant_.control_input();
    return rate;
  }

  /// The factor e^{Ah} b [0, −1, 1] of (h′)ʲ in `moving`, N × (N + k); K replaces the 1 for k = 1.
  Eigen::MatrixXd rate_by_action(const LoopMap<double>& map, const PdGains<double>& gains) const {
    const Eigen::Index k = map.held_commands, size = map.size(), n = size - k;
    const Eigen::VectorXd present =
        (k == 1 ? map.command : Eigen::VectorXd(map.open_map.col(n + 1))).head(n);
    Eigen::RowVectorXd fed = Eigen::RowVectorXd::Unit(size, k == 1 ? n : n + 1);
    if (k == 1) fed = gains.proportional * map.displacement + gains.differential * map.velocity;
    fed[n] -= 1.0;
    return (plant_.control_input() + plant_.state_matrix() * present) * fed;
  }

  SamplingFamily(const Plant& plant, double fixed_period, double delay_fraction, int held)
      : plant_(plant), fixed_period_(fixed_period), delay_fraction_(delay_fraction), held_(held) {}

  Plant plant_;
  double fixed_period_;  // 0 where the period varies
  double delay_fraction_;
  int held_;
};

}  // namespace holdfast
