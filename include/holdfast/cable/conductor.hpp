#pragma once

#include <cmath>

#include "holdfast/core/errors.hpp"

namespace holdfast {

/// A conductor (or stay) that hangs between two level supports. Its coordinate x runs from 0 at the
/// left support to L at the right one; displacements w are downward. For a stay inclined by α, the
/// span is the chord, and the gravity is the component g cos α normal to the chord.
template <class Scalar>
struct Conductor {
  Scalar mass_per_length;  ///< mass μ per unstretched length (kg/m), > 0
  Scalar span;             ///< span L (m), > 0
  Scalar sag;              ///< sag f (m) at mid-span under the conductor's own weight, 0 < f < L/2
  Scalar area;             ///< cross section A (m²), > 0
  Scalar youngs_modulus;   ///< Young's modulus E (Pa), > 0
  Scalar damping_ratio;    ///< damping ratio ζ of each mode (1: critical damping), 0 ≤ ζ < 1
  Scalar gravity;          ///< acceleration of gravity g (m/s²), > 0

  /// Weight per length μ g (N/m).
  Scalar weight_per_length() const { return mass_per_length * gravity; }
  /// Weight μ g L (N) of the conductor, whose length is taken as the span L.
  Scalar weight() const { return weight_per_length() * span; }
  /// Axial stiffness E A (N).
  Scalar axial_stiffness() const { return youngs_modulus * area; }
  /// Horizontal tension H = μ g L² / (8 f) (N) of the parabola with the sag f.
  Scalar parabolic_tension() const { return weight() * span / (Scalar(8) * sag); }
  /// Effective length L_e = L (1 + 8 (f/L)²) (m): a tension h (N) stretches the cable by h L_e/EA.
  Scalar effective_length() const {
    const Scalar ratio = sag / span;
    return span * (Scalar(1) + Scalar(8) * ratio * ratio);
  }
  /// Irvine's parameter λ² = (μ g L/H)² L EA/(H L_e), dimensionless, with H of parabolic_tension();
  /// 0: taut string, ∞: inextensible cable. Source: H. M. Irvine, Cable Structures, 1981.
  Scalar irvine_parameter() const {
    const Scalar tension = parabolic_tension();
    const Scalar slope = weight() / tension;
    return slope * slope * span * axial_stiffness() / (tension * effective_length());
  }
  /// Speed √(H/μ) (m/s) of transverse waves.
  Scalar transverse_wave_speed() const {
    using std::sqrt;
    return sqrt(parabolic_tension() / mass_per_length);
  }
};

/// Rejects a conductor with a member outside the range stated there.
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

/// Rejects a position (m from the left support) that is not inside the span (m).
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
