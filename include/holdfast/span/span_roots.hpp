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

/// Waves y(x) e^{st} on a taut string with devices, with y = 0 and slope 1 at the left support.
/// Where s is an eigenvalue of the span with its devices, y is also 0 at the right support.
///
/// Damping of the string is modelled by the complex tension T e^{2iφ} with sin φ = ζ, for Im s > 0.
/// Without devices each mode then has the eigenvalue s = iω e^{iφ} and exactly the damping ratio ζ.
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

  /// y at the right support over its value without devices, at s (1/s); zero if s is an eigenvalue.
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

/// An eigenvalue of a span with its devices, for one mode n.
struct SpanRoot {
  std::complex<double> bare;  ///< eigenvalue s (1/s) of the mode without devices
  std::complex<double> root;  ///< eigenvalue s (1/s) with devices; NaN where not found
  /// Damping ratio to first order in the impedances Z of the devices, at distances a from a
  /// support: damping ratio of the bare mode plus Σ sin²(nπa/L) Re Z(iω_n)/(μ L ω_n).
  double first_order;
  /// Damping ratio by Krenk's asymptote for devices near the supports, at distances a from the
  /// nearer one: damping ratio of the bare mode plus Σ (a/L) Im[iη/(1 + iη)], η = (Z/Z_c) nπ a/L.
  double asymptotic;

  double damping() const { return -root.real() / std::abs(root); }  ///< ζ of `root`, −Re s/|s|
  double frequency() const { return std::abs(root) / (2.0 * pi<double>); }  ///< |s|/2π (Hz)
};

/// The damping ratios `first_order` and `asymptotic` of mode n of a taut string with devices. The
/// eigenvalues are not computed: `bare` is 0 and `root` NaN.
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

/// The eigenvalue and damping ratios of mode n of a taut string with devices, as in `span_roots`.
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

/// The eigenvalues s of a taut string with devices, for modes 1 … count. For an undamped string
/// with one device of impedance Z at distance a from a support (Krenk, J. Eng. Mech. 126 (2000)),
///
///     sinh γL + (Z(s)/Z_c) sinh γa sinh γ(L − a) = 0,   γ = s/c
///
/// Each eigenvalue is continued from the mode without devices while the devices' effect grows from
/// 0 to 1 (`root_from_pole`). If two eigenvalues coincide on the way, their modes may be exchanged.
/// The held force of an ActiveAbsorber is included by its component e^{st} only.
/// @param string   taut string; its bending stiffness is not used
/// @param devices  in any order
/// @param count    number of modes
/// @throws InvalidParameter where the string is not admissible, a device is not inside the span or
/// the count is outside 1 … 10⁵
inline std::vector<SpanRoot> span_roots(const TautString<double>& string,
                                        const std::vector<SpanDevice>& devices, int count) {
  require_within("number of modes", count, "", 1, 100000);
  const std::vector<SpanDevice> ordered = in_order(devices, string.span);
  std::vector<SpanRoot> roots;
  for (int n = 1; n <= count; ++n) roots.push_back(span_root(string, ordered, n));
  return roots;
}

}  // namespace holdfast
