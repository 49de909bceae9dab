#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "holdfast/cable/conductor.hpp"
#include "holdfast/cable/hanging_cable.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"

namespace holdfast {

/// Irvine's parabolic cable under one vertical point load (Kollár 2022, Eq. 1 and its cubic). A
/// load P (N, downward) at x_p adds h (N) to the horizontal tension H. With the symbols of
/// `Conductor` and x̂ = x/L, x̂_p = x_p/L, P̂ = P/(μ g L), ĥ = h/H:
///
///     ĥ³ + (2 + λ²/24) ĥ² + (1 + λ²/12) ĥ − (λ²/2) x̂_p (1 − x̂_p) P̂ (1 + P̂) = 0
///     w(x) = μ g L²/(H (1 + ĥ)) [ P̂ x̂_< (1 − x̂_>) − (ĥ/2) x̂ (1 − x̂) ],
///
/// x̂_<, x̂_> are the smaller and the larger of x̂ and x̂_p. w (m) is the displacement (downward)
/// from the cable without load. The equations are valid for small slopes, f/L up to about 1/8, and
/// P̂ > −1/2; below, ĥ would rise again. Source: H. M. Irvine, Cable Structures, 1981, Sect. 2.4.
template <class Scalar>
class IrvinePointLoad {
 public:
  /// @param conductor  conductor of the cable, one that `validate` accepts
  /// @param position   distance x_p (m) of the load from the left support, inside the span
  IrvinePointLoad(const Conductor<Scalar>& conductor, const Scalar& position)
      : tension_(conductor.parabolic_tension()),
        weight_(conductor.weight()),
        span_(conductor.span),
        parameter_(conductor.irvine_parameter()),
        place_(position / conductor.span) {}

  /// Relative additional tension ĥ = h/H under a load P > −μ g L/2 (N): the only root > −1 of the
  /// cubic, by Newton's method from the right, which converges monotonically.
  Scalar relative_additional_tension(const Scalar& load) const {
    const Scalar relative = load / weight_;
    const Scalar a = Scalar(2) + parameter_ / Scalar(24), b = Scalar(1) + parameter_ / Scalar(12);
    const Scalar c =
        -parameter_ / Scalar(2) * place_ * (Scalar(1) - place_) * relative * (Scalar(1) + relative);
    using std::abs;
    Scalar root = Scalar(1) + abs(c) / b;  // the cubic is positive there
    for (int step = 0; step < 200; ++step) {
      const Scalar change =
          (((root + a) * root + b) * root + c) / ((Scalar(3) * root + Scalar(2) * a) * root + b);
      root -= change;
      if (!(abs(change) > Scalar(1e-16) * (Scalar(1) + abs(root)))) break;
    }
    return root;
  }

  /// Horizontal tension H + h (N) under a load P (N).
  Scalar tension(const Scalar& load) const {
    return tension_ * (Scalar(1) + relative_additional_tension(load));
  }

  /// Downward displacement w(x) (m) of the cable at x = 0 … L (m) under a load P (N).
  Scalar deflection(const Scalar& x, const Scalar& load) const {
    const Scalar at = x / span_, added = relative_additional_tension(load);
    const Scalar lower = at < place_ ? at : place_, upper = at < place_ ? place_ : at;
    return scale() / (Scalar(1) + added) *
           (load / weight_ * lower * (Scalar(1) - upper) -
            added / Scalar(2) * at * (Scalar(1) - at));
  }

  /// Downward displacement w(x_p) (m) of the loaded point under a load P (N).
  Scalar displacement(const Scalar& load) const { return deflection(place_ * span_, load); }

