#pragma once

#include <cmath>

#include "holdfast/cable/conductor.hpp"
#include "holdfast/core/types.hpp"

namespace holdfast {

/// Irvine's parabolic cable under one vertical point load (Kollár 2022, Eq. 1 and its cubic).
///
/// Dimensionless: x̂ = x/L, P̂ = P/(μ g L), ĥ = h/H with h the additional horizontal tension:
///
///     ĥ³ + (2 + λ²/24) ĥ² + (1 + λ²/12) ĥ − (λ²/2) x̂_p (1 − x̂_p) P̂ (1 + P̂) = 0
///     w(x) = μ g L²/(H (1 + ĥ)) [ P̂ x̂_< (1 − x̂_>) − (ĥ/2) x̂ (1 − x̂) ],
///
/// x̂_<, x̂_> the smaller and the larger of x̂, x̂_p. w counts from the bare cable. Valid for small
/// slopes (f/L up to about 1/8) and P̂ > −1/2: there the cubic turns back, a net upward load of half
/// the weight.
/// Source: H. M. Irvine, Cable Structures, MIT Press, 1981, Sect. 2.4.
template <class Scalar>
class IrvinePointLoad {
 public:
  /// @param conductor  admissible in the sense of `validate`
  /// @param position   x_p (m), inside the span
  IrvinePointLoad(const Conductor<Scalar>& conductor, const Scalar& position)
      : tension_(conductor.parabolic_tension()),
        weight_(conductor.weight()),
        span_(conductor.span),
        parameter_(conductor.irvine_parameter()),
        place_(position / conductor.span) {}

  /// ĥ > −1, the one root of the cubic there, for a load P (N), P > −μ g L/2.
  ///
  /// At ĥ = −1 the cubic is −λ²/24 − (λ²/2) x̂(1−x̂) P̂(1+P̂) < 0 for every admissible load, and it is
  /// convex where it rises; Newton from the right of the root therefore falls onto it.
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

  /// H + h (N).
  Scalar tension(const Scalar& load) const {
    return tension_ * (Scalar(1) + relative_additional_tension(load));
  }

  /// w(x) of Eq. (1) (m), 0 ≤ x ≤ L, under a load P (N).
  Scalar deflection(const Scalar& x, const Scalar& load) const {
    const Scalar at = x / span_, added = relative_additional_tension(load);
    const Scalar lower = at < place_ ? at : place_, upper = at < place_ ? place_ : at;
    return scale() / (Scalar(1) + added) *
           (load / weight_ * lower * (Scalar(1) - upper) -
            added / Scalar(2) * at * (Scalar(1) - at));
  }

  /// w(x_p) (m) under a load P (N).
  Scalar displacement(const Scalar& load) const { return deflection(place_ * span_, load); }

  /// dP/dw at x_p (N/m): the spring that a small further load meets.
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

  /// −μ g L/2 (N): at this load and below Eq. (1) has nothing to say.
  Scalar lowest_load() const { return -weight_ / Scalar(2); }

 private:
  Scalar scale() const { return weight_ * span_ / tension_; }

  Scalar tension_, weight_, span_, parameter_, place_;
};

}  // namespace holdfast
