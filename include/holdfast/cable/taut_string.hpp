#pragma once

#include <cmath>
#include <complex>
#include <type_traits>
#include <vector>

#include "holdfast/cable/conductor.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/plant/modal_plant.hpp"

namespace holdfast {

/// A conductor so tight that its sag does not count: the taut string, with the stiffness of a beam
/// against bending where that matters.
template <class Scalar>
struct TautString {
  Scalar tension;                ///< T (N), > 0
  Scalar mass_per_length;        ///< μ (kg/m), > 0
  Scalar span;                   ///< L (m), > 0
  Scalar damping_ratio;          ///< ζ of each mode, 0 ≤ ζ < 1
  Scalar bending_stiffness = 0;  ///< EI (N m²), ≥ 0

  /// c = √(T/μ) (m/s), the speed of transverse waves.
  Scalar wave_speed() const {
    using std::sqrt;
    return sqrt(tension / mass_per_length);
  }
  /// Z_c = √(T μ) (N s/m), force over velocity in a wave that runs one way.
  Scalar wave_impedance() const {
    using std::sqrt;
    return sqrt(tension * mass_per_length);
  }
  /// M_n = μ L/2 (kg), of every mode sin(nπx/L).
  Scalar modal_mass() const { return mass_per_length * span / Scalar(2); }
  /// ω_n = (nπ/L) √(T/μ) √(1 + n²π² EI/(T L²)) (rad/s), n ≥ 1.
  Scalar angular_frequency(int n) const {
    using std::sqrt;
    const Scalar waves = Scalar(n) * pi<Scalar> / span;
    return waves * wave_speed() * sqrt(Scalar(1) + waves * waves * bending_stiffness / tension);
  }
};

/// Refuses a string outside the ranges that its members state.
/// @throws InvalidParameter naming the first member that is not admissible
inline void validate(const TautString<double>& string) {
  require_positive("tension T", string.tension, "N");
  require_positive("mass per length mu", string.mass_per_length, "kg/m");
  require_positive("span L", string.span, "m");
  require_non_negative("bending stiffness EI", string.bending_stiffness, "N m^2");
  if (!(string.damping_ratio >= 0 && string.damping_ratio < 1))
    throw InvalidParameter("damping ratio zeta", string.damping_ratio, "", ">= 0 and < 1");
}

/// The string with the tension that the conductor's sag leaves, H = μ g L²/(8 f).
template <class Scalar>
TautString<Scalar> taut_string(const Conductor<Scalar>& conductor) {
  return {conductor.parabolic_tension(), conductor.mass_per_length, conductor.span,
          conductor.damping_ratio};
}

/// H(s) = sinh(s a/c) sinh(s (L − a)/c) / (s Z_c sinh(s L/c)) (m/N): the receptance of the string
/// without damping and bending stiffness at a place a from the left support, all its modes at once
/// (unchecked). Written in decaying exponentials, so that no s with Re s ≥ 0 overflows.
/// @param string  whose damping and bending stiffness do not count
/// @param place   a (m), inside the span
/// @param s       1/s, Re s ≥ 0, not on a mode
template <class Scalar>
std::complex<Scalar> receptance(const TautString<Scalar>& string, const Scalar& place,
                                const std::complex<Scalar>& s) {
  const auto left_behind = [&](const Scalar& way) {
    return Scalar(1) - std::exp(Scalar(-2) * s * way / string.wave_speed());
  };
  return left_behind(place) * left_behind(string.span - place) /
         (Scalar(2) * s * string.wave_impedance() * left_behind(string.span));
}

/// The modes sin(nπx/L), n = 1 … count, as a place a (m) from the left support sees them.
/// @throws InvalidParameter for an inadmissible string, a place outside it or a count outside
///         1 … 10⁴
template <class Scalar>
std::vector<PlaceMode<Scalar>> string_modes(const TautString<Scalar>& string, const Scalar& place,
                                            int count) {
  using std::sin;
  if constexpr (std::is_same_v<Scalar, double>) {
    validate(string);
    require_inside_span(place, string.span);
  }
  require_within("number of modes", count, "", 1, 10000);
  std::vector<PlaceMode<Scalar>> modes;
  for (int n = 1; n <= count; ++n)
    modes.push_back({string.angular_frequency(n), string.damping_ratio,
                     sin(Scalar(n) * pi<Scalar> * place / string.span), string.modal_mass()});
  return modes;
}

}  // namespace holdfast
