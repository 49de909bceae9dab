#include "holdfast/sundials/cvode.hpp"

#include "holdfast/core/types.hpp"
#include "support/testing.hpp"

namespace holdfast::cvode {
namespace {

/// ẍ = −ω² x: without a Jacobian, for Adams' method.
struct Oscillator {
  double frequency = 3.0;  // rad/s
  int states() const { return 2; }
  void rate(const double* y, double* rate) const {
    rate[0] = y[1];
    rate[1] = -frequency * frequency * y[0];
  }
};

/// Heat in a bar of `size` cells: u̇_i = d (u_{i−1} − 2 u_i + u_{i+1}), banded and stiff. Its modes
/// sin(k π i/(size + 1)) decay with 4 d sin²(k π/(2 (size + 1))).
struct Diffusion {
  int size = 40;
  double diffusivity = 1e4;  // 1/s
  int states() const { return size; }
  int half_bandwidth() const { return 1; }
  void rate(const double* u, double* rate) const {
    for (int i = 0; i < size; ++i)
      rate[i] = diffusivity * ((i > 0 ? u[i - 1] : 0.0) - 2 * u[i] + (i + 1 < size ? u[i + 1] : 0));
  }
  template <class Set>
  void jacobian(const double*, const Set& set) const {
    for (int i = 0; i < size; ++i) {
      set(i, i, -2 * diffusivity);
      if (i > 0) set(i, i - 1, diffusivity);
      if (i + 1 < size) set(i, i + 1, diffusivity);
    }
  }
  double angle(int k) const { return k * pi<double> / (size + 1); }
  double decay(int k) const { return 4 * diffusivity * std::pow(std::sin(angle(k) / 2), 2); }
  Eigen::VectorXd modes(int first, int second, double time) const {
    Eigen::VectorXd u(size);
    for (int i = 0; i < size; ++i)
      u[i] = std::exp(-decay(first) * time) * std::sin(angle(first) * (i + 1)) +
             std::exp(-decay(second) * time) * std::sin(angle(second) * (i + 1));
    return u;
  }
};

/// ẏ = 1 up to y = `wall`, where there is no rate any more.
struct Wall {
  double wall = 0.5;
  int states() const { return 1; }
  void rate(const double* y, double* rate) const {
    rate[0] = y[0] < wall ? 1.0 : std::numeric_limits<double>::quiet_NaN();
  }
};

Eigen::VectorXd one_state(double value) { return Eigen::VectorXd::Constant(1, value); }

double oscillator_error(const Tolerances& tolerances) {
  const Oscillator system;
  Integrator<Oscillator> integrator(system, Eigen::Vector2d(1.0, 0.0), tolerances);
  EXPECT_EQ(integrator.advance_to(10.0), IntegrationOutcome::completed);
  return std::hypot(integrator.state()[0] - std::cos(30.0),
                    integrator.state()[1] / 3.0 + std::sin(30.0));
}

double diffusion_error(const Tolerances& tolerances) {
  const Diffusion system;
  const double time = 0.5 / system.decay(1);
  Integrator<Diffusion> integrator(system, system.modes(1, 39, 0.0), tolerances);
  EXPECT_EQ(integrator.advance_to(time), IntegrationOutcome::completed);
  const Eigen::Map<const Eigen::VectorXd> found(integrator.state(), system.size);
  return (found - system.modes(1, 39, time)).cwiseAbs().maxCoeff();
}

TEST(Integrator, AnOscillatorFollowsItsCosine) {
  EXPECT_LT(oscillator_error({1e-10, 1e-12}), 1e-7);
  EXPECT_LT(oscillator_error({1e-10, 1e-12}), 0.01 * oscillator_error({1e-5, 1e-7}));
}

TEST(Integrator, ABandedStiffSystemFollowsItsModes) {
  EXPECT_LT(diffusion_error({1e-9, 1e-12}), 1e-6);
  EXPECT_LT(diffusion_error({1e-9, 1e-12}), 0.05 * diffusion_error({1e-4, 1e-7}));
}

TEST(Integrator, ASystemThatStatesItsJacobianIsTakenToBeStiff) {
  const Diffusion stiff;
  Integrator<Diffusion> banded(stiff, stiff.modes(1, 39, 0.0), {});
  banded.advance_to(1.0 / stiff.decay(1));
  EXPECT_GT(banded.cost().jacobian_evaluations, 0);
  // An explicit method would need a step for about every second 1/decay(39).
  EXPECT_LT(static_cast<double>(banded.cost().steps), 0.3 * stiff.decay(39) / stiff.decay(1));
  const Oscillator plain;
  Integrator<Oscillator> adams(plain, Eigen::Vector2d(1.0, 0.0), {});
  adams.advance_to(1.0);
  EXPECT_EQ(adams.cost().jacobian_evaluations, 0);
  EXPECT_GT(adams.cost().steps, 0);
  EXPECT_GE(adams.cost().rate_evaluations, adams.cost().steps);
}

TEST(Integrator, ItGoesOnFromWhereItStopped) {
  const Oscillator system;
  Integrator<Oscillator> integrator(system, Eigen::Vector2d(1.0, 0.0), {1e-10, 1e-12});
  for (int k = 1; k <= 20; ++k) {
    ASSERT_EQ(integrator.advance_to(0.1 * k), IntegrationOutcome::completed);
    EXPECT_NEAR(integrator.state()[0], std::cos(0.3 * k), 1e-7);
  }
  EXPECT_TRUE(integrator.words().empty());
}

TEST(Integrator, TooManyStepsIsAnOutcomeInCvodesWordsAndNothingIsPrinted) {
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  const Oscillator system;
  Integrator<Oscillator> integrator(system, Eigen::Vector2d(1.0, 0.0), {1e-8, 1e-10, 5});
  const auto outcome = integrator.advance_to(10.0);
  const auto again = integrator.advance_to(11.0);
  const std::string printed =
      testing::internal::GetCapturedStderr() + testing::internal::GetCapturedStdout();
  EXPECT_EQ(outcome, IntegrationOutcome::too_much_work);
  EXPECT_EQ(again, outcome) << "once it has failed it stays failed";
  EXPECT_EQ(integrator.outcome(), outcome);
  EXPECT_NE(integrator.words().find("CV_TOO_MUCH_WORK"), std::string::npos) << integrator.words();
  EXPECT_EQ(integrator.cost().steps, 5);
  EXPECT_EQ(printed, "");
}

TEST(Integrator, ARateThatIsNoNumberFromTheStartIsAnOutcomeAndNothingIsPrinted) {
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  const Wall system{0.0};
  Integrator<Wall> integrator(system, one_state(0.0), {});
  const auto outcome = integrator.advance_to(1.0);
  const std::string printed =
      testing::internal::GetCapturedStderr() + testing::internal::GetCapturedStdout();
  EXPECT_EQ(outcome, IntegrationOutcome::right_hand_side_failed);
  EXPECT_NE(integrator.words().find("RHSFUNC"), std::string::npos) << integrator.words();
  EXPECT_EQ(printed, "");
}

TEST(Integrator, ItDoesNotPassAPlaceBeyondWhichThereIsNoRate) {
  testing::internal::CaptureStderr();
  const Wall system;
  Integrator<Wall> integrator(system, one_state(0.0), {1e-6, 1e-9, 2000});
  EXPECT_EQ(integrator.advance_to(0.4), IntegrationOutcome::completed);
  EXPECT_NEAR(integrator.state()[0], 0.4, 1e-6);
  EXPECT_NE(integrator.advance_to(1.0), IntegrationOutcome::completed);
  EXPECT_NEAR(integrator.state()[0], 0.5, 1e-6);
  EXPECT_FALSE(integrator.words().empty());
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

/// The oscillator for so many evaluations, then no number; banded, for Newton's method,
/// which unlike the fixed point hands the rate's failure on.
struct Breakdown {
  mutable int evaluations = 100;
  int states() const { return 2; }
  int half_bandwidth() const { return 1; }
  void rate(const double* y, double* rate) const {
    Oscillator{}.rate(y, rate);
    if (evaluations-- <= 0) rate[1] = std::numeric_limits<double>::quiet_NaN();
  }
  template <class Set>
  void jacobian(const double*, const Set& set) const {
    set(0, 1, 1.0);
    set(1, 0, -9.0);
  }
};

TEST(Integrator, ARateThatBreaksDownOnTheWayIsAnOutcomeToo) {
  testing::internal::CaptureStderr();
  const Breakdown system;
  Integrator<Breakdown> integrator(system, Eigen::Vector2d(1.0, 0.0), {});
  EXPECT_EQ(integrator.advance_to(0.01), IntegrationOutcome::completed);
  EXPECT_EQ(integrator.advance_to(100.0), IntegrationOutcome::right_hand_side_failed);
  EXPECT_NE(integrator.words().find("RHSFUNC"), std::string::npos) << integrator.words();
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(Integrator, AStateOfAnotherSizeThanTheSystemsIsRefused) {
  const Oscillator system;
  EXPECT_THROW(Integrator<Oscillator>(system, Eigen::Vector3d(1.0, 0.0, 0.0), {1e-6, 1e-9}),
               InvalidParameter);
}

TEST(Integrator, TolerancesThatAreNotPositiveAreRefused) {
  const Oscillator system;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {0.0, -1.0, nan}) {
    EXPECT_THROW(Integrator<Oscillator>(system, Eigen::Vector2d(1.0, 0.0), {bad, 1e-9}),
                 InvalidParameter);
    EXPECT_THROW(Integrator<Oscillator>(system, Eigen::Vector2d(1.0, 0.0), {1e-6, bad}),
                 InvalidParameter);
  }
}

TEST(Flags, HaveCvodesNamesAndTheirOutcomes) {
  EXPECT_EQ(name_of_flag(CV_TOO_MUCH_WORK), "CV_TOO_MUCH_WORK");
  EXPECT_EQ(name_of_flag(CV_SUCCESS), "CV_SUCCESS");
  struct Case {
    int flag;
    IntegrationOutcome outcome;
  };
  for (const Case& each : {Case{CV_SUCCESS, IntegrationOutcome::completed},
                           {CV_TSTOP_RETURN, IntegrationOutcome::completed},
                           {CV_TOO_MUCH_WORK, IntegrationOutcome::too_much_work},
                           {CV_TOO_MUCH_ACC, IntegrationOutcome::too_much_accuracy},
                           {CV_ERR_FAILURE, IntegrationOutcome::error_test_failed},
                           {CV_CONV_FAILURE, IntegrationOutcome::convergence_failed},
                           {CV_LSETUP_FAIL, IntegrationOutcome::linear_solver_failed},
                           {CV_LSOLVE_FAIL, IntegrationOutcome::linear_solver_failed},
                           {CV_RHSFUNC_FAIL, IntegrationOutcome::right_hand_side_failed},
                           {CV_REPTD_RHSFUNC_ERR, IntegrationOutcome::right_hand_side_failed},
                           {CV_MEM_FAIL, IntegrationOutcome::out_of_memory},
                           {CV_ILL_INPUT, IntegrationOutcome::refused},
                           {CV_TOO_CLOSE, IntegrationOutcome::refused}})
    EXPECT_EQ(outcome_of_flag(each.flag), each.outcome) << name_of_flag(each.flag);
}

}  // namespace
}  // namespace holdfast::cvode