  /// Tangent stiffness dP/dw (N/m) of the loaded point at a load P (N).
  Scalar stiffness(const Scalar& load) const {
    const Scalar relative = load / weight_, added = relative_additional_tension(load);
    const Scalar form = place_ * (Scalar(1) - place_);
    const Scalar slope = (Scalar(3) * added + Scalar(4) + parameter_ / Scalar(12)) * added +
                         Scalar(1) + parameter_ / Scalar(12);
    const Scalar added_rate =
        parameter_ / Scalar(2) * form * (Scalar(1) + Scalar(2) * relative) / slope;
    // w = scale · form · (P̂ − ĥ/2) / (1 + ĥ), differentiated by P̂.
    const Scalar one = Scalar(1) + added;
    const Scalar rate = (Scalar(1) - added_rate / Scalar(2)) / one -
                        (relative - added / Scalar(2)) * added_rate / (one * one);
    return weight_ / (scale() * form * rate);
  }

  /// Lower limit −μ g L/2 (N) of the load: the equations of this class are valid only above it.
  Scalar lowest_load() const { return -weight_ / Scalar(2); }

 private:
  Scalar scale() const { return weight_ * span_ / tension_; }

  Scalar tension_, weight_, span_, parameter_, place_;
};

/// Force–displacement relation of the cable at the absorber. Force F (N) and displacement w (m) are
/// downward positive. F is added to the absorber's weight, and w is measured from the equilibrium
/// under this weight, as in Kollár 2022, Fig. 2.
/// @tparam PointLoad  `IrvinePointLoad<double>` (parabola) or `CatenaryPointLoad<double>` (exact)
template <class PointLoad>
class StaticsFromRest {
 public:
  /// @param model         force–displacement relation measured from the cable without absorber
  /// @param resting_load  weight of the absorber (N), ≥ 0
  StaticsFromRest(PointLoad model, double resting_load)
      : model_(std::move(model)),
        resting_load_(resting_load),
        resting_displacement_(model_.displacement(resting_load)) {}

  /// Force–displacement relation measured from the cable without absorber.
  const PointLoad& model() const { return model_; }

  /// Downward displacement (m) of the cable at the absorber under the absorber's weight alone.
  double resting_displacement() const { return resting_displacement_; }

  /// Horizontal tension (N) of the cable under the absorber's weight and a force F (N).
  double tension(double force) const { return model_.tension(resting_load_ + force); }

  /// Displacement w (m) from the equilibrium under a force F (N) > lowest_force().
  double displacement(double force) const {
    return model_.displacement(resting_load_ + force) - resting_displacement_;
  }

  /// Tangent stiffness dF/dw (N/m) at a force F (N) > lowest_force().
  double stiffness(double force) const { return model_.stiffness(resting_load_ + force); }

  /// Force F (N) that causes a displacement w (m) at the absorber, by Newton's method in a bracket.
  /// @throws InvalidParameter if w is not finite or would need a force F ≤ lowest_force()
  double force(double displacement_sought) const {
    require_finite("displacement", displacement_sought, "m");
    const double floor = lowest_force() * (1.0 - 1e-9);
    if (displacement_sought <= displacement(floor))
      throw InvalidParameter("displacement", displacement_sought, "m",
                             "reachable with an upward load below half of the cable's weight");
    double below = floor, above = std::abs(floor);
    while (displacement(above) < displacement_sought) above *= 2.0;
    double guess = std::fmin(std::fmax(stiffness(0.0) * displacement_sought, below), above);
    for (int step = 0; step < 200; ++step) {
      const double miss = displacement(guess) - displacement_sought;
      (miss > 0.0 ? above : below) = guess;
      const double change = miss * stiffness(guess);
      if (std::abs(change) <= 1e-15 * std::abs(floor)) break;
      const double next = guess - change;
      guess = next > below && next < above ? next : 0.5 * (below + above);
    }
    return guess;
  }

  /// Lower limit (N) of the force F, negative. At this limit F and the absorber's weight together
  /// pull the cable up with half of the cable's weight, see `IrvinePointLoad`.
  double lowest_force() const { return model_.lowest_load() - resting_load_; }

