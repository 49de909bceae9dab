#pragma once

#include <functional>
#include <type_traits>

#include "holdfast/control/controller.hpp"
#include "holdfast/control/digital_loop.hpp"
#include "holdfast/control/gains.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/plant/linear_plant.hpp"
#include "holdfast/plant/two_mass.hpp"

namespace holdfast {

/// The Jacobian of a controller of M states at one sample, (M + 1) × (M + 2): derivatives of
/// command and next state [u_j; x_c,j+1] by the readings and the state [z₁; ż₁; x_c,j].
template <int States>
using ControllerDerivative = Matrix<double, larger_size(States, 1), larger_size(States, 2)>;

namespace detail {

template <class Law, class = void>
struct HasStates : std::false_type {};
template <class Law>
struct HasStates<Law, std::void_t<decltype(Law::states)>> : std::true_type {};

template <class Law, class = void>
struct HasCommand : std::false_type {};
template <class Law>
struct HasCommand<
    Law, std::void_t<decltype(std::declval<const Law&>().command(
             std::declval<const ControlSample&>(), std::declval<Vector<double, Law::states>&>()))>>
    : std::is_same<double, decltype(std::declval<const Law&>().command(
                               std::declval<const ControlSample&>(),
                               std::declval<Vector<double, Law::states>&>()))> {};

/// Whether a type is a controller; if not, a static assertion names the missing member.
template <class Law>
constexpr bool is_controller() {
  static_assert(HasStates<Law>::value,
                "a controller declares its number of states: `static constexpr int states`");
  static_assert(!HasStates<Law>::value || HasCommand<Law>::value,
                "a controller has `double command(const ControlSample&, Vector<double, states>&) "
                "const` and keeps its whole state in the second argument");
  return HasCommand<Law>::value;
}

template <class Law, class = void>
struct HasDerivative : std::false_type {};
template <class Law>
struct HasDerivative<Law, std::void_t<decltype(std::declval<const Law&>().derivative(
                              std::declval<const ControlSample&>(),
                              std::declval<const Vector<double, Law::states>&>()))>>
    : std::true_type {};

/// The number M of states of a controller.
template <class Law>
Eigen::Index memory_size([[maybe_unused]] const Law& law) {
  if constexpr (Law::states == Eigen::Dynamic) {
    return law.order();
  } else {
    return Law::states;
  }
}

}  // namespace detail

/// A user-defined controller of any type, in place of u = P z₁ + D ż₁. All loops with an
/// OwnController have one type. A controller is a type with the members below: it computes a force
/// from each sample. Its M states x_c are part of the state of the simulated motion.
///
///     struct MyController {
///       static constexpr int states = 1;  // M ≥ 0
///       /// The command u_j (N) of sample j; replaces the state x_c,j by x_c,j+1.
///       double command(const ControlSample& sample, Vector<double, 1>& x_c) const;
///       /// Optional Jacobian, one-sided at a jump of the law. Default: central differences.
///       ControllerDerivative<1> derivative(const ControlSample& sample,
///                                          const Vector<double, 1>& x_c) const;
///     };
///
/// Where M is known at run time only, `states` is Eigen::Dynamic and `order()` returns M. PdGains
/// is a controller with M = 0, LinearController one with any M, LateController one with dynamic M.
class OwnController {
 public:
  using Column = Vector<double, Eigen::Dynamic>;      ///< column [z₁; ż₁; x_c] or [u; x_c]
  using Derivative = Matrix<double, Eigen::Dynamic>;  ///< ControllerDerivative of any size

  /// Constructs an empty object, which no loop accepts.
  OwnController() = default;

  /// Constructs the object from any controller, which is copied.
  template <class Law>
  explicit OwnController(const Law& law) {
    if constexpr (detail::is_controller<Law>()) take(law);
  }

  /// Whether the object contains a controller.
  bool exists() const { return value_ != nullptr; }
  /// The number M of states of the controller.
  Eigen::Index states() const { return at_.size() - 2; }

  /// Computes the command u_j (N) of sample j and the next state. @return [u_j; x_c,j+1]
  /// @param sample  measured values
  /// @param state   state x_c,j
  /// @throws InvalidParameter for a NaN or infinite result, if all inputs so far are below 10¹⁰⁰
  template <class State>
  Column command(const ControlSample& sample, const State& state) {
    elapsed_ = sample.elapsed;
    at_ << sample.displacement, sample.velocity, state;
    largest_ = largest_.cwiseMax(at_.cwiseAbs());
    Column result = value_(at_, elapsed_);
    if (!result.allFinite() && largest_.maxCoeff() < 1e100)
      throw InvalidParameter("force or state of the controller", result.sum(), "", "finite");
    return result;
  }

