#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "holdfast/cable/taut_string.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/math/roots/root_from_pole.hpp"
#include "holdfast/span/device/span_device.hpp"

namespace holdfast {

/// Deflection at the right support of a string that leaves the left support with slope 1, for waves
/// e^{st}. The deflection is zero where s is an eigenvalue of the span with its devices.
///
/// The string's damping is a complex stiffness, T e^{2iφ} with sin φ = ζ, so that each mode alone
/// has s = iω e^{iφ} and exactly the damping ratio ζ; this is valid for Im s > 0.
class SpanWaves {
 public:
  using Complex = std::complex<double>;  ///< type of s and of deflections

  /// @param string   taut string; its bending stiffness is not used
  /// @param devices  sorted by `in_order`; must outlive this object
  /// @throws InvalidParameter where the string is not admissible
  SpanWaves(const TautString<double>& string, const std::vector<SpanDevice>& devices)
      : string_(string), devices_(devices) {
    validate(string);
    const double zeta = string.damping_ratio;
    turn_ = Complex(std::sqrt(1.0 - zeta * zeta), zeta);
  }

  /// The eigenvalue s of mode n without devices (1/s), with its damping ratio ζ_n.
  Complex bare_root(int n) const {
    return Complex(0.0, n * pi<double> * string_.wave_speed() / string_.span) * turn_;
  }

  /// The ratio of the deflection at the right support for waves e^{st} to that without devices.
  Complex held(const Complex& s) const {
    const Complex rate = s / (string_.wave_speed() * turn_);
    const Complex tension = string_.tension * turn_ * turn_;
    Complex y(0.0), slope(1.0);
    double at = 0.0;
    for (const SpanDevice& device : devices_) {
      run(device.position - at, rate, y, slope);
      slope += device.impedance(s) * s * y / tension;
      at = device.position;
    }
    run(string_.span - at, rate, y, slope);
    return y * rate / std::sinh(rate * string_.span);
  }

 private:
  /// Propagates y and its slope over the distance `way` (m) along the string.
  static void run(double way, const Complex& rate, Complex& y, Complex& slope) {
    const Complex sine = std::sinh(rate * way), cosine = std::cosh(rate * way);
    const Complex moved = y * cosine + slope * sine / rate;
    slope = slope * cosine + y * rate * sine;
    y = moved;
  }

  TautString<double> string_;
  const std::vector<SpanDevice>& devices_;
  Complex turn_;  // e^{iφ}
};

/// An eigenvalue of a span with its devices.
struct SpanRoot {
  std::complex<double> bare;  ///< eigenvalue s (1/s) of the mode without devices
  std::complex<double> root;  ///< eigenvalue s with devices; NaN where the continuation failed
  /// Damping ratio of the bare mode plus that of light devices, Σ sin²(nπa/L) Re Z(iω_n)/(μ L ω_n).
  double first_order;
  /// Damping ratio of the bare mode plus that of devices near the supports by Krenk's asymptote,
  /// Σ (a/L) Im iη/(1 + iη), with η = (Z/Z_c) nπ a/L and the distance a from the nearer support.
  double asymptotic;

  double damping() const { return -root.real() / std::abs(root); }          ///< ζ = −Re s/|s|
  double frequency() const { return std::abs(root) / (2.0 * pi<double>); }  ///< |s|/2π (Hz)
};

/// The damping ratios `first_order` and `asymptotic` of mode n of a taut string; `root` is NaN.
/// @param string   taut string with the damping ratio of mode n; bending stiffness is not used
/// @param devices  inside the span (unchecked)
/// @param n        number of half-waves, ≥ 1
inline SpanRoot span_root_laws(const TautString<double>& string,
                               const std::vector<SpanDevice>& devices, int n) {
  using Complex = std::complex<double>;
  SpanRoot found{};
  found.root = {std::nan(""), 0.0};
  const double half_waves = n * pi<double>, omega = half_waves * string.wave_speed() / string.span;
  found.first_order = found.asymptotic = string.damping_ratio;
  for (const SpanDevice& device : devices) {
    const Complex z = device.impedance(Complex(0.0, omega));
    const double near = std::min(device.position, string.span - device.position) / string.span;
    const double shape = std::sin(half_waves * near);
    found.first_order += shape * shape * z.real() / (string.mass_per_length * string.span * omega);
    const Complex turned = Complex(0.0, 1.0) * z / string.wave_impedance() * half_waves * near;
    found.asymptotic += near * (turned / (1.0 + turned)).imag();
  }
  return found;
}

/// Eigenvalue of mode n of a taut string with devices, see `span_roots`.
/// @param string   taut string with the damping ratio of mode n; bending stiffness is not used
/// @param devices  sorted by `in_order` (unchecked)
/// @param n        number of half-waves, ≥ 1
/// @throws InvalidParameter where the string is not admissible
inline SpanRoot span_root(const TautString<double>& string, const std::vector<SpanDevice>& devices,
                          int n) {
  const SpanWaves waves(string, devices);
  SpanRoot found = span_root_laws(string, devices, n);
  found.bare = waves.bare_root(n);
  const auto loop_gain = [&](const std::complex<double>& s) { return 1.0 - waves.held(s); };
  found.root = devices.empty() ? found.bare : root_from_pole(loop_gain, found.bare);
  return found;
}

/// The eigenvalues of a taut string with devices for the modes 1 … count: roots of
///
///     sinh γL + Σ_j (Z_j/Z_c) sinh γa_j sinh γ(L − a_j) + …,   γ = s/c
///
/// for example, with one dashpot c_d to the ground, sin βL + i (c_d/Z_c) sin βa sin β(L − a) = 0,
/// s = iβc (Krenk, J. Eng. Mech. 126 (2000)). Each root is continued from a bare mode.
///
/// The continuation proves nothing: if two roots meet during it, their modes may be exchanged.
/// For an ActiveAbsorber only the part of its force at the frequency of the motion is included. A
/// measured device acts with its impedance at ω = |s|.
/// @param string   taut string; its bending stiffness is not used
/// @param devices  in any order
/// @param count    number of modes
/// @throws InvalidParameter where the string is not admissible, a device is outside it or the count
/// is outside 1 … 10⁵
inline std::vector<SpanRoot> span_roots(const TautString<double>& string,
                                        const std::vector<SpanDevice>& devices, int count) {
  require_within("number of modes", count, "", 1, 100000);
  const std::vector<SpanDevice> ordered = in_order(devices, string.span);
  std::vector<SpanRoot> roots;
  for (int n = 1; n <= count; ++n) roots.push_back(span_root(string, ordered, n));
  return roots;
}

}  // namespace holdfast
