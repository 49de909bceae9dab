#pragma once

#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "holdfast/core/lanes.hpp"
#include "holdfast/core/select.hpp"
#include "holdfast/math/poly/polynomial.hpp"
#include "holdfast/math/poly/routh_hurwitz.hpp"

namespace holdfast {

/// Real quadratic factor μ² + Uμ + V of a characteristic polynomial in powers of μ = λ − 1.
template <class Scalar>
struct QuadraticFactor {
  Scalar linear;    ///< coefficient U of μ
  Scalar constant;  ///< coefficient V, the constant term

  /// The larger |λ| of the two roots: √(1 − U + V) if complex, |1 − U/2| + √(U²/4 − V) if real.
  Scalar radius() const {
    using std::abs;
    using std::sqrt;
    const Scalar half = linear * Scalar(0.5);
    const Scalar discriminant = half * half - constant;
    const Mask<Scalar> pair = discriminant < Scalar(0);
    const Scalar squared_modulus = (Scalar(1) - linear) + constant;
    const Scalar root = sqrt(select(pair, squared_modulus, discriminant));
    return select(pair, root, Scalar(abs(Scalar(1) - half) + root));
  }
};

/// Computes the spectral radius of a characteristic polynomial that changes little from call to
/// call, as along a row of a chart. The quadratic factor μ² + Uμ + V of the two dominant roots
/// (largest |λ|) is stored for the next call. Each lane of a SIMD pack has its own polynomial.
///
/// The factor is extrapolated from previous calls and corrected by Newton's method in (U, V), known
/// as Bairstow's iteration. Synthetic division of the polynomial by the factor gives the
/// coefficients b_k. The same division applied to the b_k gives c_k. One step solves
///
///     c₂ δU + c₃ δV = b₁,   (c₁ − b₁) δU + c₂ δV = b₀
///
/// The iteration converges quadratically if factor and quotient have no common root. The conditions
/// of Liénard and Chipart test that no root of the quotient has a larger |λ| than the factor. If
/// the test fails in a lane, all roots are computed for this lane. A real dominant root is paired
/// with the root λ = 0, which the sampled loop has for δ = 0. Other polynomials must therefore be
/// multiplied by λ (`with_root_at_zero`). Work: 5 · Degree multiply-adds and a division per
/// iteration, 45 multiply-adds per call for the test. Relative error of the radius: round-off times
/// the dominant root's condition number, or 2e−13 if the two largest |λ| are closer than that.
/// Source: L. Bairstow, 1914.
template <class Scalar, int Degree>
class DominantFactor {
 public:
  static_assert(Degree == 5 || Degree == 6, "Degree must be 5, or 6 with the root λ = 0 added");
  /// The number type of one lane.
  using Value = typename Lanes<Scalar>::Value;

  /// The spectral radius ρ = max |λ| of a monic polynomial in powers of μ = λ − 1.
  Scalar radius(const Polynomial<Scalar, Degree>& polynomial) {
    Factor factor = extrapolated();
    Quotient quotient{};
    Mask<Scalar> settled = converge(polynomial, factor, quotient, most_iterations_);
    if (!all(settled)) start_nearby(polynomial, factor, quotient, settled);
    Scalar result = factor.radius();
    const Mask<Scalar> dominant = bounds(quotient, result);
    const Mask<Scalar> sound = settled & dominant;
    for (std::size_t k = history_.size() - 1; k > 0; --k) history_[k] = history_[k - 1];
    history_[0] = factor;
    if (!all(sound)) find_anew(polynomial, sound, result);
    return result;
  }

 private:
  /// The factor of the dominant pair, or of a dominant real root and λ = 0, from all roots.
  static QuadraticFactor<Value> dominant_factor(const Polynomial<Value, Degree>& in_powers_of_mu) {
    const Value one(1);
    std::complex<Value> dominant(-one);
    for (const std::complex<Value>& root : roots(in_powers_of_mu)) {
      if (std::norm(one + root) > std::norm(one + dominant)) dominant = root;
    }
    const bool real = std::abs(dominant.imag()) <=
                      Value(4) * std::numeric_limits<Value>::epsilon() * std::abs(dominant);
    const std::complex<Value> partner = real ? std::complex<Value>(-one) : std::conj(dominant);
    return {-(dominant + partner).real(), (dominant * partner).real()};
  }

  using Factor = QuadraticFactor<Scalar>;
  using Quotient = Vector<Scalar, Degree - 1>;
  static constexpr std::size_t lanes_ = Lanes<Scalar>::count;
  static constexpr int most_iterations_ = 5;
  static constexpr double settled_step_ = 1e-8;  // its square, the error left, is round-off
  static constexpr double slack_ = 2e-13;

  static Mask<Scalar> converge(const Polynomial<Scalar, Degree>& polynomial, Factor& factor,
                               Quotient& quotient, int most_iterations) {
    Mask<Scalar> settled = Scalar(0) > Scalar(1);
    for (int iteration = 0; iteration < most_iterations && !all(settled); ++iteration) {
      settled = improve(polynomial, factor, quotient);
    }
    return settled;
  }

  /// Restarts lanes without convergence from the previous factor; extrapolation may be worse.
  void start_nearby(const Polynomial<Scalar, Degree>& polynomial, Factor& factor,
                    Quotient& quotient, Mask<Scalar>& settled) const {
    Factor other = history_[0];
    Quotient other_quotient = Quotient::Zero();
    const Mask<Scalar> also = converge(polynomial, other, other_quotient, 3 * most_iterations_);
    const Mask<Scalar> better = also & !settled;
    factor.linear = select(better, other.linear, factor.linear);
    factor.constant = select(better, other.constant, factor.constant);
    for (int k = 0; k < Degree - 1; ++k)
      quotient[k] = select(better, other_quotient[k], quotient[k]);
    settled = settled | also;
  }

