#include "holdfast/chaos/event_lyapunov.hpp"

#include "orbit/event/event_setting.hpp"
#include "support/dense_routes.hpp"
#include "support/kollar_case.hpp"
#include "support/move_samples.hpp"

namespace holdfast {
namespace {

constexpr double annihilated = -std::numeric_limits<double>::infinity();

ImplementedLoop kollar_loop_exactly(const test::KollarCase& which) {
  ImplementedLoop loop = implemented_loop(which.ideal_loop());
  loop.switching = Switching::exact;
  loop.digital.hold = ForceHold::exact;
  return loop;
}

EventMotion<> backlash_motion(const test::KollarCase& which) {
  const ImplementedLoop loop = kollar_loop_exactly(which);
  return {loop.digital, test::exact_backlash(loop.plant, loop.backlash.width), which.initial_state};
}

test::KollarCase kollar_case_of(double period, double width, double delay = 0.0) {
  test::KollarCase which = test::kollar_case(period, width);
  which.processing_delay = delay;
  return which;
}

int finite_exponents(const LyapunovSpectrum<double, 7>& spectrum) {
  const Vector<double, 7> exponents = spectrum.exponents();
  return static_cast<int>((exponents.array() > annihilated).count());
}

/// A law that is asked at samples: the maps are S and S*, and the spectrum that of BlockSpectrum.
TEST(EventLyapunov, AtSamplesItIsTheSpectrumOfTheSampledMotion) {
  for (const double delay : {0.0, 0.003}) {
    auto which = kollar_case_of(0.011, 0.002, delay);
    which.gains.differential = -8.0;
    const LyapunovRun run{4000, 1000};
    const ImplementedLoop loop = implemented_loop(which.ideal_loop());
    EventMotion<> motion(
        loop.digital,
        DriveContact<>(loop.plant, loop.backlash, Switching::sampled, Vector<double, 4>::Zero()),
        which.initial_state);
    EventLyapunov<DriveContact<>> lyapunov(motion);
    auto sampled = which.motion();
    LyapunovObserver<double> observer(which.loop(), which.gains);
    for (const std::int64_t samples : {run.discard, run.samples}) {
      lyapunov.restart();
      observer.restart();
      test::move_samples(lyapunov, samples);
      run_trajectory(sampled, samples, std::nullopt, observer);
    }
    const auto found = lyapunov.spectrum().exponents();
    const auto expected = observer.spectrum().exponents();
    for (const int leading : {2, 3, 4})
      EXPECT_NEAR(found.head(leading).sum(), expected.head(leading).sum(), 1e-9) << leading;
    EXPECT_EQ(found[4], annihilated);
    EXPECT_EQ(expected[4], annihilated);
  }
}

/// The growth of one tangent vector by two neighbours, brought near again at every sample.
class GrowthByDifferences {
 public:
  explicit GrowthByDifferences(const EventMotion<>& motion, const Vector<double, 7>& direction)
      : motion_(motion), direction_(direction), sizes_(test::sizes_of(motion)) {}

  /// @return false where no neighbour near enough goes the same way
  bool advance() {
    EventMotion<> next = motion_;
    test::SwitchNotes notes(next);
    notes.move(1);
    double step = 3e-6 / direction_.cwiseQuotient(sizes_).cwiseAbs().maxCoeff();
    std::optional<test::Difference> difference;
    for (int attempt = 0; attempt < 4 && !difference; ++attempt, step *= 0.2)
      difference = test::derivative_along(motion_, direction_, step, 1, notes.switches);
    if (!difference) return false;
    logarithm_ += std::log(difference->value.norm());
    direction_ = difference->value.normalized();
    motion_ = next;
    return true;
  }

  double logarithm() const { return logarithm_; }

