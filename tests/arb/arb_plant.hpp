#pragma once

#include <acb_mat.h>

#include "arb/arb_loop.hpp"
#include "holdfast/math/enclosure/complex_enclosure.hpp"
#include "holdfast/plant/linear_plant.hpp"

namespace holdfast::test {

/// A complex ball of Arb, whose memory is its own.
class ComplexBall {
 public:
  ComplexBall() { acb_init(ball_); }
  explicit ComplexBall(const std::complex<double>& exact) : ComplexBall() {
    acb_set_d_d(ball_, exact.real(), exact.imag());
  }
  ComplexBall(const ComplexBall& other) : ComplexBall() { acb_set(ball_, other.ball_); }
  ComplexBall& operator=(const ComplexBall& other) {
    acb_set(ball_, other.ball_);
    return *this;
  }
  ~ComplexBall() { acb_clear(ball_); }

  acb_ptr get() { return ball_; }
  acb_srcptr get() const { return ball_; }

  /// Whether the whole ball lies in a disc.
  bool is_in(const ComplexEnclosure& disc) const {
    ComplexBall away;
    Ball distance;
    acb_sub(away.ball_, ball_, ComplexBall(disc.middle()).ball_, arb_bits);
    acb_abs(distance.get(), away.ball_, arb_bits);
    return arb_le(distance.get(), Ball(disc.radius()).get()) != 0;
  }

 private:
  acb_t ball_;
};

/// e^z.
inline ComplexBall exponential(const std::complex<double>& z) {
  ComplexBall result;
  acb_exp(result.get(), ComplexBall(z).get(), arb_bits);
  return result;
}

/// The roots of a real polynomial, all of them isolated, or none.
inline std::vector<ComplexBall> roots_of(const std::vector<Ball>& coefficients) {
  const auto degree = static_cast<slong>(coefficients.size()) - 1;
  acb_poly_t polynomial;
  acb_poly_init(polynomial);
  for (slong k = 0; k <= degree; ++k) {
    ComplexBall coefficient;
    acb_set_arb(coefficient.get(), coefficients[static_cast<std::size_t>(k)].get());
    acb_poly_set_coeff_acb(polynomial, k, coefficient.get());
  }
  acb_ptr found = _acb_vec_init(degree);
  std::vector<ComplexBall> roots;
  if (acb_poly_find_roots(found, polynomial, nullptr, 200, arb_bits) == degree) {
    roots.resize(static_cast<std::size_t>(degree));
    for (slong k = 0; k < degree; ++k) acb_set(roots[static_cast<std::size_t>(k)].get(), found + k);
  }
  _acb_vec_clear(found, degree);
  acb_poly_clear(polynomial);
  return roots;
}

/// A plant whose numbers are doubles, and what is sampled of it at times that are doubles.
class SampledBalls {
 public:
  /// @param plant  of dynamic order
  /// @param tau    sampling period
  /// @param late   δ′, 0 … τ
  SampledBalls(const LinearPlant<double>& plant, double tau, double late)
      : order_(plant.order()), map_(order_ + 2) {
    const BallMatrix before = held(plant, Ball(late)).exponential();
    const BallMatrix after = held(plant, Ball(tau) - Ball(late)).exponential();
    // x⁺ = A_d x + Γ₁ u⁻ + Γ₀ u, in the columns of x, u⁻ and u.
    for (slong i = 0; i < order_; ++i) {
      Ball past;
      for (slong j = 0; j < order_; ++j) {
        Ball entry;
        for (slong k = 0; k < order_; ++k) entry = entry + after.at(i, k) * before.at(k, j);
        map_.set(i, j, entry);
        past = past + after.at(i, j) * before.at(j, order_);
      }
      map_.set(i, order_, past);
      map_.set(i, order_ + 1, after.at(i, order_));
    }
  }

  slong order() const { return order_; }
  /// A_d, Γ₁ and Γ₀ beside each other.
  const BallMatrix& map() const { return map_; }

  /// h (λI − A_d)⁻¹ (λ Γ₀ + Γ₁), F of a reading h.
  ComplexBall response(const RowVector<double, Eigen::Dynamic>& reading,
                       const std::complex<double>& lambda) const {
    acb_mat_t matrix, right;
    acb_mat_init(matrix, order_, order_);
    acb_mat_init(right, order_, 1);
    const ComplexBall point(lambda);
    for (slong i = 0; i < order_; ++i) {
      for (slong j = 0; j < order_; ++j)
        acb_set_arb(acb_mat_entry(matrix, i, j), (Ball() - map_.at(i, j)).get());
      acb_add(acb_mat_entry(matrix, i, i), acb_mat_entry(matrix, i, i), point.get(), arb_bits);
      acb_ptr entry = acb_mat_entry(right, i, 0);
      acb_mul_arb(entry, point.get(), map_.at(i, order_ + 1).get(), arb_bits);
      acb_add_arb(entry, entry, map_.at(i, order_).get(), arb_bits);
    }
    acb_mat_solve(right, matrix, right, arb_bits);
    ComplexBall sum;
    for (slong i = 0; i < order_; ++i)
      acb_addmul_arb(sum.get(), acb_mat_entry(right, i, 0), Ball(reading[i]).get(), arb_bits);
    acb_mat_clear(matrix);
    acb_mat_clear(right);
    return sum;
  }

 private:
  /// [A b; 0 0] t.
  BallMatrix held(const LinearPlant<double>& plant, const Ball& time) const {
    const Matrix<double, Eigen::Dynamic> state = plant.state_matrix();
    const Vector<double, Eigen::Dynamic> input = plant.control_input();
    BallMatrix result(order_ + 1);
    for (slong i = 0; i < order_; ++i) {
      for (slong j = 0; j < order_; ++j) result.set(i, j, Ball(state(i, j)) * time);
      result.set(i, order_, Ball(input[i]) * time);
    }
    return result;
  }

  slong order_;
  BallMatrix map_;
};

}  // namespace holdfast::test