  /// Jacobian of [u_j; x_c,j+1] by [z₁; ż₁; x_c,j] at the last sample, (M + 1) × (M + 2), with M =
  /// states(). A law without derivative() is differentiated by central differences. Their width is
  /// 2⁻¹⁶ of each variable's largest magnitude so far; ten digits are correct for a smooth law.
  template <class Result = Derivative>
  Result derivative() const {
    if (derivative_) return derivative_(at_, elapsed_);
    Result result(at_.size() - 1, at_.size());
    for (Eigen::Index i = 0; i < at_.size(); ++i) {
      Column above = at_, below = at_;
      const double step = 0x1p-17 * (largest_[i] > 0.0 ? largest_[i] : 1.0);
      above[i] += step;
      below[i] -= step;
      result.col(i) = (value_(above, elapsed_) - value_(below, elapsed_)) / (above[i] - below[i]);
    }
    return result;
  }

 private:
  template <class Law>
  void take(const Law& law) {
    value_ = [law](const Column& at, double elapsed) {
      Vector<double, Law::states> state = at.template bottomRows<Law::states>(at.size() - 2);
      Column result(at.size() - 1);
      result[0] = law.command({at[0], at[1], elapsed}, state);
      result.template bottomRows<Law::states>(at.size() - 2) = state;
      return result;
    };
    at_ = largest_ = Column::Zero(detail::memory_size(law) + 2);
    if constexpr (detail::HasDerivative<Law>::value) {
      derivative_ = [law](const Column& at, double elapsed) -> Derivative {
        const Vector<double, Law::states> state =
            at.template bottomRows<Law::states>(at.size() - 2);
        return law.derivative({at[0], at[1], elapsed}, state);
      };
    }
  }

  std::function<Column(const Column&, double)> value_;
  std::function<Derivative(const Column&, double)> derivative_;
  double elapsed_ = 0.0;                         // h_j of the last sample
  Column at_ = Column::Zero(2), largest_ = at_;  // its inputs, and the largest so far
};

/// A plant with a user-defined controller.
///
///     ImplementedLoopOf<ControlledPlant> loop;
///     loop.plant = with_controller(kollar2022_plant(), MyController{});
///
/// The states of the controller follow those of the plant, [x; x_c], N + M in all. x_c is constant
/// between samples; a recorded sample j contains x_c,j, not yet x_c,j+1. event_motion(),
/// find_event_orbit(), run_event_lyapunov() and classify_motion() accept such a loop. Its
/// DigitalLoop must have gains of 0 and ideal limits; `command` may apply `quantised` and
/// std::clamp itself. Stability charts and margins reject such a loop.
struct ControlledPlant : LinearPlant<double> {
  OwnController controller;  ///< controller that computes the force
};

/// Validates a plant. @throws InvalidParameter for a plant not admissible or without a controller
template <class Plant>
std::enable_if_t<std::is_same_v<Plant, ControlledPlant>> validate(const Plant& plant) {
  if (!plant.controller.exists())
    throw InvalidParameter("number of controllers", 0.0, "", "1: use with_controller()");
  validate<Eigen::Dynamic>(plant);
}

/// Combines a plant with a controller. The plant consists of the two masses, or is a linear plant
/// that already includes its filters and lags.
/// @throws InvalidParameter for inadmissible masses, or plant matrices of different orders
template <class Plant, class Law>
ControlledPlant with_controller(const Plant& plant, const Law& law) {
  if constexpr (detail::is_controller<Law>()) {
    return {detail::enlarged<Eigen::Dynamic>(linear_plant(plant), detail::memory_size(law)),
            OwnController(law)};
  } else {
    return {};
  }
}

/// A linear controller of M states x_c, such as an observer or a filter:
///
///     x_c,j+1 = A_c x_c,j + B_c y_j,   u_j = C_c x_c,j + D_c y_j,   y_j = [z₁; ż₁]
template <int States>
struct LinearController {
  static constexpr int states = States;    ///< number M of states
  Matrix<double, States> transition;       ///< transition matrix A_c of the state, M × M
  Matrix<double, States, 2> input;         ///< input matrix B_c of the readings, M × 2
  RowVector<double, States> output;        ///< output row C_c, 1 × M (N)
  RowVector<double, 2> feedthrough{0, 0};  ///< feedthrough row D_c, 1 × 2 (N/m, N s/m)

  /// Command u_j (N) of a sample; replaces the state by the next state.
  double command(const ControlSample& sample, Vector<double, States>& state) const {
    const Vector<double, 2> read(sample.displacement, sample.velocity);
    const double force = output.dot(state) + feedthrough.dot(read);
    state = (transition * state + input * read).eval();
    return force;
  }
  /// Jacobian [D_c, C_c; B_c, A_c] of the command and the next state.
  ControllerDerivative<States> derivative(const ControlSample&,
                                          const Vector<double, States>&) const {
    ControllerDerivative<States> result;
    result << feedthrough, output, input, transition;
    return result;
  }
};

namespace detail {

template <class Plant>
using ControllerOf = std::conditional_t<HasController<Plant>::value, OwnController, Controller>;

/// The controller of a loop: P and D with their limits, or the plant's own controller.
template <class Contact>
ControllerOf<typename Contact::Plant> controller_of(const DigitalLoop& loop,
                                                    [[maybe_unused]] const Contact& contact) {
  if constexpr (HasController<typename Contact::Plant>::value) {
    return contact.plant().controller;
  } else {
    return {loop.gains, loop.limits};
  }
}

}  // namespace detail
}  // namespace holdfast
