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

/// An oscillating mode, given by its eigenvalue s with positive imaginary part.
struct NaturalMode {
  std::complex<double> eigenvalue;  ///< eigenvalue s = −ζω + iω√(1 − ζ²) (1/s)

  /// The natural frequency |s|/2π (Hz); for small damping also the frequency of free vibration.
  double frequency() const { return std::abs(eigenvalue) / (2.0 * pi<double>); }
  /// The damping ratio ζ = −Re s/|s|, below 1; negative for a growing mode.
  double damping_ratio() const { return -eigenvalue.real() / std::abs(eigenvalue); }
};

/// The oscillating modes of a plant without control and excitation, the slowest first. An
/// overdamped mode (ζ ≥ 1) has two real eigenvalues and is left out.
/// @param plant  plant whose `state_matrix()` is in 1/s
/// @throws InvalidParameter where two masses are not admissible, or a matrix is not finite
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
