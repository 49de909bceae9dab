// A controller of the user's own through motion, orbit, exponents and verdict.

#include "holdfast/control/controlled_plant.hpp"

#include <algorithm>

#include "holdfast/chaos/event_lyapunov.hpp"
#include "holdfast/chaos/motion_classification.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/math/linalg/eigenvalues.hpp"
#include "support/lagging_loop.hpp"
#include "support/message_of.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

using Column = Vector<double, Eigen::Dynamic>;
using OwnLoop = ImplementedLoopOf<ControlledPlant>;
using BuiltInLoop = ImplementedLoopOf<LinearPlant<double>>;

const PdGains<double> pd{-200.0, -5.0};

/// P and D without their derivative.
struct BarePd {
  static constexpr int states = 0;
  double largest_force;
  double command(const ControlSample& sample, Vector<double, 0>&) const {
    const double demand = -200.0 * sample.displacement - 5.0 * sample.velocity;
    return std::clamp(demand, -largest_force, largest_force);
  }
};

/// P and D with the backward difference of the displacements for a velocity, as a controller of one
/// state.
struct DifferencePd {
  static constexpr int states = 1;
  double command(const ControlSample& sample, Vector<double, 1>& last) const {
    const double rate = (sample.displacement - last[0]) / sample.elapsed;
    last[0] = sample.displacement;
    return -200.0 * sample.displacement - 1.0 * rate;
  }
};

template <class Plant>
Column rest_of(const ImplementedLoopOf<Plant>& loop) {
  return Column::Zero(loop.plant.order());
}

/// The loop of the tests of other plants, under a controller of one's own.
template <class Law>
OwnLoop own_loop(const Law& law, Switching switching, double delay) {
  OwnLoop loop = test::lagging_loop(with_controller(kollar2022_plant(), law), switching, delay);
  loop.digital.gains = {};
  return loop;
}

BuiltInLoop built_in_loop(Switching switching, double delay) {
  return test::lagging_loop(test::through_ports(kollar2022_plant()), switching, delay);
}

void expect_near(double value, double expected, double tolerance) {
  if (std::isinf(expected)) {
    EXPECT_EQ(value, expected);
  } else {
    EXPECT_NEAR(value, expected, tolerance);
  }
}

/// Samples, orbit, exponents and verdict of two loops are the same. @return samples in the gap
/// @param tolerance     of a multiplier's logarithm over a sample
/// @param of_exponents  more where their tangent vectors do not begin alike
int expect_same(const OwnLoop& own, const BuiltInLoop& other, double tolerance,
                double of_exponents) {
  auto motion = event_motion(own, rest_of(own));
  auto reference = event_motion(other, rest_of(other));
  int in_gap = 0;
  for (int j = 0; j < 1500; ++j, motion.advance(), reference.advance()) {
    const auto sample = motion.sense();
    const auto expected = reference.sense();
    EXPECT_EQ(sample.mode, expected.mode) << j;
    in_gap += sample.mode == ContactMode::gap ? 1 : 0;
    EXPECT_NEAR(sample.control_force, expected.control_force, 1e-12) << j;
    EXPECT_LE((sample.state.head(4) - expected.state).norm(), 1e-13) << j;
  }
  const LyapunovRun run{3000, 1000};
  const LyapunovResult exponents = run_event_lyapunov(motion, run);
  const LyapunovResult expected = run_event_lyapunov(reference, run);
  for (int i = 0; i < 4; ++i)
    expect_near(exponents.exponents[i], expected.exponents[i], of_exponents);

  const auto found = classify_motion(own, rest_of(own));
  const auto known = classify_motion(other, rest_of(other));
  EXPECT_EQ(found.classification.kind, AttractorType::periodic);
  EXPECT_EQ(found.classification.period, known.classification.period);
  EXPECT_EQ(found.search.outcome, OrbitOutcome::certified);
  if (!found.search.orbit || !known.search.orbit) {
    ADD_FAILURE() << "no orbit";
    return 0;
  }
  EXPECT_NEAR(found.search.orbit->largest_displacement, known.search.orbit->largest_displacement,
              1e-12);
  EXPECT_EQ(found.search.orbit->multipliers.size(), known.search.orbit->multipliers.size());
  for (std::size_t k = 0; k < 4; ++k)
    expect_near(found.search.orbit->multipliers[k].log_modulus,
                known.search.orbit->multipliers[k].log_modulus, 100 * tolerance);
  return in_gap;
}

