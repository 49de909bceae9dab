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

/// Shooting method for the eigenvalues s of a taut string with devices. The deflection y(x) e^{st}
/// has y = 0 and slope 1 at the left support. If s is an eigenvalue, y is 0 at the right support.
///
/// Damping of the string is modelled by the complex tension T e^{2iφ} with sin φ = ζ, for Im s > 0.
/// Without devices a mode of frequency ω (rad/s) then has s = iω e^{iφ} and the damping ratio ζ.
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

  /// The eigenvalue s (1/s) of mode n ≥ 1 without devices, with the string's damping ratio ζ.
  Complex bare_root(int n) const {
    return Complex(0.0, n * pi<double> * string_.wave_speed() / string_.span) * turn_;
  }

  /// Ratio of y at the right support to its value without devices, at s (1/s); 0 at an eigenvalue.
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

/// The eigenvalue of mode n of a taut string with devices, and two estimates of its damping ratio.
/// L: span, μ: mass per length, Z_c: wave impedance, ω_n: angular frequency without devices.
struct SpanRoot {
  std::complex<double> bare;  ///< eigenvalue s (1/s) of the mode without devices
  std::complex<double> root;  ///< eigenvalue s (1/s) with devices; NaN where not found
  /// Damping ratio to first order in the impedances Z of the devices: damping ratio without devices
  /// plus Σ sin²(nπa/L) Re Z(iω_n)/(μ L ω_n). A device is at the distance a (m) from a support.
  double first_order;
  /// Damping ratio by Krenk's asymptote for devices at small distances a (m) from a support: ratio
  /// without devices plus Σ (a/L) Im[iη/(1 + iη)] with η = (Z(iω_n)/Z_c) nπ a/L.
  double asymptotic;

  double damping() const { return -root.real() / std::abs(root); }  ///< damping ratio −Re s/|s|
  double frequency() const { return std::abs(root) / (2.0 * pi<double>); }  ///< |s|/2π (Hz)
};

/// The estimates `first_order` and `asymptotic` of the damping ratio of mode n of a taut string
/// with devices. The eigenvalues are not computed: `bare` is 0 and `root` NaN.
/// @param string   taut string with the damping ratio of mode n; bending stiffness is not used
/// @param devices  devices in any order, inside the span (unchecked)
/// @param n        mode number, which is the number of half-waves, ≥ 1
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

/// The eigenvalue and damping ratios of mode n alone, computed as `span_roots` does for many modes.
/// @param string   taut string with the damping ratio of mode n; bending stiffness is not used
/// @param devices  devices sorted by `in_order` (unchecked)
/// @param n        mode number, which is the number of half-waves, ≥ 1
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

/// The eigenvalues s of a taut string with devices, for the modes 1 … count. With one device at the
/// distance a from a support and no damping, s solves (Krenk, J. Eng. Mech. 126 (2000))
///
///     sinh γL + (Z(s)/Z_c) sinh γa sinh γ(L − a) = 0,   γ = s/c
///
/// Z is the impedance of the device, Z_c the wave impedance, c the wave speed and L the span. Each
/// eigenvalue is found by continuation (`root_from_pole`) from the mode without devices to the full
/// effect of the devices. Where two eigenvalues meet on this path, their modes may be exchanged.
/// The force of an ActiveAbsorber is held between samples; only its component e^{st} is included.
/// @param string   taut string; its bending stiffness is not used
/// @param devices  devices in any order, inside the span
/// @param count    number of modes, 1 … 10⁵
/// @throws InvalidParameter where the string, the position of a device or the count is inadmissible
inline std::vector<SpanRoot> span_roots(const TautString<double>& string,
                                        const std::vector<SpanDevice>& devices, int count) {
  require_within("number of modes", count, "", 1, 100000);
  const std::vector<SpanDevice> ordered = in_order(devices, string.span);
  std::vector<SpanRoot> roots;
  for (int n = 1; n <= count; ++n) roots.push_back(span_root(string, ordered, n));
  return roots;
}

}  // namespace holdfast
