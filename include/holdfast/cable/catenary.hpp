#pragma once

#include <cmath>

#include <Eigen/LU>

#include "holdfast/core/types.hpp"

namespace holdfast {

/// What a segment of an elastic catenary spans, as a function of the forces at its left end.
template <class Scalar>
struct CatenaryExtent {
  Scalar horizontal;             ///< m
  Scalar vertical;               ///< m, downward
  Matrix<Scalar, 2> derivative;  ///< ∂(horizontal, vertical)/∂(H, V) (m/N), symmetric, positive
};

/// One segment of an elastic catenary of weight w (N per unstretched metre) and axial stiffness EA:
/// with the horizontal tension H and the upward force V that its left end exerts, the tension at
/// the unstretched coordinate s has the components (H, V − w s), T = √(H² + (V − w s)²), and
///
///     x = H l/EA + (H/w) [asinh(V/H) − asinh((V − w l)/H)]
///     y = l (2V − w l)/(2EA) + [T(0) − T(l)]/w
///
/// The derivative is the Hessian of the complementary energy ∫ (T²/2EA + T) ds: symmetric, and
/// positive definite for H > 0. Source: Irvine 1981, Sect. 1.4.
/// @param weight          w (N/m), > 0
/// @param stiffness       EA (N), > 0
/// @param tension         H (N), > 0
/// @param vertical_force  V (N), of either sign
/// @param length          l (m), ≥ 0
template <class Scalar>
CatenaryExtent<Scalar> catenary_extent(const Scalar& weight, const Scalar& stiffness,
                                       const Scalar& tension, const Scalar& vertical_force,
                                       const Scalar& length) {
  using std::asinh;
  using std::sqrt;
  const Scalar end_force = vertical_force - weight * length;
  const Scalar first = sqrt(tension * tension + vertical_force * vertical_force);
  const Scalar last = sqrt(tension * tension + end_force * end_force);
  const Scalar turn = (asinh(vertical_force / tension) - asinh(end_force / tension)) / weight;
  const Scalar sines = (vertical_force / first - end_force / last) / weight;
  const Scalar coupling = tension / weight * (Scalar(1) / first - Scalar(1) / last);
  const Scalar stretch = length / stiffness;
  CatenaryExtent<Scalar> extent;
  extent.horizontal = tension * (stretch + turn);
  extent.vertical = stretch * (vertical_force + end_force) / Scalar(2) + (first - last) / weight;
  extent.derivative << stretch + turn - sines, coupling, coupling, stretch + sines;
  return extent;
}

}  // namespace holdfast
