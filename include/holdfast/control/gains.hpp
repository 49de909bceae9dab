#pragma once

#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"

namespace holdfast {

/// Gains of the proportional–differential law u = P z₁ + D ż₁.
/// Source: Kollár 2022, Eq. (5) and Eq. (11), whose row matrix D is [P, D, 0, 0].
template <class Scalar>
struct PdGains {
  Scalar proportional;  ///< P (N/m), finite
  Scalar differential;  ///< D (N s/m), finite

  /// K = [P, D, 0, 0], 1 × 4, so that u = K z.
  RowVector<Scalar, 4> feedback_row() const {
    return {proportional, differential, Scalar(0), Scalar(0)};
  }
};

/// @throws InvalidParameter unless both gains are finite
inline void validate(const PdGains<double>& gains) {
  require_finite("proportional gain P", gains.proportional, "N/m");
  require_finite("differential gain D", gains.differential, "N s/m");
}

/// P = k₂ − m₂ ω², the proportional gain that tunes the absorber to the excitation.
/// Source: Kollár 2022, Eq. (6).
/// @param absorber_stiffness  k₂ (N/m), > 0
/// @param absorber_mass       m₂ (kg), > 0
/// @param frequency           excitation frequency f = ω / 2π (Hz), > 0
/// @return P in N/m; negative above the absorber's own frequency
template <class Scalar>
Scalar tuned_proportional_gain(const Scalar& absorber_stiffness, const Scalar& absorber_mass,
                               const Scalar& frequency) {
  const Scalar angular_frequency = Scalar(2) * pi<Scalar> * frequency;
  return absorber_stiffness - absorber_mass * angular_frequency * angular_frequency;
}

}  // namespace holdfast
