#pragma once

#include <acb_poly.h>
#include <arb_mat.h>

#include <array>
#include <string>
#include <vector>

#include "holdfast/math/enclosure/enclosure.hpp"

namespace holdfast::test {

/// Digits in which Arb computes: far beyond those of a double. Balls of long products widen by
/// about a bit a factor, and take more.
inline slong arb_bits = 200;

/// A ball of Arb, whose memory is its own.
class Ball {
 public:
  Ball() { arb_init(ball_); }
  explicit Ball(double exact) : Ball() { arb_set_d(ball_, exact); }
  /// Of a decimal number as it is written.
  explicit Ball(const std::string& decimal) : Ball() {
    arb_set_str(ball_, decimal.c_str(), arb_bits);
  }
  Ball(const Ball& other) : Ball() { arb_set(ball_, other.ball_); }
  Ball& operator=(const Ball& other) {
    arb_set(ball_, other.ball_);
    return *this;
  }
  ~Ball() { arb_clear(ball_); }

  arb_ptr get() { return ball_; }
  arb_srcptr get() const { return ball_; }

  friend Ball operator+(const Ball& a, const Ball& b) { return by(arb_add, a, b); }
  friend Ball operator-(const Ball& a, const Ball& b) { return by(arb_sub, a, b); }
  friend Ball operator*(const Ball& a, const Ball& b) { return by(arb_mul, a, b); }
  friend Ball operator/(const Ball& a, const Ball& b) { return by(arb_div, a, b); }

  /// cos 2π p/q.
  static Ball cosine_of_turn(slong p, slong q) {
    Ball angle(2.0 * static_cast<double>(p % q)), result;
    angle = angle / Ball(static_cast<double>(q));
    arb_cos_pi(result.ball_, angle.ball_, arb_bits);
    return result;
  }

  bool is_positive() const { return arb_is_positive(ball_) != 0; }
  bool is_negative() const { return arb_is_negative(ball_) != 0; }
  /// Whether |x| ≤ bound for all of it.
  bool is_within(double bound) const { return is_in(Enclosure(-bound, bound)); }

  /// Whether the whole ball lies in an enclosure.
  bool is_in(const Enclosure& enclosure) const {
    return arb_ge(ball_, Ball(enclosure.lower()).ball_) != 0 &&
           arb_le(ball_, Ball(enclosure.upper()).ball_) != 0;
  }

 private:
  using Operation = void (*)(arb_t, const arb_t, const arb_t, slong);
  static Ball by(Operation operation, const Ball& a, const Ball& b) {
    Ball result;
    operation(result.ball_, a.ball_, b.ball_, arb_bits);
    return result;
  }

  arb_t ball_;
};

/// A square matrix of balls.
class BallMatrix {
 public:
  explicit BallMatrix(slong size) : size_(size) { arb_mat_init(matrix_, size, size); }
  BallMatrix(const BallMatrix& other) : BallMatrix(other.size_) {
    arb_mat_set(matrix_, other.matrix_);
  }
  BallMatrix& operator=(const BallMatrix&) = delete;
  ~BallMatrix() { arb_mat_clear(matrix_); }

  slong size() const { return size_; }
  friend BallMatrix operator*(const BallMatrix& a, const BallMatrix& b) {
    BallMatrix result(a.size_);
    arb_mat_mul(result.matrix_, a.matrix_, b.matrix_, arb_bits);
    return result;
  }
  /// (I − M)⁻¹ g; false where Arb cannot tell that it exists.
  bool solve_fixed_point(const std::vector<Ball>& g, std::vector<Ball>& x) const {
    arb_mat_t left, right, solution;
    arb_mat_init(left, size_, size_);
    arb_mat_init(right, size_, 1);
    arb_mat_init(solution, size_, 1);
    arb_mat_one(left);
    arb_mat_sub(left, left, matrix_, arb_bits);
    for (slong i = 0; i < size_; ++i)
      arb_set(arb_mat_entry(right, i, 0), g[static_cast<std::size_t>(i)].get());
    const bool solved = arb_mat_solve(solution, left, right, arb_bits) != 0;
    for (slong i = 0; i < size_ && solved; ++i)
      arb_set(x[static_cast<std::size_t>(i)].get(), arb_mat_entry(solution, i, 0));
    arb_mat_clear(left);
    arb_mat_clear(right);
    arb_mat_clear(solution);
    return solved;
  }
  Ball at(slong row, slong column) const {
    Ball entry;
    arb_set(entry.get(), arb_mat_entry(matrix_, row, column));
    return entry;
  }
  void set(slong row, slong column, const Ball& entry) {
    arb_set(arb_mat_entry(matrix_, row, column), entry.get());
  }

  BallMatrix exponential() const {
    BallMatrix result(size_);
    arb_mat_exp(result.matrix_, matrix_, arb_bits);
    return result;
  }

