#pragma once

#include "holdfast/core/types.hpp"

namespace holdfast {

/// The data of a motion ẋ = f(x, t) that reaches a surface h(x, t) = 0 and continues from R(x, t)
/// with another vector field.
/// @tparam Size  size of the state x
template <int Size>
struct SurfaceCrossing {
  Vector<double, Size> before;       ///< f⁻ = ẋ just before
  Vector<double, Size> after;        ///< f⁺ = ẋ just after
  RowVector<double, Size> gradient;  ///< ∂h/∂x, 1 × Size
  double gradient_rate = 0.0;        ///< ∂h/∂t
  /// The Jacobian ∂R/∂x, Size × Size; by default the identity.
  Matrix<double, Size> reset =
      Matrix<double, Size>::Identity(Size < 0 ? 0 : Size, Size < 0 ? 0 : Size);
  Vector<double, Size> reset_rate = Vector<double, Size>::Zero(Size < 0 ? 0 : Size);  ///< ∂R/∂t
};

/// The saltation matrix. It maps a small deviation of the state just before a change of the vector
/// field to the deviation just after the change, at the same instant.
///
///     S = ∂R/∂x + (f⁺ − ∂R/∂x f⁻ − ∂R/∂t) ∂h/∂x / (∂h/∂x f⁻ + ∂h/∂t)
///
/// A neighbour reaches the surface later by δt = −∂h/∂x δx / ḣ, ḣ = ∂h/∂x f⁻ + ∂h/∂t, or earlier
/// if δt < 0. For that time it moves with the other field. Where the field does not jump, f⁺ =
/// ∂R/∂x f⁻ + ∂R/∂t, S is ∂R/∂x. Where f⁺ slides along the surface, ∂h/∂x f⁺ = 0 without a reset, S
/// loses a direction: ∂h/∂x S = 0.
///
/// For a tangential crossing, ḣ = 0, there is no derivative and the entries are not finite. Work:
/// Size² multiply-adds twice and one division.
/// @return Size × Size
/// Sources: R. I. Leine, H. Nijmeijer, Dynamics and Bifurcations of Non-Smooth Mechanical Systems,
/// 2004, ch. 7; M. di Bernardo, C. J. Budd, A. R. Champneys, P. Kowalczyk, Piecewise-smooth
/// Dynamical Systems, 2008, sec. 2.5.
template <int Size>
Matrix<double, Size> saltation_matrix(const SurfaceCrossing<Size>& crossing) {
  const double rate = crossing.gradient.dot(crossing.before) + crossing.gradient_rate;
  const Vector<double, Size> jump =
      crossing.after - crossing.reset * crossing.before - crossing.reset_rate;
  return crossing.reset + jump * (crossing.gradient / rate);
}

}  // namespace holdfast
