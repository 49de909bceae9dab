#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/math/linalg/eigenvalues.hpp"
#include "holdfast/plant/two_mass.hpp"

namespace holdfast {

/// A mode that oscillates freely: the eigenvalue s of positive imaginary part, in rad/s.
struct NaturalMode {
  std::complex<double> eigenvalue;  ///< s = −ζω ± iω√(1 − ζ²), rad/s

  /// |s|/2π, Hz: the natural frequency, for small damping also that of the vibration.
  double frequency() const { return std::abs(eigenvalue) / (2.0 * pi<double>); }
  /// ζ = −Re s/|s|; below 1, negative for a mode that grows.
  double damping_ratio() const { return -eigenvalue.real() / std::abs(eigenvalue); }
};

/// The oscillating modes of a plant without control and force, the slowest first.
/// A mode of overcritical damping (ζ ≥ 1) is two real eigenvalues and not among them.
/// @param plant  has state_matrix(), in 1/s
/// @throws InvalidParameter for two masses that are not admissible, or a matrix that is not finite
template <class Plant>
std::vector<NaturalMode> natural_modes(const Plant& plant) {
  detail::require_admissible(plant);
  require_finite("entries of the plant's state matrix", plant.state_matrix().sum(), "");
  std::vector<NaturalMode> modes;
  for (const std::complex<double>& value : eigenvalues(plant.state_matrix()))
    if (value.imag() > 0.0) modes.push_back({value});
  std::sort(modes.begin(), modes.end(), [](const NaturalMode& a, const NaturalMode& b) {
    return std::abs(a.eigenvalue) < std::abs(b.eigenvalue);
  });
  return modes;
}

}  // namespace holdfast