 private:
  EventMotion<> motion_;
  Vector<double, 7> direction_, sizes_;
  double logarithm_ = 0.0;
};

TEST(EventLyapunov, TheLargestExponentIsThatOfNeighbouringMotions) {
  test::Random random(921);
  int sticking = 0, lost = 0;
  for (int trial = 0; trial < 50; ++trial) {
    const auto setting = test::bounded_event_setting(random, trial);
    auto motion = setting.motion();
    for (int left = static_cast<int>(2.0 / setting.loop.sampling.period);
         left > 0 || motion.contact().word() == ContactMode::stick; --left) {
      motion.sense();
      motion.advance();
    }
    GrowthByDifferences neighbours(motion, detail::oblique_basis().col(0));
    EventLyapunov<DriveContact<>> lyapunov(motion);
    constexpr int samples = 1500;
    const auto sticks = motion.counts().entered[2];
    bool kept = true;
    for (int sample = 0; sample < samples && kept; ++sample) {
      kept = neighbours.advance();
      lyapunov.sense();
      lyapunov.advance();
    }
    if (!kept) {
      ++lost;
      continue;
    }
    const double largest = lyapunov.spectrum().exponents()[0];
    EXPECT_NEAR(neighbours.logarithm() / samples, largest, 1e-4 * std::abs(largest)) << trial;
    if (motion.counts().entered[2] > sticks + 10) ++sticking;
  }
  EXPECT_LE(lost, 2);
  EXPECT_GT(sticking, 20);
}

/// With a delay and the velocity by difference, u_{j−1} and z₁ as read both act: six exponents are
/// finite, and the seventh, where the gap lies, is not. Stick has one null direction more.
TEST(EventLyapunov, WhatIsNotUsedIsAnnihilated) {
  struct Asked {
    double delay, width;
    VelocitySensing velocity;
    int finite;
  };
  for (const Asked& asked : {Asked{0.0, 0.0, VelocitySensing::measured, 4},
                             Asked{0.0004, 0.0, VelocitySensing::measured, 5},
                             Asked{0.0, 0.0, VelocitySensing::difference, 5},
                             Asked{0.0004, 0.0, VelocitySensing::difference, 6},
                             Asked{0.0, 0.0005, VelocitySensing::measured, 3},
                             Asked{0.0004, 0.0005, VelocitySensing::measured, 3}}) {
    ImplementedLoop loop = kollar_loop_exactly(kollar_case_of(0.001, asked.width, asked.delay));
    loop.digital.limits.velocity = asked.velocity;
    EventMotion<> motion(loop.digital, test::exact_backlash(loop.plant, asked.width),
                         Vector<double, 4>::Zero());
    EventLyapunov<DriveContact<>> from_rest(motion);
    run_trajectory(from_rest, 1, std::nullopt);
    // Before its first sample a controller has read nothing that could be varied.
    EXPECT_EQ(finite_exponents(from_rest.spectrum()), asked.delay > 0.0 ? 5 : 4);
    EventLyapunov<DriveContact<>> lyapunov(motion);
    run_trajectory(lyapunov, 3000, std::nullopt);
    EXPECT_EQ(finite_exponents(lyapunov.spectrum()), asked.finite);
    EXPECT_EQ(motion.counts().entered[2] > 0, asked.width > 0.0);
  }
}

/// A drive that crosses its gap without an end moves by A_d, and where its gap lies stays as it is.
TEST(EventLyapunov, AGapThatIsNeverLeftIsNeutral) {
  const auto which = kollar_case_of(0.001, 0.05);
  auto motion = backlash_motion(which);
  while (motion.contact().word() != ContactMode::gap || motion.time() < 5.0) {
    motion.sense();
    motion.advance();
  }
  const auto result = run_event_lyapunov(motion, {4000, 20000});
  Matrix<double, 5> map = Matrix<double, 5>::Zero();
  map.topLeftCorner<4, 4>() = which.loop().transition;
  const auto expected = test::log_moduli_of(map);
  EXPECT_NEAR(result.exponents[0], 0.0, 1e-9);
  EXPECT_NEAR(result.exponents.segment<2>(1).sum(), expected[0] + expected[1], 1e-9);
}

/// What is contracted beyond rounding is not mistaken for what is annihilated: with gains of zero
/// the exponents are those of the plant, at any length of the run.
TEST(EventLyapunov, AStrongContractionIsFinite) {
  auto which = kollar_case_of(0.5, 0.0);
  which.gains = {0.0, 0.0};
  auto motion = backlash_motion(which);
  const auto result = run_event_lyapunov(motion, {2000, 100});
  Matrix<double, 5> map = Matrix<double, 5>::Zero();
  map.topLeftCorner<4, 4>() = which.loop().transition;
  const auto expected = test::log_moduli_of(map);
  EXPECT_LT(expected[3] - expected[0], -18.0);
  EXPECT_NEAR(result.exponents.head<2>().sum(), expected[0] + expected[1], 1e-9);
  EXPECT_NEAR(result.exponents.segment<2>(2).sum(), expected[2] + expected[3], 1e-5);
  EXPECT_EQ(result.exponents[4], annihilated);
}

TEST(EventLyapunov, GoesBesideATrajectoryAndChangesNothing) {
  const auto which = kollar_case_of(0.001, 0.0005);
  const Kick kick{0.5, 1e-4};
  auto plain = backlash_motion(which), followed = plain;
  std::vector<double> history;
  EventLyapunov<DriveContact<>> lyapunov(followed);
  std::vector<Vector<double, 4>> seen, expected;
  run_trajectory(lyapunov, 2000, kick, [&](const MotionSample<double>& sample) {
    seen.push_back(sample.state);
    history.push_back(lyapunov.spectrum().exponents()[0]);
  });
  run_trajectory(plain, 2000, kick,
                 [&](const MotionSample<double>& sample) { expected.push_back(sample.state); });
  EXPECT_EQ(seen, expected);
  EXPECT_EQ(followed.index(), 2000);
  EXPECT_EQ(lyapunov.spectrum().steps(), 2000);
  EXPECT_TRUE(std::isnan(history.front()));
  EXPECT_TRUE(std::isfinite(history.back()));
}

}  // namespace
}  // namespace holdfast
