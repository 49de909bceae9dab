#pragma once

#include <cmath>

#include "holdfast/core/errors.hpp"

namespace holdfast {

/// A conductor at a clamp, modelled as a beam under tension whose wires bend independently of each
/// other (Poffenberger & Swart, IEEE Trans. PAS 84 (1965)). At the distance x from the clamp the
/// deflection is y = θ (x − (1 − e^{−px})/p) with p = √(T/EI); θ is the slope far from the clamp.
///
/// Stress and strain are amplitudes, zero to peak, in an outer wire at the clamp.
struct ClampBending {
  double tension;              ///< tension T (N), > 0
  double bending_stiffness;    ///< minimum bending stiffness EI (N m²), sum over all wires, > 0
  double outer_wire_diameter;  ///< diameter d_a (m) of an outer wire, > 0
  double outer_wire_modulus;   ///< Young's modulus E_a (Pa) of an outer wire, > 0

  /// Decay constant p = √(T/EI) (1/m) of the bending near the clamp.
  double decay() const { return std::sqrt(tension / bending_stiffness); }

  /// The strain amplitude ε = ½ d_a p θ for a slope amplitude θ (rad) far from the clamp.
  double strain_of_angle(double angle) const { return 0.5 * outer_wire_diameter * decay() * angle; }

  /// The stress amplitude σ = E_a d_a p² Y_b/(4 (e^{−ps} − 1 + ps)) (Pa).
  /// @param bending_amplitude  displacement Y_b (m) at `place` relative to the clamp, peak to peak
  /// @param place              distance s (m) from the last point of contact with the clamp, > 0
  double stress_of_bending_amplitude(double bending_amplitude, double place = 0.089) const {
    const double p = decay();
    return outer_wire_modulus * outer_wire_diameter * p * p * bending_amplitude /
           (4.0 * (std::exp(-p * place) - 1.0 + p * place));
  }
};

/// Checks that every member is inside its stated range.
/// @throws InvalidParameter naming the first member that is not admissible
inline void validate(const ClampBending& bending) {
  require_positive("tension", bending.tension, "N");
  require_positive("bending stiffness", bending.bending_stiffness, "N m^2");
  require_positive("diameter of the outer wires", bending.outer_wire_diameter, "m");
  require_positive("modulus of the outer wires", bending.outer_wire_modulus, "Pa");
}

}  // namespace holdfast
