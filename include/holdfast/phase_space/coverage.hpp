#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "holdfast/core/errors.hpp"
#include "holdfast/plant/port_readings.hpp"
#include "holdfast/plant/two_mass.hpp"

namespace holdfast {

/// A rectangle of the phase plane (z, ż) of the conductor at the absorber; for two masses (z₁, ż₁).
struct PhaseWindow {
  double displacement_min,  ///< lower end of z (m), included
      displacement_max;     ///< upper end of z (m), excluded, > displacement_min
  double velocity_min,      ///< lower end of ż (m/s), included
      velocity_max;         ///< upper end of ż (m/s), excluded, > velocity_min
};

/// Validates a window. @throws InvalidParameter unless both sides are positive and finite
inline void validate(const PhaseWindow& window) {
  require_positive("width of the phase window", window.displacement_max - window.displacement_min,
                   "m");
  require_positive("height of the phase window", window.velocity_max - window.velocity_min, "m/s");
}

/// The set of cells of a phase-plane window that the samples of a motion have visited.
///
/// A topologically transitive motion would fill the window as time grows; a periodic one visits
/// only the cells of its orbit. Source: Kollár 2022, Fig. 12.
/// @tparam Plant  TwoMass<double> or a LinearPlant<double, N>
template <class Plant>
class CoverageOf {
 public:
  /// @param window          window with sides > 0
  /// @param cells_per_side  number of cells along each side of the window, 1 … 10 000
  /// @param readings        functions that read z and ż from the plant's state
  /// @throws InvalidParameter where the window is empty or the number of cells is out of range
  CoverageOf(const PhaseWindow& window, std::size_t cells_per_side,
             const PortReadings<Plant>& readings = PortReadings<Plant>())
      : window_(window), side_(cells_per_side), readings_(readings) {
    validate(window);
    require_within("cells per side", static_cast<double>(cells_per_side), "", 1.0, 1e4);
    visited_cells_.assign(cells_per_side * cells_per_side, false);
  }

  /// Marks the cell that contains a sample's (z, ż); a sample outside the window has no effect.
  /// @tparam Sample  MotionSample<double, N> or EventSampleOf<N>
  template <class Sample>
  void operator()(const Sample& sample) {
    const double x = fraction(readings_.displacement(sample.state), window_.displacement_min,
                              window_.displacement_max);
    const double y =
        fraction(readings_.velocity(sample.state), window_.velocity_min, window_.velocity_max);
    if (!(x >= 0.0 && x < 1.0 && y >= 0.0 && y < 1.0)) return;
    const double side = static_cast<double>(side_);
    visited_cells_[static_cast<std::size_t>(x * side) * side_ +
                   static_cast<std::size_t>(y * side)] = true;
  }

  /// The number of cells of the window, visited or not.
  std::size_t cells() const { return visited_cells_.size(); }
  /// The number of cells that contain at least one sample.
  std::size_t visited() const {
    return static_cast<std::size_t>(std::count(visited_cells_.begin(), visited_cells_.end(), true));
  }
  /// The share visited() / cells(), 0 … 1.
  double visited_fraction() const {
    return static_cast<double>(visited()) / static_cast<double>(cells());
  }

 private:
  static double fraction(double value, double from, double to) {
    return (value - from) / (to - from);
  }

  PhaseWindow window_;
  std::size_t side_;
  PortReadings<Plant> readings_;
  std::vector<bool> visited_cells_;
};

/// The coverage of the phase plane by motions of the two masses.
using Coverage = CoverageOf<TwoMass<double>>;

}  // namespace holdfast