/// P, D and an integral of the displacement, which a force between the two masses cannot move: the
/// loop has no way of bringing it back but the leak.
struct IntegratingPd {
  static constexpr int states = 1;
  double kept;  // of the integral, a sample
  double command(const ControlSample& sample, Vector<double, 1>& integral) const {
    integral[0] = kept * integral[0] + sample.displacement * sample.elapsed;
    return -200.0 * sample.displacement - 5.0 * sample.velocity - 50.0 * integral[0];
  }
};

OwnLoop integrating_loop(double kept, Switching switching) {
  OwnLoop loop = own_loop(IntegratingPd{kept}, switching, 0.0);
  loop.backlash.width = 0.0;
  return loop;
}

TEST(OwnController, AnIntegratorThatNothingBringsBackIsNamed) {
  for (const auto switching : {Switching::exact, Switching::sampled}) {
    const OwnLoop loop = integrating_loop(1.0, switching);
    Column start = rest_of(loop);
    Column first[2];
    for (Column& begins : first) {
      const auto found = find_event_orbit(event_motion(loop, start));
      ASSERT_EQ(found.outcome, OrbitOutcome::neutral);
      EXPECT_EQ(found.neutral_state, std::optional<std::int64_t>(4));
      ASSERT_TRUE(found.orbit);
      EXPECT_NEAR(found.orbit->multipliers.front().log_modulus, 0.0, 1e-8);
      EXPECT_LT(found.orbit->multipliers[1].log_modulus, -1e-3);
      EXPECT_LT(found.samples, 1'000'000);
      begins = found.orbit->states.front();
      start[4] += 0.01;
    }
    EXPECT_GT(std::abs(first[1][4] - first[0][4]), 1e-3) << "another one of the family";
  }
}

TEST(OwnController, AnIntegratorWithALeakHasOneOrbit) {
  const OwnLoop loop = integrating_loop(0.99, Switching::exact);
  const auto found = find_event_orbit(event_motion(loop, rest_of(loop)));
  EXPECT_EQ(found.outcome, OrbitOutcome::certified);
  EXPECT_FALSE(found.neutral_state);
}

TEST(OwnController, TheVerdictNamesWhatIsNotBroughtBack) {
  const OwnLoop loop = integrating_loop(1.0, Switching::exact);
  const auto found = classify_motion(loop, rest_of(loop));
  EXPECT_NE(found.classification.rests_on.find("state variable 5"), std::string::npos)
      << found.classification.rests_on;
}

TEST(OwnController, PAndDAreTheBuiltInLoop) {
  for (const Switching switching : {Switching::sampled, Switching::exact})
    for (const double delay : {0.0, 0.001})
      for (const bool bare : {false, true}) {
        const double unlimited = std::numeric_limits<double>::infinity();
        const OwnLoop own =
            bare ? own_loop(BarePd{unlimited}, switching, delay) : own_loop(pd, switching, delay);
        const double tolerance = bare ? 1e-8 : 1e-12;
        EXPECT_GT(expect_same(own, built_in_loop(switching, delay), tolerance, tolerance), 100);
      }
}

TEST(OwnController, ThatSaturatesIsTheBuiltInLoopWithALimitOfItsForce) {
  const double most = 0.15;
  BuiltInLoop limited = built_in_loop(Switching::exact, 0.001);
  limited.digital.limits.largest_force = most;
  expect_same(own_loop(BarePd{most}, Switching::exact, 0.001), limited, 1e-8, 1e-8);
}

