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

/// A motion's extent: its largest displacement and velocity. Differences of states are divided by
/// the extent to obtain relative sizes.
struct StateScale {
  double displacement = 0.0;  ///< largest |z₁|, |z₂| (m)
  double velocity = 0.0;      ///< largest |ż₁|, |ż₂| (m/s)

  /// Constructs an empty extent, with both values zero.
  StateScale() = default;

  /// Constructs the extent of states whose first four entries are [z₁, ż₁, z₂, ż₂].
  template <class Scalar, int Size>
  explicit StateScale(const std::vector<Vector<Scalar, Size>>& states) {
    for (const auto& state : states) include(state);
  }

  /// Extends the extent by one more state, whose first four entries are [z₁, ż₁, z₂, ż₂].
  template <class Scalar, int Size>
  void include(const Vector<Scalar, Size>& state) {
    using std::abs;
    displacement = std::max({displacement, double(abs(state[0])), double(abs(state[2]))});
    velocity = std::max({velocity, double(abs(state[1])), double(abs(state[3]))});
  }

  /// The ratio of a length (m) to the largest displacement; 0/0 counts as 0, length/0 as infinite.
  double share_of_displacement(double length) const { return share(length, displacement); }
  /// The ratio of a speed (m/s) to the largest velocity; 0/0 counts as 0, speed/0 as infinite.
  double share_of_velocity(double speed) const { return share(speed, velocity); }

  /// The size of a state, or of a difference of two states, relative to the extent: the larger of
  /// its displacement ratio and its velocity ratio.
  template <class Scalar, int Size>
  double share_of(const Vector<Scalar, Size>& state) const {
    StateScale size;
    size.include(state);
    return std::max(share_of_displacement(size.displacement), share_of_velocity(size.velocity));
  }

 private:
  static double share(double part, double whole) { return part == 0.0 ? 0.0 : part / whole; }
};

/// The extent of a motion of a plant of order N: the largest |x_i| of each state variable i. For
/// two masses both displacements have one common maximum, and both velocities another.
template <class Plant>
class StateScaleOf {
 public:
  using State = StateOf<Plant>;  ///< plant state x, N × 1

  /// Constructs the extent of a list of states, possibly empty; `readings` are those of the plant.
  explicit StateScaleOf(const PortReadings<Plant>& readings, const std::vector<State>& states = {})
      : readings_(readings) {
    for (const State& state : states) include(state);
  }

  /// Extends the extent by one more state.
  void include(const State& state) {
    sides_.include(readings_.both_sides(state));
    if constexpr (of_two_masses) {
      largest_ << sides_.displacement, sides_.velocity, sides_.displacement, sides_.velocity;
    } else {
      if (largest_.size() == 0) largest_ = State::Zero(state.size());
      largest_ = largest_.cwiseMax(state.cwiseAbs());
    }
  }

  /// The extent of the drive's two sides: largest |z|, |z + Δz| (m) and |ż|, |ż + Δż| (m/s), with
  /// the conductor's displacement z and the relative displacement Δz.
  const StateScale& sides() const { return sides_; }

  /// The relative size max_i |x_i| / largest()_i of a state x or of a difference x of two states;
  /// infinite where largest()_i is 0 and x_i is not. At least one state must have been included.
  double share_of(const State& state) const {
    double share = 0.0;
    for (Eigen::Index i = 0; i < state.size(); ++i)
      if (state[i] != 0.0) share = std::max(share, std::abs(state[i]) / largest_[i]);
    return share;
  }

  /// The largest |x_i| of each state variable i, N × 1.
  const State& largest() const { return largest_; }

  /// Raises each largest |x_i| to at least `share` times that of `other`. Rounding errors of a
  /// state variable that has decayed then count as small. For two masses nothing changes.
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

/// The largest power of two that is not larger than a size; 1 where the size is not finite and > 0.
template <class Scalar>
Scalar power_of_two_below(const Scalar& size) {
  using std::ilogb;
  using std::isfinite;
  using std::ldexp;
  return size > Scalar(0) && isfinite(size) ? ldexp(Scalar(1), ilogb(size)) : Scalar(1);
}

}  // namespace detail

/// Units for scaling the state z̃ = [z₁, ż₁, z₂, ż₂; u_{j−1}]: 1 m for displacements, ω · 1 m for
/// velocities, k · 1 m for the force. A displacement z₁ causes the restoring acceleration ω² z₁ and
/// force k z₁. Units are rounded down to powers of two, hence scaling causes no rounding errors.
/// @param state_matrix      A of ż = A z + b u + c F, 4 × 4
/// @param excitation_input  c, 4 × 1
/// @return units of [z₁, ż₁, z₂, ż₂, u]; 1 where ω or k is zero or not finite
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