  /// Coefficients of det(λI − M) in powers of λ − centre, constant term first.
  std::vector<Ball> characteristic_polynomial(double centre) const {
    arb_poly_t polynomial;
    arb_poly_init(polynomial);
    arb_mat_charpoly(polynomial, matrix_, arb_bits);
    arb_poly_taylor_shift(polynomial, polynomial, Ball(centre).get(), arb_bits);
    std::vector<Ball> coefficients(static_cast<std::size_t>(size_ + 1));
    for (slong k = 0; k <= size_; ++k)
      arb_poly_get_coeff_arb(coefficients[static_cast<std::size_t>(k)].get(), polynomial, k);
    arb_poly_clear(polynomial);
    return coefficients;
  }

 private:
  slong size_;
  arb_mat_t matrix_;
};

/// A column of balls.
using BallVector = std::vector<Ball>;

inline BallVector operator*(const BallMatrix& matrix, const BallVector& vector) {
  BallVector result(vector.size());
  for (slong i = 0; i < matrix.size(); ++i)
    for (slong j = 0; j < matrix.size(); ++j) {
      const auto row = static_cast<std::size_t>(i), column = static_cast<std::size_t>(j);
      result[row] = result[row] + matrix.at(i, j) * vector[column];
    }
  return result;
}

/// How many roots of a real polynomial have a modulus below 1, and how many one above.
struct RootCount {
  int inside = 0, outside = 0;
};

/// Of roots that Arb has isolated; those that it cannot are counted nowhere.
inline RootCount count_roots(const std::vector<Ball>& coefficients) {
  const auto degree = static_cast<slong>(coefficients.size()) - 1;
  acb_poly_t polynomial;
  acb_poly_init(polynomial);
  acb_t coefficient;
  acb_init(coefficient);
  for (slong k = 0; k <= degree; ++k) {
    acb_set_arb(coefficient, coefficients[static_cast<std::size_t>(k)].get());
    acb_poly_set_coeff_acb(polynomial, k, coefficient);
  }
  acb_ptr roots = _acb_vec_init(degree);
  const slong isolated = acb_poly_find_roots(roots, polynomial, nullptr, 100, arb_bits);
  RootCount count;
  Ball modulus;
  for (slong k = 0; k < isolated && isolated == degree; ++k) {
    acb_abs(modulus.get(), roots + k, arb_bits);
    count.inside += arb_lt(modulus.get(), Ball(1.0).get());
    count.outside += arb_gt(modulus.get(), Ball(1.0).get());
  }
  _acb_vec_clear(roots, degree);
  acb_clear(coefficient);
  acb_poly_clear(polynomial);
  return count;
}

/// The sampled loop of two masses, of decimals as they are written.
struct DecimalLoop {
  std::array<std::string, 6> masses;  ///< m1, k1, c1, m2, k2, c2
  std::string period, delay;          ///< tau, delta

  /// S of Kollár 2022, Eq. (14), by its definition.
  BallMatrix map(const Ball& p, const Ball& d) const {
    const Ball tau(period), delta(delay);
    const BallMatrix before = held(delta).exponential(), after = held(tau - delta).exponential();
    const std::array<Ball, 4> gains{p, d, Ball(), Ball()};
    BallMatrix result(5);
    for (slong i = 0; i < 4; ++i) {
      Ball previous;
      for (slong j = 0; j < 4; ++j) {
        Ball entry = after.at(i, 4) * gains[static_cast<std::size_t>(j)];
        for (slong k = 0; k < 4; ++k) entry = entry + after.at(i, k) * before.at(k, j);
        result.set(i, j, entry);
        previous = previous + after.at(i, j) * before.at(j, 4);
      }
      result.set(i, 4, previous);
      result.set(4, i, gains[static_cast<std::size_t>(i)]);
    }
    return result;
  }

  /// S*, the drive being in its gap: S without gains, and no force to come.
  BallMatrix gap_map() const { return map(Ball(), Ball()); }

  /// What a force of 1 N held over a sample adds to z̃.
  BallVector held_force() const {
    const BallMatrix whole = held(Ball(period), 0).exponential();
    BallVector addition(5);
    for (slong i = 0; i < 4; ++i) addition[static_cast<std::size_t>(i)] = whole.at(i, 4);
    return addition;
  }

 private:
  /// [A b; 0 0] h; of a force on the conductor alone without that on the absorber.
  BallMatrix held(const Ball& time, int on_absorber = 1) const {
    const Ball m1(masses[0]), k1(masses[1]), c1(masses[2]), m2(masses[3]), k2(masses[4]),
        c2(masses[5]);
    const Ball zero, one(1.0);
    BallMatrix result(5);
    const auto put = [&](slong row, slong column, const Ball& entry) {
      result.set(row, column, entry * time);
    };
    put(0, 1, one);
    put(2, 3, one);
    put(1, 0, (zero - (k1 + k2)) / m1);
    put(1, 1, (zero - (c1 + c2)) / m1);
    put(1, 2, k2 / m1);
    put(1, 3, c2 / m1);
    put(3, 0, k2 / m2);
    put(3, 1, c2 / m2);
    put(3, 2, (zero - k2) / m2);
    put(3, 3, (zero - c2) / m2);
    put(1, 4, one / m1);
    if (on_absorber != 0) put(3, 4, (zero - one) / m2);
    return result;
  }
};

}  // namespace holdfast::test