TEST(OwnController, ThatRemembersTheLastSampleIsTheBuiltInDifference) {
  for (const double delay : {0.0, 0.001}) {
    BuiltInLoop differs = built_in_loop(Switching::exact, delay);
    differs.digital.gains = {-200.0, -1.0};
    differs.digital.limits.velocity = VelocitySensing::difference;
    expect_same(own_loop(DifferencePd{}, Switching::exact, delay), differs, 1e-8, 3.0 / 3000.0);
  }
}

/// A linear controller without its derivative.
template <int States>
struct Bare {
  static constexpr int states = States;
  LinearController<States> law;
  double command(const ControlSample& sample, Vector<double, States>& state) const {
    return law.command(sample, state);
  }
};

/// x̂⁺ = A x̂ + b u + L (z − x̂₁), u = K x̂, of the loop without delay.
LinearController<4> observer_based(const SampledLoop<double>& loop, const Vector<double, 4>& gain) {
  const RowVector<double, 4> feedback = pd.feedback_row();
  LinearController<4> law;
  law.transition = loop.transition + loop.present_force * feedback;
  law.transition.col(0) -= gain;
  law.input << gain, Vector<double, 4>::Zero();
  law.output = feedback;
  return law;
}

std::vector<double> log_moduli(const Matrix<double, Eigen::Dynamic>& map) {
  std::vector<double> result;
  for (const auto& value : eigenvalues(map)) result.push_back(std::log(std::abs(value)));
  std::sort(result.rbegin(), result.rend());
  return result;
}

/// [x; x_c; u_{j−1}] over one sample, put together by hand.
Matrix<double, Eigen::Dynamic> closed_map(const SampledLoop<double>& loop,
                                          const LinearController<4>& law) {
  Matrix<double, 2, 4> reads = Matrix<double, 2, 4>::Zero();
  reads(0, 0) = reads(1, 1) = 1.0;
  Matrix<double, Eigen::Dynamic> map = Matrix<double, Eigen::Dynamic>::Zero(9, 9);
  RowVector<double, 9> command = RowVector<double, 9>::Zero();
  command << law.feedthrough * reads, law.output, 0.0;
  map.block<4, 4>(0, 0) = loop.transition;
  map.block<4, 1>(0, 8) = loop.previous_force;
  map.topRows<4>() += loop.present_force * command;
  map.block<4, 4>(4, 0) = law.input * reads;
  map.block<4, 4>(4, 4) = law.transition;
  map.row(8) = command;
  return map;
}

/// Over the period of 20 samples of a loop without backlash the multipliers are λ²⁰.
TEST(OwnController, OfAnObserverHasTheEigenvaluesOfItsMatrix) {
  const Vector<double, 4> gain(0.4, 12.0, 0.3, 8.0);
  for (const double delay : {0.0, 0.002}) {
    const auto sampled = sampled_loop(kollar2022_plant(), Sampling<double>{0.005, delay});
    const LinearController<4> law = observer_based(sampled, gain);
    const auto expected = log_moduli(closed_map(sampled, law));
    ASSERT_LT(expected.front(), -1e-3);
    for (const bool bare : {false, true}) {
      OwnLoop loop = bare ? own_loop(Bare<4>{law}, Switching::sampled, delay)
                          : own_loop(law, Switching::sampled, delay);
      loop.backlash.law = ContactLaw::none;
      auto motion = event_motion(loop, rest_of(loop));
      const auto found = find_event_orbit(motion);
      ASSERT_EQ(found.outcome, OrbitOutcome::certified);
      ASSERT_EQ(found.orbit->period_samples(), 20);
      ASSERT_EQ(found.orbit->multipliers.size(), delay > 0.0 ? 9U : 8U);
      for (std::size_t k = 0; k < found.orbit->multipliers.size(); ++k)
        EXPECT_NEAR(found.orbit->multipliers[k].log_modulus, 20.0 * expected[k],
                    bare ? 1e-6 : 1e-8 * (1.0 + std::abs(20.0 * expected[k])));
      const LyapunovResult exponents = run_event_lyapunov(motion, {40000, 2000});
      EXPECT_NEAR(exponents.exponents[0], expected[0], 3.0 / 40000.0);
      const auto verdict = classify_motion(loop, rest_of(loop));
      EXPECT_EQ(attractor_type_text(verdict.classification), "periodic(20)");
    }
  }
}

