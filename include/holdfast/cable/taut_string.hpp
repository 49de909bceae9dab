#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <type_traits>
#include <vector>

#include "holdfast/cable/conductor.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/plant/modal_plant.hpp"

namespace holdfast {

/// A taut string: a conductor with negligible sag and an optional bending stiffness.
template <class Scalar>
struct TautString {
  Scalar tension;                ///< tension T (N), > 0
  Scalar mass_per_length;        ///< mass per length μ (kg/m), > 0
  Scalar span;                   ///< span L (m), > 0
  Scalar damping_ratio;          ///< damping ratio ζ of each mode, 0 ≤ ζ < 1
  Scalar bending_stiffness = 0;  ///< bending stiffness EI (N m²), ≥ 0

  /// Speed c = √(T/μ) (m/s) of transverse waves.
  Scalar wave_speed() const {
    using std::sqrt;
    return sqrt(tension / mass_per_length);
  }
  /// Wave impedance Z_c = √(T μ) (N s/m): force over velocity in a travelling wave.
  Scalar wave_impedance() const {
    using std::sqrt;
    return sqrt(tension * mass_per_length);
  }
  /// Modal mass M_n = μ L/2 (kg) of every mode sin(nπx/L).
  Scalar modal_mass() const { return mass_per_length * span / Scalar(2); }
  /// Angular frequency (nπ/L) √(T/μ) √(1 + n²π² EI/(T L²)) (rad/s) of mode n, any real n > 0.
  Scalar angular_frequency(const Scalar& n) const {
    using std::sqrt;
    const Scalar waves = n * pi<Scalar> / span;
    return waves * wave_speed() * sqrt(Scalar(1) + waves * waves * bending_stiffness / tension);
  }
};

/// Rejects a string with a member outside the range stated there.
/// @throws InvalidParameter naming the first member that is not admissible
inline void validate(const TautString<double>& string) {
  require_positive("tension T", string.tension, "N");
  require_positive("mass per length mu", string.mass_per_length, "kg/m");
  require_positive("span L", string.span, "m");
  require_non_negative("bending stiffness EI", string.bending_stiffness, "N m^2");
  if (!(string.damping_ratio >= 0 && string.damping_ratio < 1))
    throw InvalidParameter("damping ratio zeta", string.damping_ratio, "", ">= 0 and < 1");
}

/// The taut string of a conductor with sag f: tension H = μ g L²/(8 f), bending stiffness 0.
template <class Scalar>
TautString<Scalar> taut_string(const Conductor<Scalar>& conductor) {
  return {conductor.parabolic_tension(), conductor.mass_per_length, conductor.span,
          conductor.damping_ratio};
}

/// The receptance H(s) = sinh(s a/c) sinh(s (L − a)/c) / (s Z_c sinh(s L/c)) (m/N) of the string at
/// the distance a from its left support. It includes all modes. c is the wave speed, Z_c the wave
/// impedance and L the span. The arguments are not checked.
/// @param string  the string; its damping and bending stiffness are ignored
/// @param place   distance a (m) from the left support, inside the span
/// @param s       complex frequency (1/s) with Re s ≥ 0; neither 0 nor a pole ± iω of a mode
template <class Scalar>
std::complex<Scalar> receptance(const TautString<Scalar>& string, const Scalar& place,
                                const std::complex<Scalar>& s) {
  const auto left_behind = [&](const Scalar& way) {
    return Scalar(1) - std::exp(Scalar(-2) * s * way / string.wave_speed());
  };
  return left_behind(place) * left_behind(string.span - place) /
         (Scalar(2) * s * string.wave_impedance() * left_behind(string.span));
}

/// The modes sin(nπx/L), n = 1 … `count`, with their shapes at x = `place` (m), measured from the
/// left support.
/// @throws InvalidParameter for a string, place (inside the span) or count (1 … 10⁴) out of range
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
    modes.push_back({string.angular_frequency(Scalar(n)), string.damping_ratio,
                     sin(Scalar(n) * pi<Scalar> * place / string.span), string.modal_mass()});
  return modes;
}

