// Loops that oscillate by themselves: no force on the conductor, unstable gains or a play, and what
// bounds the motion. Each verdict against routes of their own: a long run of exponents, plain
// simulation, and weighted averages.

#include "holdfast/chaos/event_lyapunov.hpp"
#include "holdfast/chaos/motion_classification.hpp"
#include "support/kollar_case.hpp"

namespace holdfast {
namespace {

struct SelfSustained {
  const char* name;
  AttractorType kind;
  Switching switching;
  double sampling_period;   // s
  PdGains<double> gains;    // N/m, N s/m
  double width;             // m
  double largest_force;     // N
  double quantum = 0.0;     // m, of the measured displacement
  std::int64_t period = 0;  // samples, of what is periodic
};

constexpr double unlimited = std::numeric_limits<double>::infinity();
constexpr std::int64_t settling = 60000;

ImplementedLoop loop_of(const SelfSustained& which) {
  ImplementedLoop loop = implemented_loop(test::kollar_loop(which.sampling_period, which.width));
  loop.digital.gains = which.gains;
  loop.digital.force = {};
  loop.digital.limits.largest_force = which.largest_force;
  loop.digital.limits.displacement_quantum = which.quantum;
  loop.switching = which.switching;
  return loop;
}

const Vector<double, 4> released(0.002, 0.0, 0.0, 0.0);

auto settled_motion(const SelfSustained& which) {
  auto motion = event_motion(loop_of(which), released);
  run_trajectory(motion, settling, std::nullopt);
  return motion;
}

/// How much weighted averages of ‖x_i‖² over one stretch and the next differ, relative to them, the
/// weights exp(−1/(t (1 − t))). They converge faster than any power on a smooth torus and as 1/√n
/// where the motion is chaotic (S. Das, Y. Saiki, E. Sander, J. Yorke, Nonlinearity 30, 2017).
double weighted_difference(const SelfSustained& which) {
  constexpr int stretch = 100000;
  auto motion = settled_motion(which);
  double averages[2];
  for (double& average : averages) {
    double sum = 0.0, weights = 0.0;
    for (int j = 1; j < stretch; ++j) {
      const double t = static_cast<double>(j) / stretch;
      const double weight = std::exp(-1.0 / (t * (1.0 - t)));
      sum += weight * motion.sense().state.squaredNorm();
      weights += weight;
      motion.advance();
    }
    average = sum / weights;
  }
  return std::abs(averages[1] - averages[0]) / averages[0];
}

class SelfSustainedMotion : public testing::TestWithParam<SelfSustained> {};

TEST_P(SelfSustainedMotion, IsCalledWhatItIs) {
  const SelfSustained& which = GetParam();
  const EventClassification found = classify_motion(loop_of(which), released);
  EXPECT_EQ(found.classification.kind, which.kind) << found.classification.rests_on;
  EXPECT_EQ(found.classification.period, which.period);
}

TEST_P(SelfSustainedMotion, HasTheExponentOfItsKind) {
  const SelfSustained& which = GetParam();
  constexpr std::int64_t samples = 200000;
  auto motion = event_motion(loop_of(which), released);
  const LyapunovResult found = run_event_lyapunov(motion, {samples, settling});
  std::printf("  %.2e +- %.0e\n", found.exponents[0], found.standard_errors[0]);
  if (which.kind == AttractorType::chaotic) {
    EXPECT_TRUE(found.exponents[0] > 0.0 && found.sign_is_known());
  } else if (which.kind == AttractorType::quasi_periodic) {
    EXPECT_LE(std::abs(found.exponents[0]), 30.0 / samples);
  } else {
    EXPECT_TRUE(found.exponents[0] < 0.0 && found.sign_is_known());
  }
}

TEST_P(SelfSustainedMotion, HasWeightedAveragesThatConvergeWhereItIsRegular) {
  const SelfSustained& which = GetParam();
  // A gap that is entered at samples alone breaks the torus into pieces.
  if (which.kind == AttractorType::quasi_periodic && which.switching == Switching::sampled &&
      which.width > 0.0)
    return;
  const double difference = weighted_difference(which);
  if (which.kind == AttractorType::chaotic) {
    EXPECT_GT(difference, 1e-5);
  } else {
    EXPECT_LT(difference, 1e-6);
  }
}

TEST_P(SelfSustainedMotion, RepeatsExactlyWhereItIsPeriodic) {
  const SelfSustained& which = GetParam();
  auto motion = settled_motion(which);
  const Vector<double, 4> first = motion.state();
  std::int64_t returned = 0;
  for (std::int64_t j = 1; j <= 20000 && returned == 0; ++j) {
    motion.sense();
    motion.advance();
    if ((motion.state() - first).norm() <= 1e-9 * first.norm()) returned = j;
  }
  EXPECT_EQ(returned, which.period);
}

TEST(SelfSustainedMotions, AGapThatSwallowsTheOscillationLeavesRest) {
  // With switching at samples the same loop diverges.
  const SelfSustained which{
      "", AttractorType::periodic, Switching::exact, 0.01, {-557, -30}, 5e-4, unlimited};
  const Classification found = classify_motion(loop_of(which), released).classification;
  EXPECT_EQ(attractor_type_text(found), "periodic(1)") << found.rests_on;
  EXPECT_LT(settled_motion(which).state().norm(), 1e-12 * released.norm());
  SelfSustained at_samples = which;
  at_samples.switching = Switching::sampled;
  EXPECT_EQ(classify_motion(loop_of(at_samples), released).classification.kind,
            AttractorType::diverges);
}

using Kind = AttractorType;
const SelfSustained self_sustained[] = {
    {"CutOff", Kind::quasi_periodic, Switching::sampled, 0.001, {-557, 30}, 0.0, 2.0},
    {"CutOffStiffened", Kind::quasi_periodic, Switching::sampled, 0.003, {200, -13}, 0.0, 2.0},
    {"CutOffWithGap", Kind::quasi_periodic, Switching::sampled, 0.001, {-1500, -5}, 5e-4, 2.0},
    {"CutOffWithPlay", Kind::quasi_periodic, Switching::exact, 0.001, {-1500, -5}, 5e-4, 2.0},
    {"CutOffWithSmallPlay", Kind::quasi_periodic, Switching::exact, 0.005, {-557, 8}, 2e-4, 10.0},
    {"Play", Kind::quasi_periodic, Switching::exact, 0.005, {-557, -20}, 5e-4, unlimited},
    {"Gap", Kind::quasi_periodic, Switching::sampled, 0.005, {-557, -20}, 5e-4, unlimited},
    {"LockedCutOff", Kind::periodic, Switching::sampled, 0.003, {-557, 30}, 0.0, 2.0, 0.0, 44},
    {"LockedSlowly", Kind::periodic, Switching::sampled, 0.01, {-557, 10}, 0.0, 2.0, 0.0, 72},
    {"LockedPlay", Kind::periodic, Switching::exact, 0.01, {-557, 10}, 5e-4, 2.0, 0.0, 1570},
    {"LockedGap", Kind::periodic, Switching::sampled, 0.001, {0, 15}, 5e-4, 2.0, 0.0, 176},
    {"Chatter", Kind::chaotic, Switching::sampled, 0.003, {-557, -60}, 0.0, 2.0},
    {"ChaoticGap", Kind::chaotic, Switching::sampled, 0.01, {-557, 10}, 5e-4, 2.0},
    {"Quantised", Kind::chaotic, Switching::sampled, 0.001, {-557, -13}, 0.0, unlimited, 1e-4},
    {"QuantisedSlowly", Kind::chaotic, Switching::sampled, 0.01, {-557, -13}, 0.0, unlimited, 1e-4},
};

INSTANTIATE_TEST_SUITE_P(Loops, SelfSustainedMotion, testing::ValuesIn(self_sustained),
                         [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace holdfast