/// The filter of with_measurement_filter() made by the computer from its samples.
struct FilteredPd {
  static constexpr int states = 1;
  double rate;  // ω_f, rad/s
  double command(const ControlSample& sample, Vector<double, 1>& filtered) const {
    const double kept = std::exp(-rate * sample.elapsed);
    const double force = pd.proportional * filtered[0] +
                         pd.differential * rate * (sample.displacement - filtered[0]);
    filtered[0] = kept * filtered[0] + (1.0 - kept) * sample.displacement;
    return force;
  }
};

/// As fast as the samples follow each other it is the filter before the computer.
TEST(OwnController, AFilterInTheComputerTendsToTheOneBeforeIt) {
  const double cutoff = 30.0;
  double before = 0.0;
  for (const double period : {0.001, 0.0005, 0.00025}) {
    OwnLoop own = own_loop(FilteredPd{2.0 * pi<double> * cutoff}, Switching::exact, 0.0);
    BuiltInLoop other = test::lagging_loop(
        test::of_dynamic_order(with_measurement_filter(linear_plant(kollar2022_plant()), cutoff)),
        Switching::exact, 0.0);
    own.digital.sampling.period = other.digital.sampling.period = period;
    const auto found = find_event_orbit(event_motion(own, rest_of(own)));
    const auto known = find_event_orbit(event_motion(other, rest_of(other)));
    ASSERT_EQ(found.outcome, OrbitOutcome::certified);
    ASSERT_EQ(known.outcome, OrbitOutcome::certified);
    const double amplitude = known.orbit->largest_displacement;
    const double apart = std::abs(found.orbit->largest_displacement - amplitude) / amplitude;
    EXPECT_NEAR(found.orbit->largest_multiplier(), known.orbit->largest_multiplier(),
                20.0 * period * known.orbit->largest_multiplier());
    std::cout << "  " << period << " s: amplitudes " << apart << " apart\n";
    if (before > 0.0) {
      EXPECT_NEAR(before / apart, 2.0, 0.4);
    }
    before = apart;
  }
  EXPECT_LT(before, 0.01);
}

struct Broken {
  static constexpr int states = 0;
  double command(const ControlSample&, Vector<double, 0>&) const { return std::nan(""); }
};

TEST(OwnController, WhatIsNotAdmissibleIsRefusedByName) {
  const OwnLoop sound = own_loop(pd, Switching::exact, 0.0);
  const auto refusal = [&](const OwnLoop& loop) {
    return tests::message_of<InvalidParameter>([&] { event_motion(loop, rest_of(sound)).sense(); });
  };
  OwnLoop loop = sound;
  loop.digital.gains.differential = -1.0;
  EXPECT_NE(refusal(loop).find("gain D in addition to"), std::string::npos) << refusal(loop);
  loop = sound;
  loop.digital.limits.largest_force = 1.0;
  EXPECT_NE(refusal(loop).find("controller limits (1: set)"), std::string::npos) << refusal(loop);
  loop = sound;
  loop.plant.controller = OwnController();
  EXPECT_NE(refusal(loop).find("controller"), std::string::npos) << refusal(loop);
  EXPECT_NE(refusal(own_loop(Broken{}, Switching::exact, 0.0)).find("force"), std::string::npos);
  EXPECT_FALSE(ideal_loop(sound).has_value()) << "the paper's map knows P and D alone";
}

}  // namespace
}  // namespace holdfast
