#pragma once

#include <cstddef>
#include <vector>

#include "holdfast/cable/taut_string.hpp"

namespace holdfast {

/// A mode of a conductor as several places see it.
struct ModeAtPlaces {
  double angular_frequency;    ///< ω_n (rad/s), > 0
  double damping_ratio;        ///< ζ_n, ≥ 0, ≠ 1
  double mass;                 ///< M_n (kg), > 0
  std::vector<double> shapes;  ///< φ_n at each place
};

/// The modes of a taut string as several places see them: the sines 1 … count, and what is above
/// them in bundles (`bundled_string_modes`) that each place has for itself, since waves so short
/// are damped out between two places. Those of one place lie a thousandth above those of the one
/// before: bundles at one frequency could not be told apart.
/// @param string   any
/// @param places   m from the left support, inside the span
/// @param count    sines, 1 … 10⁴
/// @param highest  ω (rad/s) up to which bundles are formed
/// @throws InvalidParameter as `bundled_string_modes`
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
