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

  /// The extent of states that begin with [z₁, ż₁, z₂, ż₂].
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

/// How far a motion of a plant of order N reaches: max |x_i| of each coordinate, since their units
/// may be any; of the two masses that of their displacements and of their velocities.
template <class Plant>
class StateScaleOf {
 public:
  using State = StateOf<Plant>;  ///< x, N × 1

  /// The extent of some states, perhaps none yet.
  explicit StateScaleOf(const PortReadings<Plant>& readings, const std::vector<State>& states = {})
      : readings_(readings) {
    for (const State& state : states) include(state);
  }

  /// One more state.
  void include(const State& state) {
    sides_.include(readings_.both_sides(state));
    if constexpr (of_two_masses) {
      largest_ << sides_.displacement, sides_.velocity, sides_.displacement, sides_.velocity;
    } else {
      if (largest_.size() == 0) largest_ = State::Zero(state.size());
      largest_ = largest_.cwiseMax(state.cwiseAbs());
    }
  }

  /// Extent of both sides of the gap: |z|, |z + Δz| (m) and |ż|, |ż + Δż| (m/s).
  const StateScale& sides() const { return sides_; }

  /// A state, most often the difference of two: max_i |x_i| / largest()_i; infinite where a
  /// coordinate has always been 0 and is not. Ask once a state is included.
  double share_of(const State& state) const {
    double share = 0.0;
    for (Eigen::Index i = 0; i < state.size(); ++i)
      if (state[i] != 0.0) share = std::max(share, std::abs(state[i]) / largest_[i]);
    return share;
  }

  /// Largest |x_i| of each coordinate, N × 1.
  const State& largest() const { return largest_; }

  /// Takes each coordinate of another plant than the two masses for no less than a share of its
  /// size in another motion, so that what has decayed to rounding is measured by what it was.
  void widen(double share, const StateScaleOf& other) {
    if constexpr (!of_two_masses) largest_ = largest_.cwiseMax(share * other.largest_);
  }

 private:
  static constexpr bool of_two_masses = std::is_same_v<Plant, TwoMass<double>>;

  PortReadings<Plant> readings_;
  StateScale sides_;
  State largest_ = State::Zero(states_of<Plant> < 0 ? 0 : states_of<Plant>);
};

namespace detail {

/// The largest power of two that is not larger than a size; 1 where that is not finite and > 0.
template <class Scalar>
Scalar power_of_two_below(const Scalar& size) {
  using std::ilogb;
  using std::isfinite;
  using std::ldexp;
  return size > Scalar(0) && isfinite(size) ? ldexp(Scalar(1), ilogb(size)) : Scalar(1);
}

}  // namespace detail

/// Units of z̃ = [z; u_{j−1}] that belong to a plant: 1 m, ω · 1 m and k · 1 m, where a
/// displacement z₁ of 1 m is pulled back with the acceleration ω² and the force k. What is solved
/// for in them is the same in any units of mass and time; being powers of two, they round nothing.
/// @param state_matrix      A, 4 × 4
/// @param excitation_input  c, 4 × 1
/// @return of [z₁, ż₁, z₂, ż₂, u]; 1 where the plant does not tell
template <class Scalar>
Vector<Scalar, 5> plant_scaling(const Matrix<Scalar, 4>& state_matrix,
                                const Vector<Scalar, 4>& excitation_input) {
  using std::abs;
  using std::sqrt;
  const Scalar acceleration = abs(state_matrix(1, 0));
  const Scalar velocity = detail::power_of_two_below(Scalar(sqrt(acceleration)));
  return {Scalar(1), velocity, Scalar(1), velocity,
          detail::power_of_two_below(Scalar(acceleration / abs(excitation_input[1])))};
}

}  // namespace holdfast
