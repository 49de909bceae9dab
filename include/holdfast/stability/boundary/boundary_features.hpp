#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "holdfast/control/gains.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/math/poly/polynomial.hpp"
#include "holdfast/math/poly/positive_roots.hpp"
#include "holdfast/stability/boundary/boundary_curves.hpp"
#include "holdfast/stability/boundary/boundary_point.hpp"
#include "holdfast/stability/boundary/double_neimark_sacker.hpp"
#include "holdfast/stability/polynomial/affine_polynomial.hpp"

namespace holdfast {

namespace detail {

/// Finds the features of one set of boundary curves.
template <class Scalar, int Degree>
class FeatureFinder {
 public:
  explicit FeatureFinder(const BoundaryCurves<Scalar, Degree>& curves)
      : curves_(curves), pairs_(curves.pairs()) {}

  std::vector<BoundaryFeature<Scalar>> find() {
    add_tangents();
    mark_near_cusps();
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

  /// Marks the vertical and horizontal tangents at nearly the same angle.
  void mark_near_cusps() {
    constexpr double near = 1e-3;
    const auto is_near = [](const BoundaryFeature<Scalar>& one,
                            const BoundaryFeature<Scalar>& other) {
      const Scalar a = one.first.angle, b = other.first.angle;
      return std::abs(a - b) <= Scalar(near) * std::max(a, b);
    };
    for (BoundaryFeature<Scalar>& one : features_) {
      if (one.kind != BoundaryFeatureKind::vertical_tangent) continue;
      for (BoundaryFeature<Scalar>& other : features_) {
        if (other.kind != BoundaryFeatureKind::horizontal_tangent || !is_near(one, other)) continue;
        one.nearly_cusp = other.nearly_cusp = true;
      }
    }
  }

  /// Stationary points that coincide to 1e−9 of Y are one cusp; their places are exact to much less
  /// than that, since at a cusp each is a simple root. Without damping one gain is zero all along
  /// the curve, and every turn of the other is a cusp.
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

  /// On the line c + P p + D d = 0 the pairs solve c Δ + p n_P + d n_D = 0. The curve of pairs
  /// begins (Y = 0) or ends (Y = ∞) on the line, so the outermost coefficient is zero.
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

  /// The sum above cancels where the line and the curve run almost alike; the value of the line on
  /// the curve does not. Newton's method with a difference for the slope, as long as it gains.
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
    const auto part = [&](Vector<Scalar, 3> ParityParts<Scalar>::*which) {
      const Vector<Scalar, 3>& base = pairs_.base().*which;
      const Vector<Scalar, 3> p = gains.proportional * (pairs_.proportional().*which);
      const Vector<Scalar, 3> d = gains.differential * (pairs_.differential().*which);
      return Vector<Scalar, 2>(evaluate(base + p + d, square),
                               evaluate(base.cwiseAbs() + p.cwiseAbs() + d.cwiseAbs(), square));
    };
    const Vector<Scalar, 2> even = part(&ParityParts<Scalar>::even);
    const Vector<Scalar, 2> odd = std::sqrt(square) * part(&ParityParts<Scalar>::odd);
    return {{curves_.pair_kind(), curves_.angle(square)},
            std::hypot(even[0], odd[0]) / (even[1] + odd[1])};
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

/// The special points of the boundary within a window of gains: tangents, cusps, crossings, ends.
///
/// All are roots of polynomials of degree at most six, so none is missed however close the curves
/// run: stationary P and D from n′ Δ = n Δ′, crossings of the curve of pairs with a line from a
/// polynomial of degree four in Y, with itself from a cubic (`double_neimark_sacker_points`).
/// @param polynomial  `characteristic_polynomial(loop)`, in powers of λ − 1 (degree 5), or
/// `characteristic_polynomial(plant)`, in s (degree 4)
/// @param window      P (N/m) and D (N s/m), its edges included
/// @throws InvalidParameter unless the window's ranges are finite and not empty
template <class Scalar, int Degree>
std::vector<BoundaryFeature<Scalar>> boundary_features(
    const AffinePolynomial<Scalar, Degree>& polynomial, const GainWindow& window) {
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