  /// The factor extrapolated by the cubic through the last four factors.
  Factor extrapolated() const {
    const auto at = [this](Scalar Factor::*part) {
      return Scalar(4) * (history_[0].*part + history_[2].*part) -
             (Scalar(6) * (history_[1].*part) + history_[3].*part);
    };
    return {at(&Factor::linear), at(&Factor::constant)};
  }

  /// Performs one Newton step. @return true where the step was so small that no other is needed
  static Mask<Scalar> improve(const Polynomial<Scalar, Degree>& a, Factor& factor,
                              Quotient& quotient) {
    using std::abs;
    const Scalar u = factor.linear, v = factor.constant;
    Polynomial<Scalar, Degree> b, c;
    divide(a, u, v, b);
    divide(b, u, v, c);
    quotient = b.template tail<Degree - 1>();
    const Scalar c1 = c[1] - b[1];
    const Scalar inverse = Scalar(1) / (c[2] * c[2] - c1 * c[3]);
    const Scalar du = (b[1] * c[2] - b[0] * c[3]) * inverse;
    const Scalar dv = (b[0] * c[2] - b[1] * c1) * inverse;
    factor.linear = u + du;
    factor.constant = v + dv;
    const Scalar size = factor.linear * factor.linear + abs(factor.constant);
    const Mask<Scalar> u_settled = du * du <= Scalar(settled_step_ * settled_step_) * size;
    const Mask<Scalar> v_settled = abs(dv) <= Scalar(settled_step_) * size;
    return u_settled & v_settled;
  }

  /// Divides a by μ² + Uμ + V into the quotient b_n … b₂ and the remainder b₁ (μ + U) + b₀.
  static void divide(const Polynomial<Scalar, Degree>& a, const Scalar& u, const Scalar& v,
                     Polynomial<Scalar, Degree>& b) {
    b[Degree] = a[Degree];
    b[Degree - 1] = a[Degree - 1] - u * b[Degree];
    for (int k = Degree - 2; k >= 0; --k) b[k] = (a[k] - v * b[k + 2]) - u * b[k + 1];
  }

  /// Whether all roots of the quotient have |λ| < radius (1 + `slack_`).
  static Mask<Scalar> bounds(const Quotient& in_powers_of_mu, const Scalar& radius) {
    Quotient q = in_powers_of_mu;
    for (int start = 0; start < Degree - 2; ++start) {  // to powers of λ
      for (int k = Degree - 3; k >= start; --k) q[k] = q[k] - q[k + 1];
    }
    const Scalar bound = radius * Scalar(1 + slack_);
    Scalar power = bound;
    for (int k = 1; k < Degree - 1; ++k, power = power * bound) q[k] = q[k] * power;
    return lienard_chipart_stable<Scalar, Degree - 1>(at_half_plane(q));
  }

  /// The polynomial (1 − w)ⁿ q((1 + w)/(1 − w)) in w; the quotient q(λ) has the degree n = 3 or 4.
  static Quotient at_half_plane(const Quotient& q) {
    Quotient a;
    if constexpr (Degree == 5) {
      const Scalar even = q[0] + q[2], odd = q[1] + q[3];
      const Scalar ends = Scalar(3) * (q[3] - q[0]), middle = q[2] - q[1];
      a << even + odd, ends + middle, Scalar(3) * (q[0] + q[3]) - (q[1] + q[2]), odd - even;
    } else {
      const Scalar even = q[0] + q[2] + q[4], odd = q[1] + q[3];
      const Scalar ends = Scalar(4) * (q[4] - q[0]), middle = Scalar(2) * (q[3] - q[1]);
      a << even + odd, ends + middle, Scalar(6) * (q[0] + q[4]) - Scalar(2) * q[2], ends - middle,
          even - odd;
    }
    return a;
  }

  [[gnu::noinline, gnu::flatten]] void find_anew(const Polynomial<Scalar, Degree>& polynomial,
                                                 const Mask<Scalar>& sound, Scalar& result) {
    std::array<std::uint8_t, lanes_> is_sound;
    Lanes<Scalar>::store_flags(sound, is_sound.data());
    for (std::size_t lane = 0; lane < lanes_; ++lane) {
      if (is_sound[lane] != 0) continue;

      Polynomial<Value, Degree> one;
      for (int k = 0; k <= Degree; ++k) one[k] = detail::lane_of(polynomial[k], lane);
      const QuadraticFactor<Value> factor = dominant_factor(one);
      for (Factor& memory : history_) {
        set(memory.linear, lane, factor.linear);
        set(memory.constant, lane, factor.constant);
      }
      set(result, lane, factor.radius());
    }
  }

  static void set(Scalar& pack, std::size_t lane, const Value& value) {
    std::array<Value, lanes_> values;
    Lanes<Scalar>::store(pack, values.data());
    values[lane] = value;
    pack = Lanes<Scalar>::load(values.data());
  }

  static Factor nothing() { return {Scalar(std::numeric_limits<Value>::quiet_NaN()), Scalar(0)}; }

  std::array<Factor, 4> history_ = {nothing(), nothing(), nothing(), nothing()};
};

/// Multiplies a polynomial in powers of μ = λ − 1 by λ = 1 + μ: adds the root λ = 0.
template <class Scalar, int Size>
Vector<Scalar, Size + 1> with_root_at_zero(const Vector<Scalar, Size>& in_powers_of_mu) {
  return multiply<Scalar, Size, 2>(in_powers_of_mu, {Scalar(1), Scalar(1)});
}

}  // namespace holdfast
