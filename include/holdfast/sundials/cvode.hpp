#pragma once

#include <cvode/cvode.h>
#include <sunlinsol/sunlinsol_band.h>
#include <sunmatrix/sunmatrix_band.h>

#include <Eigen/Core>
#include <type_traits>
#include <utility>

#include "holdfast/core/errors.hpp"
#include "holdfast/sundials/cvode_session.hpp"

namespace holdfast::cvode {

namespace detail {

/// Whether a system provides a banded Jacobian by half_bandwidth() and jacobian(state, set).
template <class System, class = void>
struct HasBandedJacobian : std::false_type {};
template <class System>
struct HasBandedJacobian<System,
                         std::void_t<decltype(std::declval<const System&>().half_bandwidth())>>
    : std::true_type {};

/// Whether a system has margin(state), which is positive where its model is valid.
template <class System, class = void>
struct HasMargin : std::false_type {};
template <class System>
struct HasMargin<System, std::void_t<decltype(std::declval<const System&>().margin(
                             std::declval<const double*>()))>> : std::true_type {};

/// Whether the rate of a system depends on time: rate(t, y, rate).
template <class System, class = void>
struct TakesTime : std::false_type {};
template <class System>
struct TakesTime<System, std::void_t<decltype(std::declval<const System&>().rate(
                             0.0, std::declval<const double*>(), std::declval<double*>()))>>
    : std::true_type {};

}  // namespace detail

/// The integrator of a system ẏ = rate(y) or ẏ = rate(t, y) from a given state, by CVODE. It cannot
/// be copied or moved, since CVODE holds its address.
///
/// The method is Adams' with fixed-point iteration. For a System with a banded Jacobian it is BDF
/// with Newton's method, suitable for stiff systems.
/// @tparam System  has `int states()` and `void rate(const double* y, double* rate)`, or
/// `rate(t, y, rate)` with t in s. Optional: `int half_bandwidth()` with `jacobian(y, set)`, which
/// calls set(row, column, value) for each entry of the Jacobian; and `double margin(const double*
/// y)`: the integration ends with `model_ended` where the margin is zero or negative.
template <class System>
class Integrator : public detail::Session {
 public:
  /// @param system         system to integrate; it must outlive this object
  /// @param initial_state  y at t = 0, a vector of system.states() numbers in SI units
  /// @param tolerances     tolerances of the local error per step, and the limit of steps
  /// @throws InvalidParameter for another size of the state, or a tolerance that is not positive
  Integrator(const System& system, const Eigen::VectorXd& initial_state,
             const Tolerances& tolerances)
      : Session(tolerances), system_(system) {
    if (initial_state.size() != system.states())
      throw InvalidParameter("number of initial states", static_cast<double>(initial_state.size()),
                             "", "equal to states() of the system");
    open(banded ? CV_BDF : CV_ADAMS, &Integrator::rate, initial_state, tolerances, this);
    if (outcome_ != IntegrationOutcome::completed) return;
    if constexpr (banded)
      use_banded_newton();
    else
      use_fixed_point();
    if constexpr (bounded) watch_margin();
  }

  /// Integrates to `time` (s) > time(). If outcome() is not `completed`, only returns outcome().
  IntegrationOutcome advance_to(double time) {
    if (outcome_ != IntegrationOutcome::completed) return outcome_;
    check(CVode(memory_.get(), time, state_.get(), &time_, CV_NORMAL));
    return outcome_;
  }

  /// Restarts CVODE at the instant last reached; call it after a jump of the system's rate.
  void restart() {
    if (outcome_ == IntegrationOutcome::completed)
      check(CVodeReInit(memory_.get(), time_, state_.get()));
  }

  /// The state at the instant last reached, an array of states() numbers.
  const double* state() const { return N_VGetArrayPointer(state_.get()); }
  /// The instant last reached (s).
  double time() const { return time_; }

  /// Numbers of steps and evaluations since the start or the last restart.
  IntegrationCost cost() const {
    IntegrationCost cost;
    cost.steps = count(&CVodeGetNumSteps);
    cost.rate_evaluations = count(&CVodeGetNumRhsEvals);
    if constexpr (banded) cost.jacobian_evaluations = count(&CVodeGetNumJacEvals);
    return cost;
  }

 private:
  static constexpr bool banded = detail::HasBandedJacobian<System>::value;
  static constexpr bool bounded = detail::HasMargin<System>::value;

  static int rate(sunrealtype time, N_Vector state, N_Vector rate_of_state, void* self) {
    const auto& system = static_cast<Integrator*>(self)->system_;
    if constexpr (detail::TakesTime<System>::value)
      system.rate(time, N_VGetArrayPointer(state), N_VGetArrayPointer(rate_of_state));
    else
      system.rate(N_VGetArrayPointer(state), N_VGetArrayPointer(rate_of_state));
    // A rate that is not finite asks CVODE for a smaller step.
    const Eigen::Map<const Eigen::VectorXd> rates(N_VGetArrayPointer(rate_of_state),
                                                  system.states());
    return rates.allFinite() ? 0 : 1;
  }

  static int jacobian(sunrealtype, N_Vector state, N_Vector, SUNMatrix matrix, void* self, N_Vector,
                      N_Vector, N_Vector) {
    const auto& system = static_cast<Integrator*>(self)->system_;
    system.jacobian(N_VGetArrayPointer(state), [matrix](int row, int column, double value) {
      SM_ELEMENT_B(matrix, row, column) = value;
    });
    return 0;
  }

  static int margin(sunrealtype, N_Vector state, sunrealtype* value, void* self) {
    *value = static_cast<Integrator*>(self)->system_.margin(N_VGetArrayPointer(state));
    return 0;
  }

  void use_banded_newton() {
    const int reach = system_.half_bandwidth();
    matrix_.reset(SUNBandMatrix(system_.states(), reach, reach, context_.get()));
    if (lacks_memory(matrix_ != nullptr)) return;
    linear_solver_.reset(SUNLinSol_Band(state_.get(), matrix_.get(), context_.get()));
    if (lacks_memory(linear_solver_ != nullptr)) return;
    if (lacks_memory_for_matrix(system_.states(), reach)) return;
    check(CVodeSetLinearSolver(memory_.get(), linear_solver_.get(), matrix_.get()));
    check(CVodeSetJacFn(memory_.get(), &Integrator::jacobian));
  }

  void watch_margin() {
    if (outcome_ != IntegrationOutcome::completed) return;
    if (system_.margin(state()) <= 0.0) {
      outcome_ = IntegrationOutcome::model_ended;
    } else {
      check(CVodeRootInit(memory_.get(), 1, &Integrator::margin));
    }
  }

  const System& system_;
  double time_ = 0.0;
};

}  // namespace holdfast::cvode
