#pragma once

#include <cmath>

#include "holdfast/core/errors.hpp"

namespace holdfast {

/// A conductor (or stay) that hangs between two level supports.
///
/// Coordinates: x to the right from the left support, 0 … L; w downward. For an inclined stay take
/// the chord as span and the gravity normal to it (g cos α).
template <class Scalar>
struct Conductor {
  Scalar mass_per_length;  ///< μ (kg/m of unstretched length), > 0
  Scalar span;             ///< L (m), > 0
  Scalar sag;              ///< f (m) at mid-span under its own weight, 0 < f < L/2
  Scalar area;             ///< cross section (m²), > 0
  Scalar youngs_modulus;   ///< E (Pa), > 0
  Scalar damping_ratio;    ///< ζ, fraction of critical damping, 0 ≤ ζ < 1
  Scalar gravity;          ///< g (m/s²), > 0

  /// μ g (N/m).
  Scalar weight_per_length() const { return mass_per_length * gravity; }
  /// μ g L (N).
  Scalar weight() const { return weight_per_length() * span; }
  /// E A (N).
  Scalar axial_stiffness() const { return youngs_modulus * area; }
  /// H = μ g L² / (8 f) (N), horizontal tension of the parabola with this sag.
  Scalar parabolic_tension() const { return weight() * span / (Scalar(8) * sag); }
  /// L_e = L (1 + 8 (f/L)²) (m), the length over which the additional tension stretches the cable.
  Scalar effective_length() const {
    const Scalar ratio = sag / span;
    return span * (Scalar(1) + Scalar(8) * ratio * ratio);
  }
  /// λ² = (μ g L/H)² L E A / (H L_e), Irvine's parameter: 0 for the taut string, ∞ for the
  /// inextensible cable. Source: H. M. Irvine, Cable Structures, MIT Press, 1981.
  Scalar irvine_parameter() const {
    const Scalar tension = parabolic_tension();
    const Scalar slope = weight() / tension;
    return slope * slope * span * axial_stiffness() / (tension * effective_length());
  }
  /// √(H/μ) (m/s), the speed of transverse waves.
  Scalar transverse_wave_speed() const {
    using std::sqrt;
    return sqrt(parabolic_tension() / mass_per_length);
  }
};

/// Refuses a conductor outside the ranges that its members state.
/// @throws InvalidParameter naming the first member that is not admissible
inline void validate(const Conductor<double>& conductor) {
  require_positive("mass per length mu", conductor.mass_per_length, "kg/m");
  require_positive("span L", conductor.span, "m");
  require_positive("sag f", conductor.sag, "m");
  require_positive("area", conductor.area, "m^2");
  require_positive("Young's modulus E", conductor.youngs_modulus, "Pa");
  require_positive("gravity g", conductor.gravity, "m/s^2");
  if (conductor.sag >= conductor.span / 2)
    throw InvalidParameter("sag f", conductor.sag, "m", "below half the span");
  if (!(conductor.damping_ratio >= 0 && conductor.damping_ratio < 1))
    throw InvalidParameter("damping ratio zeta", conductor.damping_ratio, "", ">= 0 and < 1");
}

/// Refuses a position (m) along the span (m) that is not inside it.
/// @throws InvalidParameter unless 0 < position < span
inline void require_inside_span(double position, double span) {
  if (position > 0 && position < span) return;
  throw InvalidParameter("position", position, "m", "inside the span");
}

/// The conductor of Kollár 2022, Table 1: a small-scale transmission line of 6.4 m span.
inline Conductor<double> kollar2022_conductor() {
  return {0.043, 6.4, 0.29, 5.5e-6, 18e9, 0.02, 9.81};
}

}  // namespace holdfast
