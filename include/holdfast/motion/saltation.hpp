#pragma once

#include "holdfast/core/types.hpp"

namespace holdfast {

/// The crossing of a surface h(x, t) = 0 by a motion ẋ = f(x, t). At the crossing the state is
/// reset to R(x, t), and the vector field f changes.
/// @tparam Size  size of the state x
template <int Size>
struct SurfaceCrossing {
  Vector<double, Size> before;       ///< rate f⁻ = ẋ just before the crossing
  Vector<double, Size> after;        ///< rate f⁺ = ẋ just after the crossing
  RowVector<double, Size> gradient;  ///< gradient ∂h/∂x of the surface, 1 × Size
  double gradient_rate = 0.0;        ///< partial time derivative ∂h/∂t; 0 for a fixed surface
  /// The Jacobian ∂R/∂x, Size × Size; by default the identity, but empty for a dynamic Size.
  Matrix<double, Size> reset =
      Matrix<double, Size>::Identity(Size < 0 ? 0 : Size, Size < 0 ? 0 : Size);
  /// The time derivative ∂R/∂t, Size × 1; by default zero, but empty for a dynamic Size.
  Vector<double, Size> reset_rate = Vector<double, Size>::Zero(Size < 0 ? 0 : Size);
};

/// The saltation matrix S of a crossing. It maps a small deviation of the state just before the
/// crossing to the deviation just after it, at the same instant:
///
///     S = ∂R/∂x + (f⁺ − ∂R/∂x f⁻ − ∂R/∂t) ∂h/∂x / ḣ ,   ḣ = ∂h/∂x f⁻ + ∂h/∂t
///
/// The motion with deviation δx crosses the surface later by δt = −∂h/∂x δx / ḣ (earlier if δt <
/// 0). During δt its rate is f⁻, while that of the motion without deviation is already f⁺. If f⁺ =
/// ∂R/∂x f⁻ + ∂R/∂t (no jump of the field), S = ∂R/∂x. If R = x, ∂h/∂t = 0 and f⁺ is tangential to
/// the surface (∂h/∂x f⁺ = 0), S is singular: ∂h/∂x S = 0.
///
/// If f⁻ is tangential to the surface (ḣ = 0), no derivative exists and the entries are not finite.
/// Work: 2 Size² multiply-adds and one division.
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
