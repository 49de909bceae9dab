#pragma once

#include "holdfast/core/types.hpp"

namespace holdfast {

/// A crossing of a surface h(x, t) = 0 by a motion ẋ = f(x, t). After the crossing the motion
/// continues from the state R(x, t) with another vector field.
/// @tparam Size  size of the state x
template <int Size>
struct SurfaceCrossing {
  Vector<double, Size> before;       ///< rate f⁻ = ẋ just before the surface
  Vector<double, Size> after;        ///< rate f⁺ = ẋ just after the surface
  RowVector<double, Size> gradient;  ///< gradient ∂h/∂x of the surface, 1 × Size
  double gradient_rate = 0.0;        ///< time derivative ∂h/∂t of the surface
  /// The Jacobian ∂R/∂x, Size × Size; by default the identity.
  Matrix<double, Size> reset =
      Matrix<double, Size>::Identity(Size < 0 ? 0 : Size, Size < 0 ? 0 : Size);
  Vector<double, Size> reset_rate = Vector<double, Size>::Zero(Size < 0 ? 0 : Size);  ///< ∂R/∂t
};

/// The saltation matrix S, which maps a small deviation of the state just before a change of the
/// vector field to the deviation just after this change, at the same instant.
///
///     S = ∂R/∂x + (f⁺ − ∂R/∂x f⁻ − ∂R/∂t) ∂h/∂x / (∂h/∂x f⁻ + ∂h/∂t)
///
/// A motion with deviation δx reaches the surface later by δt = −∂h/∂x δx / ḣ, ḣ = ∂h/∂x f⁻ +
/// ∂h/∂t, or earlier if δt < 0. During δt it moves with the other field. Where the field does not
/// jump, f⁺ = ∂R/∂x f⁻ + ∂R/∂t, S is ∂R/∂x. Where f⁺ slides along the surface, ∂h/∂x f⁺ = 0 without
/// a reset, S loses a direction: ∂h/∂x S = 0.
///
/// For a tangential crossing, ḣ = 0, there is no derivative and the entries are not finite. Work: 2
/// Size² multiply-adds and one division.
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
