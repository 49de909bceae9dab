#pragma once

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "holdfast/control/gains.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/math/poly/polynomial.hpp"
#include "holdfast/stability/boundary/boundary_curves.hpp"
#include "holdfast/stability/boundary/boundary_point.hpp"
#include "holdfast/stability/boundary/root_pair_curve.hpp"
#include "holdfast/stability/polynomial/characteristic_polynomial.hpp"

namespace holdfast {

/// Double Neimark–Sacker point: gains at which two root pairs are on the unit circle, or on the
/// imaginary axis for the continuous loop. The curve of root pairs crosses itself at these gains.
template <class Scalar>
struct DoubleNeimarkSacker {
  PdGains<Scalar> gains;  ///< gains P (N/m) and D (N s/m) of the point
  Scalar lower_square;    ///< parameter Y (`RootPairCurve`) of the pair with the smaller angle
  Scalar upper_square;    ///< parameter Y of the pair with the larger angle
};

namespace detail {

/// The matrices E (`even`) and O (`odd`) of `double_neimark_sacker_points`, with rows and columns
/// scaled to similar size. `column` has the factors of the columns.
template <class Scalar>
struct ParityPencil {
  Matrix<Scalar, 3> even, odd;
  Vector<Scalar, 3> column;

  explicit ParityPencil(const RootPairCurve<Scalar>& curve) {
    even << curve.base().even, curve.proportional().even, curve.differential().even;
    odd << curve.base().odd, curve.proportional().odd, curve.differential().odd;
    const auto size_of = [](const auto& one, const auto& other) {
      const Scalar size = std::max(one.cwiseAbs().maxCoeff(), other.cwiseAbs().maxCoeff());
      return size > Scalar(0) ? size : Scalar(1);
    };
    for (int k = 0; k < 3; ++k) {
      column[k] = Scalar(1) / size_of(even.col(k), odd.col(k));
      even.col(k) *= column[k];
      odd.col(k) *= column[k];
    }
    for (int k = 0; k < 3; ++k) {
      const Scalar size = size_of(even.row(k), odd.row(k));
      even.row(k) /= size;
      odd.row(k) /= size;
    }
  }

  Matrix<Scalar, 3> at(const Scalar& ratio) const { return ratio * even - odd; }

  Polynomial<Scalar, 3> determinant() const {
    const auto mixed = [this](int rows_of_even) {
      Matrix<Scalar, 3> matrix;
      for (int k = 0; k < 3; ++k) {
        matrix.row(k) = (rows_of_even >> k) % 2 == 1 ? even.row(k) : odd.row(k);
      }
      return matrix.determinant();
    };
    return {-mixed(0), mixed(1) + mixed(2) + mixed(4), -mixed(3) - mixed(5) - mixed(6), mixed(7)};
  }

