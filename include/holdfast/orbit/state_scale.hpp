#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "holdfast/core/types.hpp"

namespace holdfast {

/// How far a motion reaches: displacements and velocities apart, so that no unit of time decides
/// which of them counts.
struct StateExtent {
  double displacement = 0.0;  ///< largest |z₁|, |z₂| (m)
  double velocity = 0.0;      ///< largest |ż₁|, |ż₂| (m/s)

  /// Nothing yet.
  StateExtent() = default;

  /// That of states that begin with [z₁, ż₁, z₂, ż₂].
  template <class Scalar, int Size>
  explicit StateExtent(const std::vector<Vector<Scalar, Size>>& states) {
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
    StateExtent size;
    size.include(state);
    return std::max(share_of_displacement(size.displacement), share_of_velocity(size.velocity));
  }

 private:
  static double share(double part, double whole) { return part == 0.0 ? 0.0 : part / whole; }
};

}  // namespace holdfast
