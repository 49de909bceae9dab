#pragma once

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_config.h>
#include <sundials/sundials_types.h>
#include <sunmatrix/sunmatrix_band.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <Eigen/Core>
#include <algorithm>
#include <cstdlib>
#include <initializer_list>
#include <memory>
#include <string>
#include <type_traits>

#include "holdfast/core/errors.hpp"

/// Time integration of the library's continuous models by CVODE, for SUNDIALS 6 and 7. The
/// namespace is not called `sundials`, since SUNDIALS itself has one of that name.
namespace holdfast::cvode {

/// Outcome of an integration, from CVODE's return flag; several flags may give one outcome.
enum class IntegrationOutcome {
  completed,             ///< CV_SUCCESS and CV_TSTOP_RETURN: no failure
  model_ended,           ///< CV_ROOT_RETURN: the system's margin() reached zero
  too_much_work,         ///< CV_TOO_MUCH_WORK: the limit of steps was reached
  too_much_accuracy,     ///< CV_TOO_MUCH_ACC: the tolerances are finer than round-off
  error_test_failed,     ///< CV_ERR_FAILURE: the error test failed even with the smallest step
  convergence_failed,    ///< CV_CONV_FAILURE, CV_NLS_…: the nonlinear iteration did not converge
  linear_solver_failed,  ///< CV_LINIT_FAIL, CV_LSETUP_FAIL, CV_LSOLVE_FAIL
  right_hand_side_failed,  ///< CV_RHSFUNC_FAIL and the like: the rates ẏ were not finite
                           ///< (after the start, Adams' method gives convergence_failed instead)
  out_of_memory,           ///< an object of SUNDIALS could not be allocated
  refused,                 ///< any other flag, for example for an illegal input
};

/// The outcome that corresponds to a return flag of CVODE; `refused` for an unlisted flag.
inline IntegrationOutcome outcome_of_flag(int flag) {
  using Outcome = IntegrationOutcome;
  struct Family {
    Outcome outcome;
    std::initializer_list<int> flags;
  };
  static const Family families[] = {
      {Outcome::completed, {CV_SUCCESS, CV_TSTOP_RETURN}},
      {Outcome::model_ended, {CV_ROOT_RETURN}},
      {Outcome::too_much_work, {CV_TOO_MUCH_WORK}},
      {Outcome::too_much_accuracy, {CV_TOO_MUCH_ACC}},
      {Outcome::error_test_failed, {CV_ERR_FAILURE}},
      {Outcome::convergence_failed,
       {CV_CONV_FAILURE, CV_NLS_INIT_FAIL, CV_NLS_SETUP_FAIL, CV_NLS_FAIL}},
      {Outcome::linear_solver_failed, {CV_LINIT_FAIL, CV_LSETUP_FAIL, CV_LSOLVE_FAIL}},
      {Outcome::right_hand_side_failed,
       {CV_RHSFUNC_FAIL, CV_FIRST_RHSFUNC_ERR, CV_REPTD_RHSFUNC_ERR, CV_UNREC_RHSFUNC_ERR}},
      {Outcome::out_of_memory, {CV_MEM_FAIL, CV_MEM_NULL}}};
  for (const Family& family : families)
    if (std::find(family.flags.begin(), family.flags.end(), flag) != family.flags.end())
      return family.outcome;
  return Outcome::refused;
}

/// CVODE's name of a return flag, for example "CV_TOO_MUCH_WORK".
inline std::string name_of_flag(int flag) {
  const std::unique_ptr<char, decltype(&std::free)> name(CVodeGetReturnFlagName(flag), &std::free);
  return name ? std::string(name.get()) : "flag " + std::to_string(flag);
}

/// Numbers of steps and evaluations of an integration.
struct IntegrationCost {
  long steps = 0;                 ///< internal steps of the integrator
  long rate_evaluations = 0;      ///< calls of the right-hand side
  long jacobian_evaluations = 0;  ///< evaluations of a banded Jacobian; 0 without one
};

/// Tolerances of the local error per step, and the limit of steps per integration call.
struct Tolerances {
  double relative = 1e-6;  ///< relative tolerance, > 0
  double absolute = 1e-9;  ///< absolute tolerance in the units of the states (m, m/s), > 0
  /// Largest number of steps, > 0, in one call of advance_to(); more give `too_much_work`.
  long largest_number_of_steps = 2000000;
};

namespace detail {

template <auto Free>
struct FreeBy {
  template <class Handle>
  void operator()(Handle handle) const {
    Free(handle);
  }
};
/// Deleter that passes the handle's address to a SUNDIALS function, which sets the handle to null.
template <auto Free>
struct FreeByAddress {
  template <class Handle>
  void operator()(Handle handle) const {
    Free(&handle);
  }
};

template <class Handle, class Free>
using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, Free>;
using Context = Owned<SUNContext, FreeByAddress<&SUNContext_Free>>;
using SerialVector = Owned<N_Vector, FreeBy<&N_VDestroy>>;
using BandMatrix = Owned<SUNMatrix, FreeBy<&SUNMatDestroy>>;
using LinearSolver = Owned<SUNLinearSolver, FreeBy<&SUNLinSolFree>>;
using NonlinearSolver = Owned<SUNNonlinearSolver, FreeBy<&SUNNonlinSolFree>>;
using Memory = Owned<void*, FreeByAddress<&CVodeFree>>;

inline SUNContext make_context() {
  SUNContext context = nullptr;
#if SUNDIALS_VERSION_MAJOR >= 7
  if (SUNContext_Create(SUN_COMM_NULL, &context) != SUN_SUCCESS) return nullptr;
  SUNContext_ClearErrHandlers(context);  // a library does not print
#else
  if (SUNContext_Create(nullptr, &context) != 0) return nullptr;
#endif
  return context;
}

/// Base class of the integrators by CVODE: handles, outcome and the message on a failure.
class Session {
 public:
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
  Session(Session&&) = delete;
  Session& operator=(Session&&) = delete;