  /// The gains at which the odd part is ν = `ratio` times the even part; not finite if none.
  PdGains<Scalar> gains(const Scalar& ratio) const {
    const Matrix<Scalar, 3> matrix = at(ratio);
    Vector<Scalar, 3> null = Vector<Scalar, 3>::Zero();
    for (int k = 0; k < 3; ++k) {
      const Vector<Scalar, 3> first = matrix.row(k), second = matrix.row((k + 1) % 3);
      const Vector<Scalar, 3> normal = first.cross(second);
      if (normal.norm() > null.norm()) null = normal;
    }
    // For a solution at infinity the first entry is only round-off.
    if (std::abs(null[0]) <= Scalar(1e-11) * null.norm()) null[0] = Scalar(0);
    const Vector<Scalar, 3> solution = column.cwiseProduct(null);
    return {solution[1] / solution[0], solution[2] / solution[0]};
  }
};

/// The double point at given gains, from the two roots Y of the even or the odd part, whichever has
/// larger coefficients. `nullopt` unless both Y are positive, finite and over 1e−5 of their sum
/// apart. Closer Y form a cusp; Y = 0 or ∞ is an `end` of the curve, or no root pair.
template <class Scalar>
std::optional<DoubleNeimarkSacker<Scalar>> pair_squares(const RootPairCurve<Scalar>& curve,
                                                        const PdGains<Scalar>& gains) {
  const auto at_gains = [&](auto part) {
    auto [sum, size] = curve.terms(part, gains);
    constexpr Scalar round_off = Scalar(64) * std::numeric_limits<Scalar>::epsilon();
    for (int k : {0, 2}) {
      if (std::abs(sum[k]) <= round_off * size[k]) sum[k] = Scalar(0);
    }
    return sum;
  };
  const Vector<Scalar, 3> even = at_gains(&ParityParts<Scalar>::even);
  const Vector<Scalar, 3> odd = at_gains(&ParityParts<Scalar>::odd);
  const Vector<Scalar, 3>& c = even.squaredNorm() > odd.squaredNorm() ? even : odd;
  const Scalar discriminant = c[1] * c[1] - Scalar(4) * c[0] * c[2];
  if (!(discriminant > Scalar(1e-10) * c[1] * c[1])) return std::nullopt;
  // Terms of equal sign are added, so that −c₁ and the square root do not cancel.
  const Scalar sum =
      -c[1] + (c[1] < Scalar(0) ? std::sqrt(discriminant) : -std::sqrt(discriminant));
  const Scalar first = sum / (Scalar(2) * c[2]), second = Scalar(2) * c[0] / sum;
  if (!(first > Scalar(0) && second > Scalar(0) && std::isfinite(first + second))) {
    return std::nullopt;
  }
  return DoubleNeimarkSacker<Scalar>{gains, std::min(first, second), std::max(first, second)};
}

}  // namespace detail

/// All points at which the curve of root pairs crosses itself: at most three.
///
/// At such a point the roots w are ±iy₁, ±iy₂ and, in the sampled loop, a real root −1/ν. In the
/// variables of `RootPairCurve` the polynomial is (1 + νw) e(−w²) with e(Y) ∝ (Y − Y₁)(Y − Y₂). Its
/// odd part is thus ν times its even part. The even part has the coefficients E (1, P, D)ᵀ, the odd
/// part O (1, P, D)ᵀ, with 3 × 3 matrices E and O. Hence ν is an eigenvalue of their pencil:
///
///     (ν E − O) (1, P, D)ᵀ = 0,   det(ν E − O) = 0
///
/// All three eigenvalues are examined: no isolated point is missed. The undamped continuous loop
/// has two imaginary pairs along whole segments of the line D = 0; the result is then empty.
template <class Scalar>
std::vector<DoubleNeimarkSacker<Scalar>> double_neimark_sacker_points(
    const RootPairCurve<Scalar>& curve) {
  const detail::ParityPencil<Scalar> pencil(curve);
  std::vector<DoubleNeimarkSacker<Scalar>> result;
  for (const auto& ratio : roots(pencil.determinant())) {
    if (std::abs(ratio.imag()) > Scalar(1e-6) * std::abs(ratio.real())) continue;
    const auto pair = detail::pair_squares(curve, pencil.gains(ratio.real()));
    if (pair) result.push_back(*pair);
  }
  return result;
}

namespace detail {

/// Finder of all special points of the boundary curves: tangents, cusps, crossings and ends.
template <class Scalar, int Degree>
class FeatureFinder {
 public:
  explicit FeatureFinder(const BoundaryCurves<Scalar, Degree>& curves)
      : curves_(curves), pairs_(curves.pairs()) {}

  std::vector<BoundaryFeature<Scalar>> find() {
    add_tangents();
    for (const DoubleNeimarkSacker<Scalar>& pair : double_neimark_sacker_points(pairs_)) {
      add(BoundaryFeatureKind::crossing, pair_at(pair.lower_square, pair.gains),
          pair_at(pair.upper_square, pair.gains), pair.gains);
    }
    for (const BoundaryLine<Scalar>& line : curves_.lines()) add_meetings(line);
    if (curves_.lines().size() == 2) add_crossing_of_lines(curves_.lines()[0], curves_.lines()[1]);
    return std::move(features_);
  }

