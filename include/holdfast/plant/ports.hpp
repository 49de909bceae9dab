#pragma once

#include <type_traits>

#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"

namespace holdfast {

namespace detail {

template <class Type>
struct Identity {
  using type = Type;
};

/// A parameter type that deduces no template argument, so that a braced list may be passed.
template <class Type>
using Undeduced = typename Identity<Type>::type;

template <class Plant>
using StateMatrixOf = std::decay_t<decltype(std::declval<const Plant&>().state_matrix())>;

template <class Plant, class = void>
struct HasPorts : std::false_type {};
template <class Plant>
struct HasPorts<Plant, std::void_t<decltype(std::declval<const Plant&>().ports())>>
    : std::true_type {};

/// Whether a plant has its own controller (control/controlled_plant.hpp).
template <class Plant, class = void>
struct HasController : std::false_type {};
template <class Plant>
struct HasController<Plant, std::void_t<decltype(std::declval<const Plant&>().controller)>>
    : std::true_type {};

}  // namespace detail

/// The number type of a plant's matrices, for instance `double`.
template <class Plant>
using ScalarOf = typename detail::StateMatrixOf<Plant>::Scalar;

/// The number N of a plant's states; Eigen::Dynamic where N is known only at run time.
template <class Plant>
inline constexpr int states_of = detail::StateMatrixOf<Plant>::RowsAtCompileTime;

/// Whether a plant's loop can be analysed in closed form, by a `SampledLoop`: true for two masses
/// and other plants of four states without `ports()`. Other loops are analysed by a `LoopMap`.
template <class Plant>
inline constexpr bool has_closed_forms = states_of<Plant> == 4 && !detail::HasPorts<Plant>::value;

/// The type of a plant's state x: a column of `states_of<Plant>` numbers.
template <class Plant>
using StateOf = Vector<ScalarOf<Plant>, states_of<Plant>>;

/// The inputs and outputs of a plant of N states that connect it to the computer and the drive.
/// An output is a row, 1 × N: row times state x gives the quantity that the member names.
template <class Scalar, int States>
struct Ports {
  RowVector<Scalar, States> displacement;           ///< z (m) of the conductor at the absorber
  RowVector<Scalar, States> velocity;               ///< ż (m/s) of the conductor at the absorber
  RowVector<Scalar, States> measured_displacement;  ///< row h_z: reading (m), input of gain P
  RowVector<Scalar, States> measured_velocity;      ///< row h_v: reading (m/s), input of gain D
  RowVector<Scalar, States> relative_displacement;  ///< Δz (m), absorber against conductor
  RowVector<Scalar, States> relative_velocity;      ///< Δż (m/s), absorber against conductor
  Vector<Scalar, States> displacement_lift;  ///< column e_z: x + e_z has Δz 1 m larger, same Δż
  Vector<Scalar, States> velocity_lift;  ///< column e_v: x + e_v has Δż 1 m/s larger, same Δz

  /// The feedback row K = P h_z + D h_v (1 × N) of the command u = K x, gains P (N/m), D (N s/m).
  RowVector<Scalar, States> feedback_row(const Scalar& proportional,
                                         const Scalar& differential) const {
    return proportional * measured_displacement + differential * measured_velocity;
  }

  /// Whether every row and column has `order` entries, one for each state of the plant.
  bool are_of(Eigen::Index order) const {
    const auto fits = [order](const auto&... of) { return ((of.size() == order) && ...); };
    return fits(displacement, velocity, measured_displacement, measured_velocity,
                relative_displacement, relative_velocity, displacement_lift, velocity_lift);
  }
};

/// The ports of the two masses for a state [z₁, ż₁, z₂, ż₂, …], used by plants without `ports()`.
template <class Scalar, int States = 4>
Ports<Scalar, States> two_mass_ports(Eigen::Index states = States) {
  const auto unit = [&](Eigen::Index k) {
    return RowVector<Scalar, States>(RowVector<Scalar, States>::Unit(states, k));
  };
  return {unit(0),
          unit(1),
          unit(0),
          unit(1),
          unit(2) - unit(0),
          unit(3) - unit(1),
          unit(2).transpose(),
          unit(3).transpose()};
}

/// The ports of a plant: its own `ports()`, else those of the two masses if it has four states.
/// @throws InvalidParameter where the length of a row or column is not the plant's number of states
template <class Plant>
Ports<ScalarOf<Plant>, states_of<Plant>> ports_of(const Plant& plant) {
  if constexpr (detail::HasPorts<Plant>::value) {
    const auto order = plant.excitation_input().size();
    if (!plant.ports().are_of(order))
      throw InvalidParameter("number of states of a plant", static_cast<double>(order), "",
                             "the length of each row and column of its ports");
    return plant.ports();
  } else if constexpr (states_of<Plant> == 4) {
    return two_mass_ports<ScalarOf<Plant>>();
  } else {
    static_assert(detail::HasPorts<Plant>::value,
                  "a plant of an order other than 4 declares its measured quantities by `ports()`");
    return {};
  }
}

namespace detail {

/// The state of a plant, converted from any Eigen column.
/// @throws InvalidParameter where the column has another size than the state
template <class Plant, class Derived>
StateOf<Plant> state_of(const Plant& plant, const Eigen::MatrixBase<Derived>& column) {
  constexpr int states = states_of<Plant>, size = Derived::RowsAtCompileTime;
  constexpr bool fits = Derived::ColsAtCompileTime == 1 &&
                        std::is_same_v<typename Derived::Scalar, ScalarOf<Plant>> &&
                        (size == states || size == Eigen::Dynamic || states == Eigen::Dynamic);
  static_assert(fits, "the state of a plant is a column vector, one number per state variable");
  if constexpr (fits) {
    require_size("size of the initial state", column.size(), plant.excitation_input().size());
    return column;
  } else {
    return {};
  }
}

/// Rejects a state that is not finite or has another size than the order of its plant.
template <class Plant>
void require_state(const StateOf<Plant>& state, const Plant& plant) {
  require_size("size of the initial state", state.size(), plant.excitation_input().size());
  require_finite("initial state", static_cast<double>(state.sum()), "");
}

}  // namespace detail

}  // namespace holdfast
