#include "holdfast/stability/response/response.hpp"
#include "holdfast/control/loop_input.hpp"

#include "holdfast/motion/sampled_motion.hpp"
#include "holdfast/stability/boundary/stable_intervals.hpp"
#include "support/dense_routes.hpp"
#include "support/lagging_plant.hpp"
#include "support/random_loop.hpp"

namespace holdfast {
namespace {

using Complex = std::complex<double>;

constexpr double frequency = 10.0, omega = 2.0 * pi<double> * frequency;

SteadyResponse<double> held_response(const SampledLoop<double>& loop,
                                     double angular_frequency = omega) {
  return {loop, held_harmonic(loop), angular_frequency};
}

/// Amplitude of z₁ at the forcing frequency by least squares, after a transient of 7000 samples.
double simulated_amplitude(const SampledLoop<double>& loop, const HarmonicInput<double>& input,
                           const PdGains<double>& gains, const HarmonicExcitation<double>& force) {
  SampledMotion<double> motion(loop, gains, input, force, Backlash<double>(0.0),
                               Vector<double, 4>::Zero());
  Matrix<double, 2> normal = Matrix<double, 2>::Zero();
  Vector<double, 2> right = Vector<double, 2>::Zero();
  for (int j = 0; j < 10000; ++j) {
    const double z1 = motion.sense().state[0];
    const double phase = force.angular_frequency() * motion.time();
    motion.advance();
    if (j < 7000) continue;
    const Vector<double, 2> basis(std::cos(phase), std::sin(phase));
    normal += basis * basis.transpose();
    right += basis * z1;
  }
  return (normal.inverse() * right).norm();
}

TEST(SteadyResponse, IsTheAmplitudeOfTheSimulatedMotion) {
  const auto plant = kollar2022_plant();
  for (const double f : {10.0 / std::sqrt(2.0), 3.0 * std::sqrt(2.0), 17.3}) {
    for (const double fraction : {0.0, 0.3, 1.0}) {
      const auto loop = sampled_loop(plant, Sampling<double>{0.004, 0.004 * fraction});
      const HarmonicExcitation<double> force{0.5, f};
      const double w = force.angular_frequency();
      const PdGains<double> gains{-300.0, -8.0};
      for (const auto& input : {held_harmonic(loop), exact_harmonic(plant, 0.004, w)}) {
        const SteadyResponse<double> response(loop, input, w);
        const double expected = 0.5 * response.amplitude_per_force(gains);
        EXPECT_NEAR(simulated_amplitude(loop, input, gains, force), expected, 1e-9 * expected)
            << f << ' ' << fraction;
        EXPECT_NEAR(simulated_amplitude(loop, input, {0, 0}, force),
                    0.5 * response.uncontrolled_amplitude_per_force(), 1e-9 * expected);
      }
    }
  }
}

TEST(SteadyResponse, NoGainsLeaveTheUncontrolledAmplitude) {
  const auto response = held_response(sampled_loop(kollar2022_plant(), Sampling<double>{0.01}));
  EXPECT_EQ(response.ratio_to_uncontrolled({0.0, 0.0}), 1.0);
}

TEST(BestDifferentialGain, NoGainOfItsIntervalsIsBetter) {
  test::Random random(231);
  int compared = 0, in_the_middle = 0;
  for (int draw = 0; draw < 500; ++draw) {
    const auto plant = test::random_plant(random);
    const auto sampling = test::random_sampling(plant, random);
    const auto loop = sampled_loop(plant, sampling);
    const double p = test::random_gains(plant, sampling.period, random).proportional;
    const auto intervals = stable_differential_gains(characteristic_polynomial(loop), p);
    if (intervals.empty()) continue;
    const auto response = held_response(loop, random.uniform(0.02, 3.0) / sampling.period);
    const auto best = response.best_differential_gain(p, intervals);
    ASSERT_TRUE(std::isfinite(best.differential_gain));
    EXPECT_DOUBLE_EQ(response.ratio_to_uncontrolled({p, best.differential_gain}),
                     best.ratio_to_uncontrolled);
    for (const auto& interval : intervals) {
      if (!std::isfinite(interval.lower) || !std::isfinite(interval.upper)) continue;
      in_the_middle += interval.contains(best.differential_gain) ? 1 : 0;
      for (double share = 0.0; share <= 1.0; share += 1.0 / 128) {
        const double d = interval.lower + share * (interval.upper - interval.lower);
        ++compared;
        EXPECT_GE(response.ratio_to_uncontrolled({p, d}), best.ratio_to_uncontrolled * (1 - 1e-12));
      }
    }
  }
  EXPECT_GT(compared, 1000);
  EXPECT_GT(in_the_middle, 20) << "some optima must be stationary points, not ends";
}

TEST(BestDifferentialGain, AStationaryGainHasOnlyWorseNeighbours) {
  const auto response = held_response(sampled_loop(kollar2022_plant(), Sampling<double>{0.01}));
  int stationary = 0;
  for (double p = -900.0; p <= 300.0; p += 25.0) {
    const auto best = response.best_differential_gain(p, {{-1e3, 1e3}});
    if (std::abs(best.differential_gain) >= 1e3) continue;
    ++stationary;
    for (const double step : {-1e-3, 1e-3}) {
      const double neighbour = best.differential_gain * (1.0 + step);
      EXPECT_GT(response.ratio_to_uncontrolled({p, neighbour}), best.ratio_to_uncontrolled);
    }
  }
  EXPECT_GT(stationary, 5);
}

TEST(BestDifferentialGain, OfNoIntervalIsNone) {
  const auto best = held_response(sampled_loop(kollar2022_plant(), Sampling<double>{0.01}))
                        .best_differential_gain(-557.0, {});
  EXPECT_TRUE(std::isnan(best.differential_gain));
  EXPECT_EQ(best.ratio_to_uncontrolled, std::numeric_limits<double>::infinity());
}

/// Against (iωI − A) x = c of the plant itself.
TEST(SteadyResponse, WithoutAComputerIsThatOfThePlant) {
  const auto plant = kollar2022_plant();
  for (const double hertz : {1e-6, 1.0, 2.0, 7.0, 10.0, 1e4, 1e6}) {
    const double radians = 2.0 * pi<double> * hertz;
    Eigen::Matrix4cd system = -plant.state_matrix().cast<std::complex<double>>();
    system.diagonal().array() += std::complex<double>(0.0, radians);
    const Eigen::Vector4cd x =
        system.fullPivLu().solve(plant.excitation_input().cast<std::complex<double>>());
    EXPECT_NEAR(true_amplitude_per_force(plant, radians) / std::abs(x[0]), 1.0, 1e-9) << hertz;
    if (hertz != 10.0) continue;
    for (const double period : {0.001, 0.01, 0.03})
      EXPECT_NEAR(steady_response(plant, {period}, ForceHold::exact, radians)
                          .uncontrolled_amplitude_per_force() /
                      std::abs(x[0]),
                  1.0, 1e-12)
          << period;
    // A fast computer holds the force as it is; a slow one's ratios can be told by the true one.
    const auto slow = steady_response(plant, {0.03}, ForceHold::sampled, radians);
    const PdGains<double> gains{-10.0, 0.5};
    EXPECT_NEAR(slow.relative_to(std::abs(x[0])).ratio_to_uncontrolled(gains) * std::abs(x[0]),
                slow.amplitude_per_force(gains), 1e-9 * slow.amplitude_per_force(gains));
  }
}

/// |z| per newton of a loop, by a dense solution of (λI − S) y = g.
template <class Plant>
double dense_amplitude(const Plant& plant, const Sampling<double>& sampling,
                       const PdGains<double>& gains, ForceHold hold, double omega) {
  const LoopMap<double> map = loop_map(plant, sampling);
  const auto input = harmonic_input(plant, map, hold, omega);
  Eigen::MatrixXcd matrix = -map.closed_map(gains).template cast<Complex>();
  matrix.diagonal().array() += std::polar(1.0, omega * sampling.period);
  const Eigen::VectorXcd source =
      input.cosine.template cast<Complex>() - Complex(0, 1) * input.sine.template cast<Complex>();
  const Eigen::VectorXcd solution = test::solution_of(matrix, source);
  return std::abs((map.conductor.template cast<Complex>() * solution).value());
}

TEST(AnyOrderResponse, AmplitudeIsThatOfTheClosedMap) {
  struct Case {
    double filter, drive;
    Sampling<double> sampling;
    PdGains<double> gains;
  };
  for (const Case& c : {Case{200.0, 300.0, {0.001, 0.0}, {-100.0, -5.0}},
                        {100.0, 150.0, {0.002, 0.001}, {-50.0, -3.0}},
                        {200.0, 300.0, {0.001, 0.0025}, {-60.0, -4.0}},
                        {200.0, 300.0, {0.0005, 0.0031}, {-60.0, -5.5}},
                        {30.0, 60.0, {0.01, 0.0}, {-20.0, -1.0}}}) {
    const LinearPlant<double> plant = test::lagging_plant(c.filter, c.drive);
    for (const ForceHold hold : {ForceHold::sampled, ForceHold::exact}) {
      for (const double frequency : {0.5, 8.0, 30.0}) {
        const double omega = 2.0 * pi<double> * frequency;
        const auto response = steady_response(plant, c.sampling, hold, omega);
        const double expected = dense_amplitude(plant, c.sampling, c.gains, hold, omega);
        EXPECT_NEAR(response.amplitude_per_force(c.gains), expected, 1e-9 * expected);
        const double free = dense_amplitude(plant, c.sampling, {0.0, 0.0}, hold, omega);
        EXPECT_NEAR(response.uncontrolled_amplitude_per_force(), free, 1e-9 * free);
        EXPECT_NEAR(response.squared_ratio(c.gains.proportional).at(c.gains.differential),
                    expected * expected / (free * free),
                    1e-8 * expected * expected / (free * free));
      }
    }
  }
}

TEST(AnyOrderResponse, ADelayOfTwoMassesBeyondASampleIsThatOfTheirMap) {
  const TwoMass<double> plant = kollar2022_plant();
  const Sampling<double> late{0.002, 0.0051};
  const PdGains<double> gains{-50.0, -3.0};
  const double omega = 2.0 * pi<double> * 10.0;
  const double expected = dense_amplitude(plant, late, gains, ForceHold::exact, omega);
  EXPECT_NEAR(steady_response(plant, late, ForceHold::exact, omega).amplitude_per_force(gains),
              expected, 1e-10 * expected);
}

}  // namespace
}  // namespace holdfast