 private:
  struct Incidence {
    BoundaryRoot<Scalar> root;
    Scalar residual;
  };

  void add(BoundaryFeatureKind kind, const Incidence& first, const Incidence& second,
           const PdGains<Scalar>& gains) {
    if (!std::isfinite(gains.proportional) || !std::isfinite(gains.differential)) return;
    features_.push_back(
        {kind, first.root, second.root, gains, std::max(first.residual, second.residual)});
  }

  void add_at(BoundaryFeatureKind kind, const Scalar& square) {
    const PdGains<Scalar> gains = pairs_.gains(square);
    const Incidence pair = pair_at(square, gains);
    add(kind, pair, pair, gains);
  }

  /// Adds tangents and cusps. At a cusp P and D are stationary at the same Y, to 1e−9 of Y. Without
  /// damping one gain is 0 on the whole curve, so that each extreme of the other gain is a cusp.
  void add_tangents() {
    const std::vector<Scalar> vertical = pairs_.proportional_extremes();
    std::vector<Scalar> horizontal = pairs_.differential_extremes();
    const bool p_rests = pairs_.proportional_numerator().isZero(Scalar(0));
    const bool d_rests = pairs_.differential_numerator().isZero(Scalar(0));
    for (const Scalar& square : vertical) {
      const auto same = std::find_if(
          horizontal.begin(), horizontal.end(),
          [&](const Scalar& other) { return std::abs(other - square) <= Scalar(1e-9) * square; });
      const bool is_cusp = d_rests || same != horizontal.end();
      add_at(is_cusp ? BoundaryFeatureKind::cusp : BoundaryFeatureKind::vertical_tangent, square);
      if (same != horizontal.end()) horizontal.erase(same);
    }
    for (const Scalar& square : horizontal) {
      add_at(p_rests ? BoundaryFeatureKind::cusp : BoundaryFeatureKind::horizontal_tangent, square);
    }
  }

  /// Adds the crossings of the curve P = n_P/Δ, D = n_D/Δ with a line c + P p + D d = 0, at the
  /// roots Y of c Δ + p n_P + d n_D, and the end of the curve on this line, at Y = 0 or ∞.
  void add_meetings(const BoundaryLine<Scalar>& line) {
    const bool at_infinity = line.curve == BoundaryCurve::minus_one;
    Polynomial<Scalar, 4> on_line = line.constant * pairs_.denominator() +
                                    line.proportional * pairs_.proportional_numerator() +
                                    line.differential * pairs_.differential_numerator();
    on_line[at_infinity ? 4 : 0] = Scalar(0);
    for (const Scalar& rough : positive_roots(on_line)) {
      const Scalar square = polished(line, rough);
      const PdGains<Scalar> gains = pairs_.gains(square);
      add(BoundaryFeatureKind::crossing, pair_at(square, gains), line_at(line, gains), gains);
    }
    const int k = at_infinity ? 4 : 0;
    const Scalar denominator = pairs_.denominator()[k];
    const PdGains<Scalar> end{pairs_.proportional_numerator()[k] / denominator,
                              pairs_.differential_numerator()[k] / denominator};
    const Incidence on_end = line_at(line, end);
    add(BoundaryFeatureKind::end, {{curves_.pair_kind(), line.angle}, on_end.residual}, on_end,
        end);
  }

