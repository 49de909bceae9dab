#pragma once

#include <cmath>

#include "holdfast/core/types.hpp"
#include "holdfast/plant/two_mass.hpp"

namespace holdfast {

/// The energy norm ‖z‖ (√J) of a state z of the two masses. Twice the energy of this state is
/// ‖z‖² = k₁ z₁² + k₂ (z₂ − z₁)² + m₁ ż₁² + m₂ ż₂².
/// Springs and masses exchange energy and dampers dissipate it. Without input the norm does not
/// grow: ‖e^{At}‖ ≤ 1, and with input ‖z(t)‖ ≤ ‖z(0)‖ + ∫ ‖b u + c F‖ ds.
class EnergyNorm {
 public:
  /// Constructs the norm of a plant.
  /// @throws InvalidParameter where the plant is not admissible
  explicit EnergyNorm(const TwoMass<double>& plant) : plant_(plant) { validate(plant); }

  /// The norm ‖z‖ (√J) of a state z.
  double operator()(const Vector<double, 4>& state) const {
    const double relative = relative_displacement(state);
    return std::sqrt(plant_.conductor_stiffness * state[0] * state[0] +
                     plant_.absorber_stiffness * relative * relative +
                     plant_.conductor_mass * state[1] * state[1] +
                     plant_.absorber_mass * state[3] * state[3]);
  }

  /// The dual norm of a functional ℓ (4 × 1): the largest ℓᵀz over ‖z‖ = 1.
  double dual(const Vector<double, 4>& functional) const {
    const double together = functional[0] + functional[2];
    return std::sqrt(together * together / plant_.conductor_stiffness +
                     functional[2] * functional[2] / plant_.absorber_stiffness +
                     functional[1] * functional[1] / plant_.conductor_mass +
                     functional[3] * functional[3] / plant_.absorber_mass);
  }

 private:
  TwoMass<double> plant_;
};

}  // namespace holdfast