/// An infinitely long string with a clamp, represented by one mode: no wave returns from the ends.
/// The receptance H (m/N) at the complex frequency s satisfies 1/H(s) = 2 Z_c s + M s² + k.
///
/// A mode needs a stiffness k and a mass M > 0, which an infinite string without clamp lacks. Hence
/// k = 10⁻¹³ · 2 Z_c/τ, and M is at least 10⁻¹³ · 2 Z_c τ. These values are so small that they only
/// change the thirteenth digit. With the least M the velocity follows a force in far less than τ.
/// @param wave_impedance   wave impedance Z_c = √(T μ) (N s/m) of the string, > 0
/// @param clamp_mass       mass M (kg) of the clamp, ≥ 0
/// @param sampling_period  sampling period τ (s), > 0
/// @throws InvalidParameter outside these ranges
inline PlaceMode<double> infinite_string_mode(double wave_impedance, double clamp_mass,
                                              double sampling_period) {
  require_positive("wave impedance", wave_impedance, "N s/m");
  require_non_negative("clamp mass", clamp_mass, "kg");
  require_positive("sampling period tau", sampling_period, "s");
  const double impedance = 2.0 * wave_impedance;
  const double mass = std::max(clamp_mass, 1e-13 * impedance * sampling_period);
  const double omega = std::sqrt(1e-13 * impedance / sampling_period / mass);
  return {omega, impedance / (2.0 * mass * omega), 1.0, mass};
}

/// A reduced set of modes of the string, accurate below the frequency of mode `count`. It contains
/// the modes 1 … `count`. The higher modes, up to the frequency `highest`, are combined in bundles
/// of increasing size. A bundle that begins with mode n combines h = 1 + (n − count − 1)/10 modes,
/// rounded down, and fewer with bending stiffness.
///
/// The set contains one mode in place of each bundle. Its modal mass is M = μL/(2h), and the square
/// φ² of its shape at `place` is the mean φ² of the h modes. With its angular frequency
/// √(ω(n − ½) ω(n + h − ½)), its static deflection is nearly that of the h modes. Its damping ratio
/// is about half its relative bandwidth, so that no waves return to `place`. Without bundles the
/// string would act there at high frequencies like a mass 1/Σ(φ²/M).
/// @param string   string whose modes are bundled
/// @param place    distance (m) from the left support, inside the span
/// @param count    number of modes that are not bundled, 1 … 10⁴
/// @param highest  upper limit (rad/s) of the angular frequency of a mode that begins a bundle
/// @throws InvalidParameter in the cases of `string_modes`, or if `highest` is not finite
template <class Scalar>
std::vector<PlaceMode<Scalar>> bundled_string_modes(const TautString<Scalar>& string,
                                                    const Scalar& place, int count,
                                                    const Scalar& highest) {
  using std::cos;
  using std::floor;
  using std::hypot;
  using std::max;
  using std::sin;
  using std::sqrt;
  require_finite("highest angular frequency", static_cast<double>(highest), "rad/s");
  std::vector<PlaceMode<Scalar>> modes = string_modes(string, place, count);
  const Scalar phase = pi<Scalar> * place / string.span, half(0.5);
  Scalar size;
  for (Scalar first(count + 1); string.angular_frequency(first) < highest; first += size) {
    const Scalar waves = first * pi<Scalar> / string.span;
    const Scalar stiff = waves * waves * string.bending_stiffness / string.tension;
    // d ln ω/d ln n: a bundle has the same relative bandwidth for a beam as for a string.
    const Scalar spread = (Scalar(1) + Scalar(2) * stiff) / (Scalar(1) + stiff);
    size = floor(Scalar(1) + (first - Scalar(count + 1)) / (Scalar(10) * spread));
    const Scalar lower = string.angular_frequency(first - half);
    const Scalar upper = string.angular_frequency(first + size - half);
    const Scalar omega = sqrt(lower) * sqrt(upper);
    const Scalar width = (upper - lower) / (Scalar(2) * omega) * (Scalar(1) - Scalar(1) / size);
    // Σ sin² over the bundle.
    const Scalar squares =
        size / Scalar(2) - sin(size * phase) * cos((Scalar(2) * first + size - Scalar(1)) * phase) /
                               (Scalar(2) * sin(phase));
    modes.push_back({omega, hypot(string.damping_ratio, width),
                     sqrt(max(squares / size, Scalar(0))), string.modal_mass() / size});
  }
  return modes;
}

}  // namespace holdfast
