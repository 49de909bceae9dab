#pragma once

#include "holdfast/core/types.hpp"

namespace holdfast {

/// A motion ẋ = f(x, t) that comes to a surface h(x, t) = 0 and goes on from R(x, t) by another
/// field, all at the instant at which it does.
/// @tparam Size  of the state x
template <int Size>
struct SurfaceCrossing {
  Vector<double, Size> before;       ///< f⁻ = ẋ just before
  Vector<double, Size> after;        ///< f⁺ = ẋ just after
  RowVector<double, Size> gradient;  ///< ∂h/∂x, 1 × Size
  double gradient_rate = 0.0;        ///< ∂h/∂t
  /// ∂R/∂x, Size × Size; 1 unless given.
  Matrix<double, Size> reset =
      Matrix<double, Size>::Identity(Size < 0 ? 0 : Size, Size < 0 ? 0 : Size);
  Vector<double, Size> reset_rate = Vector<double, Size>::Zero(Size < 0 ? 0 : Size);  ///< ∂R/∂t
};

/// The saltation matrix: what a small deviation of the state just before a change of the field is
/// just after it, both seen at one instant.
///
///     S = ∂R/∂x + (f⁺ − ∂R/∂x f⁻ − ∂R/∂t) ∂h/∂x / (∂h/∂x f⁻ + ∂h/∂t)
///
/// A neighbour meets the surface earlier or later by δt = −∂h/∂x δx / ḣ, ḣ = ∂h/∂x f⁻ + ∂h/∂t, and
/// moves by the other field for that time. Where the field does not jump, f⁺ = ∂R/∂x f⁻ + ∂R/∂t,
/// S is ∂R/∂x. Where f⁺ slides along the surface, ∂h/∂x f⁺ = 0 without a reset, S has lost a
/// direction: ∂h/∂x S = 0.
///
/// ḣ = 0 is a crossing that touches; it has no derivative, and the entries are not finite.
/// Work: Size² multiply-adds twice and one division.
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