 private:
  PointLoad model_;
  double resting_load_, resting_displacement_;
};

/// Force–displacement relation at the absorber by Irvine's parabolic cable (Kollár 2022, Eq. 1).
/// @throws InvalidParameter for an inadmissible conductor, position (m, from the left) or mass (kg)
inline StaticsFromRest<IrvinePointLoad<double>> irvine_statics(const Conductor<double>& conductor,
                                                               double position,
                                                               double absorber_mass) {
  validate(conductor);
  require_inside_span(position, conductor.span);
  require_non_negative("absorber mass m2", absorber_mass, "kg");
  return {{conductor, position}, absorber_mass * conductor.gravity};
}

/// Exact force–displacement relation at the absorber, by two elastic catenaries.
/// @throws InvalidParameter for an inadmissible conductor, position (m, from the left) or mass (kg)
template <class Scalar>
StaticsFromRest<CatenaryPointLoad<Scalar>> exact_statics(const Conductor<Scalar>& conductor,
                                                         double position, double absorber_mass) {
  validate(conductor);
  require_inside_span(position, conductor.span);
  require_non_negative("absorber mass m2", absorber_mass, "kg");
  return {{conductor, position}, absorber_mass * conductor.gravity};
}

/// Definition of the stiffness k₁ of the cable's nonlinear force F(w) over the displacement w, see
/// conductor_stiffness(). `below` and `above` are the members of ReadingRange.
enum class StiffnessReading {
  tangent,        ///< slope dF/dw at w = 0, the equilibrium with the absorber's weight
  secant,         ///< secant slope over the range, (F(below) − F(−above))/(below + above)
  least_squares,  ///< slope of the least-squares line of F(w), −above ≤ w ≤ below
};

/// Range of displacements (m) from the equilibrium with the absorber's weight, −above … below.
struct ReadingRange {
  double below;  ///< largest displacement downward (m), ≥ 0
  double above;  ///< largest displacement upward (m), ≥ 0
};

namespace detail {

/// Slope (N/m) of the least-squares line of F(w) over w = w̄ ± half (m), where w̄ is `middle`:
/// ∫ (w − w̄) F dw/∫ (w − w̄)² dw by 16-point Gauss–Legendre quadrature.
template <class Statics>
double least_squares_slope(const Statics& statics, double middle, double half) {
  static constexpr std::array<double, 8> nodes{
      0.0950125098376374, 0.2816035507792589, 0.4580167776572274, 0.6178762444026438,
      0.7554044083550030, 0.8656312023878318, 0.9445750230732326, 0.9894009349916499};
  static constexpr std::array<double, 8> weights{
      0.1894506104550685, 0.1826034150449236, 0.1691565193950025, 0.1495959888165767,
      0.1246289712555339, 0.0951585116824928, 0.0622535239386479, 0.0271524594117541};
  double moment = 0.0;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const double offset = half * nodes[k];
    moment +=
        weights[k] * nodes[k] * (statics.force(middle + offset) - statics.force(middle - offset));
  }
  return 1.5 * moment / half;
}

}  // namespace detail

/// The conductor's linear stiffness k₁ (N/m) at the absorber (Kollár 2022, Eq. 2).
/// @param statics  force–displacement relation at the absorber, a StaticsFromRest
/// @param reading  definition of k₁; the least-squares line need not pass through the equilibrium
/// @param range    displacements over which k₁ is determined, unused for StiffnessReading::tangent
/// @throws InvalidParameter for a negative or empty range, or one with a force ≤ lowest_force()
template <class Statics>
double conductor_stiffness(const Statics& statics, StiffnessReading reading,
                           const ReadingRange& range) {
  if (reading == StiffnessReading::tangent) return statics.stiffness(0.0);
  require_non_negative("largest displacement downward", range.below, "m");
  require_non_negative("largest displacement upward", range.above, "m");
  require_positive("sum of the largest displacements", range.below + range.above, "m");
  const double width = range.below + range.above;
  if (reading == StiffnessReading::secant)
    return (statics.force(range.below) - statics.force(-range.above)) / width;
  return detail::least_squares_slope(statics, 0.5 * (range.below - range.above), 0.5 * width);
}

}  // namespace holdfast