  IntegrationOutcome outcome() const { return outcome_; }
  /// The message on a failure: the flag's name, and CVODE's message if any; empty without failure.
  const std::string& words() const { return words_; }

 protected:
  /// Session before open(). @throws InvalidParameter for tolerances that are not positive
  explicit Session(const Tolerances& tolerances) {
    require_positive("relative tolerance", tolerances.relative, "");
    require_positive("absolute tolerance", tolerances.absolute, "");
    context_.reset(make_context());
  }
  ~Session() = default;

  /// Prepares the integration from t = 0; CVODE passes `user_data` to the system's functions.
  void open(int method, CVRhsFn rate, const Eigen::VectorXd& initial_state,
            const Tolerances& tolerances, void* user_data) {
    if (lacks_memory(context_ != nullptr)) return;
    state_.reset(N_VNew_Serial(initial_state.size(), context_.get()));
    if (lacks_memory(state_ != nullptr)) return;
    Eigen::Map<Eigen::VectorXd>(N_VGetArrayPointer(state_.get()), initial_state.size()) =
        initial_state;
    if (lacks_memory_for_vectors(initial_state.size(), vectors_of_integrator)) return;
    memory_.reset(CVodeCreate(method, context_.get()));
    if (lacks_memory(memory_ != nullptr)) return;
    listen_to_messages();
    check(CVodeInit(memory_.get(), rate, 0.0, state_.get()));
    check(CVodeSetUserData(memory_.get(), user_data));
    check(CVodeSStolerances(memory_.get(), tolerances.relative, tolerances.absolute));
    check(CVodeSetMaxNumSteps(memory_.get(), tolerances.largest_number_of_steps));
    check(CVodeSetMaxHnilWarns(memory_.get(), -1));  // SUNDIALS 7 prints these warnings itself
  }

  void use_fixed_point() {
    if (outcome_ != IntegrationOutcome::completed) return;
    nonlinear_solver_.reset(SUNNonlinSol_FixedPoint(state_.get(), 0, context_.get()));
    if (lacks_memory(nonlinear_solver_ != nullptr)) return;
    check(CVodeSetNonlinearSolver(memory_.get(), nonlinear_solver_.get()));
  }

  bool check(int flag) {
    if (outcome_ != IntegrationOutcome::completed) return false;
    const bool warning = flag > 0 && flag != CV_ROOT_RETURN;
    outcome_ = warning ? IntegrationOutcome::completed : outcome_of_flag(flag);
    if (outcome_ == IntegrationOutcome::completed) return true;
    words_ = name_of_flag(flag) + (message_.empty() ? "" : ": " + message_);
    return false;
  }

  /// Whether memory for SUNDIALS' own vectors is lacking, which version 6 does not check. The test
  /// allocates and frees as much memory. For a matrix see lacks_memory_for_matrix().
  bool lacks_memory_for_vectors(sunindextype states, sunindextype vectors) {
    const SerialVector spare(N_VNew_Serial(states * vectors, context_.get()));
    return lacks_memory(spare != nullptr);
  }
  bool lacks_memory_for_matrix(sunindextype states, sunindextype reach) {
    const BandMatrix spare(
        SUNBandMatrixStorage(states, reach, reach, 2 * reach + spare_rows, context_.get()));
    return lacks_memory(spare != nullptr);
  }

  bool lacks_memory(bool made) {
    if (made) return false;
    outcome_ = IntegrationOutcome::out_of_memory;
    words_ = "CV_MEM_FAIL: there is not enough memory";
    return true;
  }

  /// The counter of CVODE that `get` reads; 0 where it cannot be read.
  long count(int (*get)(void*, long*)) const {
    long number = 0;
    return memory_ && get(memory_.get(), &number) == CV_SUCCESS ? number : 0;
  }

  /// Upper bound of the number of vectors that Adams' method allocates; BDF needs fewer.
  static constexpr sunindextype vectors_of_integrator = 32;
  /// Rows added to a matrix for the vectors that CVODE allocates beside its copy of the matrix.
  static constexpr sunindextype spare_rows = 8;

  IntegrationOutcome outcome_ = IntegrationOutcome::completed;
  std::string words_, message_;
  // Members are freed in reverse order, the context last.
  Context context_;
  SerialVector state_;
  BandMatrix matrix_;
  LinearSolver linear_solver_;
  NonlinearSolver nonlinear_solver_;
  Memory memory_;

 private:
#if SUNDIALS_VERSION_MAJOR < 7
  static void note_message(int, const char*, const char*, char* message, void* self) {
    static_cast<Session*>(self)->message_ = message;
  }
  void listen_to_messages() { check(CVodeSetErrHandlerFn(memory_.get(), &note_message, this)); }
#else
  static void note_message(int, const char*, const char*, const char* message, SUNErrCode,
                           void* self, SUNContext) {
    if (message != nullptr) static_cast<Session*>(self)->message_ = message;
  }
  void listen_to_messages() { SUNContext_PushErrHandler(context_.get(), &note_message, this); }
#endif
};

}  // namespace detail

}  // namespace holdfast::cvode
