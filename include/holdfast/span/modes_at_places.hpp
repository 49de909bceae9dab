#pragma once

#include <cstddef>
#include <vector>

#include "holdfast/cable/taut_string.hpp"

namespace holdfast {

/// A mode of a conductor with its shapes at several places.
struct ModeAtPlaces {
  double angular_frequency;    ///< angular frequency ω_n (rad/s), > 0
  double damping_ratio;        ///< damping ratio ζ_n, ≥ 0, ≠ 1
  double mass;                 ///< modal mass M_n (kg), > 0
  std::vector<double> shapes;  ///< mode shape φ_n at each place
};

/// The modes of a taut string at several places: the sines 1 … count, and higher modes in bundles
/// (`bundled_string_modes`). Each place has its own bundles, as short waves are damped out between
/// two places. The bundles of successive places differ by a thousandth in frequency, since poles of
/// equal frequency could not be separated.
/// @param string   a taut string
/// @param places   distances (m) from the left support, inside the span
/// @param count    number of sines, 1 … 10⁴
/// @param highest  highest angular frequency ω (rad/s) of the bundles
/// @throws InvalidParameter under the conditions of `bundled_string_modes`
inline std::vector<ModeAtPlaces> string_modes_at(const TautString<double>& string,
                                                 const std::vector<double>& places, int count,
                                                 double highest) {
  std::vector<ModeAtPlaces> modes;
  for (std::size_t j = 0; j < places.size(); ++j) {
    const auto seen = bundled_string_modes(string, places[j], count, highest);
    for (std::size_t n = 0; n < seen.size(); ++n) {
      const bool is_sine = n < static_cast<std::size_t>(count);
      // Bundles that began at one pole would be told apart by chance alone.
      const double apart = is_sine ? 1.0 : 1.0 + 1e-3 * static_cast<double>(j);
      if (!is_sine || j == 0)
        modes.push_back({seen[n].angular_frequency * apart, seen[n].damping_ratio, seen[n].mass,
                         std::vector<double>(places.size(), 0.0)});
      (is_sine ? modes[n] : modes.back()).shapes[j] = seen[n].shape;
    }
  }
  return modes;
}

}  // namespace holdfast
