#pragma once

#include <array>
#include <cmath>
#include <string_view>

#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"

namespace holdfast {

/// A stranded conductor: the data on which its self-damping depends.
struct StrandedConductor {
  double mass_per_length;  ///< mass per length μ (kg/m), > 0
  double diameter;         ///< diameter d (m), > 0
  double rated_strength;   ///< rated tensile strength RTS (N), > 0
  double tension;          ///< tension T (N), > 0, below RTS
};

/// Checks that every member is inside its stated range.
/// @throws InvalidParameter naming the first member that is not admissible
inline void validate(const StrandedConductor& conductor) {
  require_positive("mass per length", conductor.mass_per_length, "kg/m");
  require_positive("diameter", conductor.diameter, "m");
  require_positive("rated strength", conductor.rated_strength, "N");
  require_positive("tension", conductor.tension, "N");
  if (!(conductor.tension < conductor.rated_strength))
    throw InvalidParameter("tension", conductor.tension, "N", "below the rated strength");
}

/// A law of the power per length that a stranded conductor loses by friction of its wires:
///
///     P_self = k (y/d)^l f^m/T^n  (mW/m),   k = d/√(RTS μ)
///
/// f (Hz) is the frequency and y the amplitude, zero to peak, at the antinodes. The other symbols
/// are those of `StrandedConductor`: RTS and T in kN, μ in kg/m, and d in the formula of k in mm.
struct SelfDampingLaw {
  std::string_view name;      ///< name of the law's authors
  double amplitude_exponent;  ///< exponent l of the relative amplitude y/d
  double frequency_exponent;  ///< exponent m of the frequency f
  double tension_exponent;    ///< exponent n of the tension T

  /// The lost power P_self per length (W/m) at a frequency f (Hz) and an antinode amplitude y (m).
  double power(const StrandedConductor& conductor, double frequency, double amplitude) const {
    constexpr double milli = 1e-3;
    const double strength = milli * conductor.rated_strength, tension = milli * conductor.tension;
    const double k = conductor.diameter / milli / std::sqrt(strength * conductor.mass_per_length);
    return milli * k * std::pow(amplitude / conductor.diameter, amplitude_exponent) *
           std::pow(frequency, frequency_exponent) / std::pow(tension, tension_exponent);
  }
};

/// Self-damping laws by three groups of authors, collected by CIGRE Study Committee 22, Working
/// Group 11. They extrapolate different measurements and differ by a factor of three at 20 Hz.
inline constexpr std::array<SelfDampingLaw, 3> self_damping_laws = {
    SelfDampingLaw{"noiseux", 2.44, 5.63, 2.76}, SelfDampingLaw{"kraus_hagedorn", 2.47, 5.38, 2.80},
    SelfDampingLaw{"seppa", 2.5, 5.75, 2.8}};

/// The mean power loss per length ½ ζ μ ω³ y² (W/m) of a vibration mode with damping ratio ζ.
/// @param mass_per_length    mass per length μ (kg/m)
/// @param damping_ratio      damping ratio ζ, as a fraction of critical damping
/// @param angular_frequency  angular frequency ω (rad/s)
/// @param amplitude          amplitude y (m), zero to peak, at the antinodes
inline double damped_power(double mass_per_length, double damping_ratio, double angular_frequency,
                           double amplitude) {
  return 0.5 * damping_ratio * mass_per_length * angular_frequency * angular_frequency *
         angular_frequency * amplitude * amplitude;
}

}  // namespace holdfast
