#pragma once

#include <cstddef>
#include <vector>

#include "holdfast/cable/taut_string.hpp"

namespace holdfast {

/// A mode of a conductor, with the values of its mode shape at several points, called places.
struct ModeAtPlaces {
  double angular_frequency;    ///< angular frequency ω_n (rad/s), > 0
  double damping_ratio;        ///< damping ratio ζ_n ≥ 0, not critical (≠ 1)
  double mass;                 ///< modal mass M_n (kg), > 0
  std::vector<double> shapes;  ///< value of the mode shape φ_n at each place; M_n scales with φ_n²
};

/// The modes 1 … count of a taut string at several places, then for each place its own bundles of
/// higher modes (`bundled_string_modes`). A bundle has the shape 0 at all other places, since short
/// waves decay before they arrive at another place. The frequencies of the bundles of place j = 0,
/// 1, … are multiplied by 1 + j/1000. This keeps the bundles of two places distinct.
/// @param string   taut string
/// @param places   distances (m) of the places from the left support, inside the span
/// @param count    number of modes that are not bundled, 1 … 10⁴
/// @param highest  angular frequency (rad/s) up to which higher modes are bundled
/// @throws InvalidParameter for an inadmissible string, place or count, or an infinite `highest`
inline std::vector<ModeAtPlaces> string_modes_at(const TautString<double>& string,
                                                 const std::vector<double>& places, int count,
                                                 double highest) {
  std::vector<ModeAtPlaces> modes;
  for (std::size_t j = 0; j < places.size(); ++j) {
    const auto seen = bundled_string_modes(string, places[j], count, highest);
    for (std::size_t n = 0; n < seen.size(); ++n) {
      const bool is_sine = n < static_cast<std::size_t>(count);
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
