#pragma once

#include <cstddef>
#include <vector>

#include "holdfast/cable/taut_string.hpp"

namespace holdfast {

/// A mode of a conductor, with the values of its mode shape at several places.
struct ModeAtPlaces {
  double angular_frequency;    ///< angular frequency ω_n (rad/s), > 0
  double damping_ratio;        ///< damping ratio ζ_n ≥ 0, not critical (≠ 1)
  double mass;                 ///< modal mass M_n (kg), > 0
  std::vector<double> shapes;  ///< value of the mode shape φ_n at each place
};

/// The modes of a taut string at several places: the modes 1 … count, then for each place bundles
/// of higher modes (`bundled_string_modes`). A bundle has the shape 0 at other places, since short
/// waves are damped out on the way there. The frequencies of the bundles of place j = 0, 1, …
/// have the additional factor 1 + j/1000, so that no two poles are equal.
/// @param string   a taut string
/// @param places   distances (m) from the left support, inside the span
/// @param count    number of modes that are not bundled, 1 … 10⁴
/// @param highest  highest angular frequency ω (rad/s) of the bundles
/// @throws InvalidParameter where `bundled_string_modes` rejects the string or an argument
inline std::vector<ModeAtPlaces> string_modes_at(const TautString<double>& string,
                                                 const std::vector<double>& places, int count,
                                                 double highest) {
  std::vector<ModeAtPlaces> modes;
  for (std::size_t j = 0; j < places.size(); ++j) {
    const auto seen = bundled_string_modes(string, places[j], count, highest);
    for (std::size_t n = 0; n < seen.size(); ++n) {
      const bool is_sine = n < static_cast<std::size_t>(count);
      // Poles of bundles that start from one pole could be separated by chance only.
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
