#pragma once

#include <limits>

#include "holdfast/stability/boundary/boundary_curves.hpp"
#include "support/polynomial/pair_gains.hpp"

namespace holdfast::test {

/// What rounding to double makes of gains at which a polynomial has given roots.
///
/// Every coefficient times its gain is known to ε of itself, so p(x) to ε Σ |terms|; what the curve
/// of pairs takes for round-off of its coefficients (`detail::without_round_off`) is not known at
/// all. Gains are the solution of two real equations p = 0, row by row, and so are known to
/// |M⁻¹| δp, M being what P and D add to the two.
template <int Degree>
class RoundingOfGains {
 public:
  using Real = long double;
  using Complex = std::complex<Real>;

  explicit RoundingOfGains(const AffinePolynomial<double, Degree>& polynomial)
      : polynomial_(polynomial), curves_(polynomial) {}

  /// x = λ − 1 or s of a root at the angle.
  static Complex place(double angle) {
    return Degree == 5 ? unit_circle_minus_one<Real>(angle) : Complex(0, angle);
  }

  /// Σ |terms| of p(x).
  Real size(const Complex& x, const PdGains<double>& gains) const {
    return absolute(polynomial_.base, x) + moved(x, gains.proportional, gains.differential);
  }

  /// |p(x)|, which is exact to less than ε of its size.
  Real residual(const Complex& x, const PdGains<double>& gains) const {
    return std::abs(evaluate(extended(polynomial_.base), x) +
                    Real(gains.proportional) * evaluate(extended(polynomial_.proportional), x) +
                    Real(gains.differential) * evaluate(extended(polynomial_.differential), x));
  }

  /// How far p(x) is unknown.
  Real unknown(const Complex& x, double angle, const PdGains<double>& gains) const {
    const Real epsilon = std::numeric_limits<double>::epsilon();
    return epsilon * size(x, gains) + left_out(angle, gains);
  }

  /// How far the gains are unknown at which x is a root; x₂ a second one where both are real.
  PdGains<Real> of_pair(double angle, const PdGains<double>& gains) const {
    const Complex x = place(angle), p = evaluate(extended(polynomial_.proportional), x),
                  d = evaluate(extended(polynomial_.differential), x);
    const Real by = unknown(x, angle, gains);
    return solved({p.real(), d.real(), by}, {p.imag(), d.imag(), by});
  }

  /// At a fixed P: how far D is unknown, the angle of the pair being free.
  Real differential_at(double angle, const PdGains<double>& gains) const {
    const Complex x = place(angle), d = evaluate(extended(polynomial_.differential), x);
    if (angle == 0.0 || angle == pi<double>) return unknown(x, angle, gains) / std::abs(d);
    const Polynomial<Real, Degree> p =
        extended(polynomial_.base) + Real(gains.proportional) * extended(polynomial_.proportional) +
        Real(gains.differential) * extended(polynomial_.differential);
    // Along the circle, or the axis, x moves by i (1 + x), or i.
    const Complex along = evaluate(derivative<Real, Degree + 1>(p), x) * Complex(0, 1) *
                          (Degree == 5 ? Complex(1) + x : Complex(1));
    return std::abs(along) * unknown(x, angle, gains) / std::abs(std::imag(std::conj(along) * d));
  }

  /// Change of p(x) by gains that far off, at most.
  Real moved(const Complex& x, Real proportional, Real differential) const {
    return std::abs(proportional) * absolute(polynomial_.proportional, x) +
           std::abs(differential) * absolute(polynomial_.differential, x);
  }

 private:
  struct Row {
    Real proportional, differential, unknown;
  };

  static PdGains<Real> solved(const Row& a, const Row& b) {
    const Real determinant =
        std::abs(a.proportional * b.differential - a.differential * b.proportional);
    return {
        (std::abs(b.differential) * a.unknown + std::abs(a.differential) * b.unknown) / determinant,
        (std::abs(b.proportional) * a.unknown + std::abs(a.proportional) * b.unknown) /
            determinant};
  }

  static Polynomial<Real, Degree> extended(const Polynomial<double, Degree>& p) {
    return p.template cast<Real>();
  }
  static Real absolute(const Polynomial<double, Degree>& p, const Complex& x) {
    return evaluate(Polynomial<Real, Degree>(extended(p).cwiseAbs()), std::abs(x));
  }

  /// Of p(x) = q(iy) (1 + …)⁻⁵: what the curve of pairs leaves out of q.
  Real left_out(double angle, const PdGains<double>& gains) const {
    const Real unit = curves_.pairs().unit();
    const Real y = Degree == 5 ? std::tan(Real(angle) / 2) : Real(angle);
    const auto dropped = [&](const Polynomial<double, Degree>& part) {
      const Polynomial<double, Degree> kept =
          detail::without_round_off(part, static_cast<double>(unit));
      return absolute(part - kept, Complex(0, y));
    };
    const auto& q = curves_.polynomial();
    const Real in_half_plane = std::abs(Real(gains.proportional)) * dropped(q.proportional) +
                               std::abs(Real(gains.differential)) * dropped(q.differential);
    return Degree == 5 ? in_half_plane / std::pow(1 + y * y, Real(2.5)) : in_half_plane;
  }

  AffinePolynomial<double, Degree> polynomial_;
  BoundaryCurves<double, Degree> curves_;
};

}  // namespace holdfast::test