  /// A root Y refined by up to three Newton steps on c + P(Y) p + D(Y) d. This function loses fewer
  /// digits than the polynomial c Δ + p n_P + d n_D where line and curve almost coincide.
  Scalar polished(const BoundaryLine<Scalar>& line, Scalar square) const {
    const auto value = [&](const Scalar& y2) {
      const PdGains<Scalar> gains = pairs_.gains(y2);
      return line.constant + gains.proportional * line.proportional +
             gains.differential * line.differential;
    };
    for (int iteration = 0; iteration < 3; ++iteration) {
      const Scalar step = Scalar(1e-5) * square, here = value(square);
      const Scalar slope = (value(square + step) - value(square - step)) / (Scalar(2) * step);
      const Scalar change = here / slope;
      const bool small = std::abs(change) < Scalar(1e-3) * square;
      if (!small || !(std::abs(value(square - change)) < std::abs(here))) break;
      square -= change;
    }
    return square;
  }

  void add_crossing_of_lines(const BoundaryLine<Scalar>& a, const BoundaryLine<Scalar>& b) {
    const Scalar determinant = a.proportional * b.differential - b.proportional * a.differential;
    const PdGains<Scalar> gains{
        (a.differential * b.constant - b.differential * a.constant) / determinant,
        (b.proportional * a.constant - a.proportional * b.constant) / determinant};
    add(BoundaryFeatureKind::crossing, line_at(a, gains), line_at(b, gains), gains);
  }

  Incidence pair_at(const Scalar& square, const PdGains<Scalar>& gains) const {
    const auto even = pairs_.terms(&ParityParts<Scalar>::even, gains);
    const auto odd = pairs_.terms(&ParityParts<Scalar>::odd, gains);
    const auto modulus = [&](const auto& of_even, const auto& of_odd) {
      return Vector<Scalar, 2>(evaluate(of_even, square),
                               std::sqrt(square) * evaluate(of_odd, square));
    };
    const Vector<Scalar, 2> value = modulus(even.sum, odd.sum);
    return {{curves_.pair_kind(), curves_.angle(square)},
            std::hypot(value[0], value[1]) / modulus(even.size, odd.size).sum()};
  }

  static Incidence line_at(const BoundaryLine<Scalar>& line, const PdGains<Scalar>& gains) {
    const Scalar p = gains.proportional * line.proportional;
    const Scalar d = gains.differential * line.differential;
    return {
        {line.curve, line.angle},
        std::abs(line.constant + p + d) / (std::abs(line.constant) + std::abs(p) + std::abs(d))};
  }

  const BoundaryCurves<Scalar, Degree>& curves_;
  const RootPairCurve<Scalar>& pairs_;
  std::vector<BoundaryFeature<Scalar>> features_;
};

}  // namespace detail

/// The special points of the stability boundary in a window of gains, see `BoundaryFeatureKind`.
///
/// The points are roots of polynomials of degree six (tangents and cusps), four (crossings of the
/// curve of root pairs with a line) or three (crossings of this curve with itself, see
/// `double_neimark_sacker_points`). All roots are computed: no point is missed.
/// @param polynomial  `characteristic_polynomial` of the sampled or the continuous loop
/// @param window      window of P (N/m) and D (N s/m), its edges included
/// @throws InvalidParameter unless both ranges of the window are finite with lower < upper
template <class Scalar, int Degree>
std::vector<BoundaryFeature<Scalar>> boundary_features(
    const AffinePolynomial<Scalar, Degree>& polynomial, const GainWindow& window) {
  validate(polynomial);
  validate(window);
  const BoundaryCurves<Scalar, Degree> curves(polynomial);
  auto features = detail::FeatureFinder<Scalar, Degree>(curves).find();
  const auto outside = [&window](const auto& f) { return !window.contains(f.gains); };
  features.erase(std::remove_if(features.begin(), features.end(), outside), features.end());
  return features;
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template std::vector<BoundaryFeature<double>> boundary_features(
    const AffinePolynomial<double, 4>&, const GainWindow&);
extern template std::vector<BoundaryFeature<double>> boundary_features(
    const AffinePolynomial<double, 5>&, const GainWindow&);
#endif

}  // namespace holdfast
