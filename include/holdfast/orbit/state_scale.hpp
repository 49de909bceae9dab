#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <vector>

#include "holdfast/core/types.hpp"
#include "holdfast/plant/port_readings.hpp"
#include "holdfast/plant/ports.hpp"
#include "holdfast/plant/two_mass.hpp"

namespace holdfast {

/// How far a motion reaches: displacements and velocities apart, so that no unit of time decides
/// which of them counts.
struct StateScale {
  double displacement = 0.0;  ///< largest |z₁|, |z₂| (m)
  double velocity = 0.0;      ///< largest |ż₁|, |ż₂| (m/s)

  /// Nothing yet.
  StateScale() = default;

  /// That of states that begin with [z₁, ż₁, z₂, ż₂].
  template <class Scalar, int Size>
  explicit StateScale(const std::vector<Vector<Scalar, Size>>& states) {
    for (const auto& state : states) include(state);
  }

  /// One more state, which begins with [z₁, ż₁, z₂, ż₂].
  template <class Scalar, int Size>
  void include(const Vector<Scalar, Size>& state) {
    using std::abs;
    displacement = std::max({displacement, double(abs(state[0])), double(abs(state[2]))});
    velocity = std::max({velocity, double(abs(state[1])), double(abs(state[3]))});
  }

  /// A length (m) as a share of the displacements; infinite where there are none, unless it is 0.
  double share_of_displacement(double length) const { return share(length, displacement); }
  /// A velocity (m/s) as a share of the velocities, in the same way.
  double share_of_velocity(double speed) const { return share(speed, velocity); }

  /// A state, most often the difference of two: the larger share of its displacements and its
  /// velocities.
  template <class Scalar, int Size>
  double share_of(const Vector<Scalar, Size>& state) const {
    StateScale size;
    size.include(state);
    return std::max(share_of_displacement(size.displacement), share_of_velocity(size.velocity));
  }

 private:
  static double share(double part, double whole) { return part == 0.0 ? 0.0 : part / whole; }
};

/// How far a motion of a plant of order N reaches.
///
/// States of the two masses are measured as StateScale says. Those of another plant are measured
/// coordinate by coordinate, each in the largest value that it has taken, since their units may be
/// any: x apart is max_i |x_i| / max |x_i seen|. Its displacements and velocities are those of both
/// sides of the gap.
template <class Plant>
class StateScaleOf {
 public:
  using State = StateOf<Plant>;  ///< x, N × 1

  /// Nothing yet.
  explicit StateScaleOf(const PortReadings<Plant>& readings) : readings_(readings) {}

  /// That of some states.
  StateScaleOf(const PortReadings<Plant>& readings, const std::vector<State>& states)
      : readings_(readings) {
    for (const State& state : states) include(state);
  }

  /// One more state.
  void include(const State& state) {
    sides_.include(readings_.both_sides(state));
    if constexpr (!of_two_masses) {
      if (largest_.size() == 0) largest_ = State::Zero(state.size());
      largest_ = largest_.cwiseMax(state.cwiseAbs());
    }
  }

  /// Of both sides of the gap: |z|, |z + Δz| (m) and |ż|, |ż + Δż| (m/s).
  const StateScale& sides() const { return sides_; }

  /// A state, most often the difference of two: the largest of its shares; infinite where a
  /// coordinate has always been 0 and is not.
  double share_of(const State& state) const {
    if constexpr (of_two_masses) {
      return sides_.share_of(state);
    } else {
      double largest = 0.0;
      for (Eigen::Index i = 0; i < state.size(); ++i)
        if (state[i] != 0.0) largest = std::max(largest, std::abs(state[i]) / largest_seen(i));
      return largest;
    }
  }

  /// The largest |x_i| of another plant than the two masses.
  const State& largest() const { return largest_; }

  /// Takes each coordinate of another plant than the two masses for no less than a share of its
  /// size in another motion, so that what has decayed to rounding is measured by what it was.
  void widen(double share, const StateScaleOf& other) {
    if constexpr (!of_two_masses) largest_ = largest_.cwiseMax(share * other.largest_);
  }

 private:
  static constexpr bool of_two_masses = std::is_same_v<Plant, TwoMass<double>>;

  double largest_seen(Eigen::Index i) const { return largest_.size() == 0 ? 0.0 : largest_[i]; }

  PortReadings<Plant> readings_;
  StateScale sides_;
  State largest_ = State::Zero(states_of<Plant> < 0 ? 0 : states_of<Plant>);
};

}  // namespace holdfast
