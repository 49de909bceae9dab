#include "arb/arb_plant.hpp"
#include "holdfast/stability/chart/proved_modal_chart.hpp"
#include "holdfast/stability/response/enclosed_response.hpp"
#include "support/random.hpp"

namespace holdfast::test {
namespace {

/// A conductor all of whose numbers, and those of its state matrix, are short binary fractions: the
/// matrix of doubles is exactly that of the modes.
ConductorWithAbsorber binary_conductor(int modes, double clamp_mass = 0.0) {
  ConductorWithAbsorber conductor{{}, {0.125, 64.0, 2.0, clamp_mass}, {}};
  for (int n = 1; n <= modes; ++n)
    conductor.modes.push_back(
        {12.0 * n, n % 3 == 0 ? 0.0078125 : 0.03125, n % 2 == 0 ? 0.25 : 0.5 + 0.125 * n, 0.5});
  conductor.poles = plant_poles(conductor.modes, conductor.absorber);
  return conductor;
}

TEST(ComplexEnclosure, ExponentialsHoldThoseOfArb) {
  Random random(1);
  for (int trial = 0; trial < 500; ++trial) {
    const std::complex<double> z =
        std::polar(random.log_uniform(1e-5, 60.0), random.uniform(0.0, 6.28));
    EXPECT_TRUE(exponential(z).is_in(exponential(ComplexEnclosure(z, 0.0)))) << z;
    const std::complex<double> w = z + std::polar(0.999e-3, random.uniform(0.0, 6.28));
    EXPECT_TRUE(exponential(w).is_in(exponential(ComplexEnclosure(z, 1e-3)))) << z;
  }
}

/// The discs of the poles hold the eigenvalues of the state matrix, which Arb isolates.
TEST(EnclosedPoles, HoldTheEigenvaluesThatArbFinds) {
  for (const int modes : {1, 3, 6}) {
    const ConductorWithAbsorber conductor = binary_conductor(modes);
    const LinearPlant<double> plant = linear_plant(conductor);
    const slong order = plant.order();
    BallMatrix matrix(order);
    for (slong i = 0; i < order; ++i)
      for (slong j = 0; j < order; ++j) matrix.set(i, j, Ball(plant.state_matrix()(i, j)));
    const auto roots = roots_of(matrix.characteristic_polynomial(0.0));
    ASSERT_EQ(roots.size(), static_cast<std::size_t>(order));
    const auto poles = enclosed_poles(conductor);
    ASSERT_FALSE(poles.empty());
    for (const EnclosedPole& pole : poles) {
      int inside = 0;
      for (const ComplexBall& root : roots) inside += root.is_in(pole.s) ? 1 : 0;
      EXPECT_EQ(inside, 1);
      EXPECT_LT(pole.s.radius(), 1e-11 * pole.s.magnitude());
    }
  }
}

/// F_z and F_v hold what Arb finds from the exponential of the state matrix and a linear system.
TEST(EnclosedResponse, HoldsThatOfArb) {
  Random random(2);
  for (const int modes : {1, 4, 8}) {
    const ConductorWithAbsorber conductor = binary_conductor(modes);
    const LinearPlant<double> plant = linear_plant(conductor);
    const auto poles = enclosed_poles(conductor);
    for (const double late : {0.0, 0.0009765625, 0.00390625}) {
      const double tau = 0.00390625;
      const SampledBalls balls(plant, tau, late);
      for (const int more : {0, 2}) {
        if (late == 0.0 && more > 0) continue;  // whole samples are a delay of τ beyond fewer
        const EnclosedResponse response(poles, {tau, late + more * tau});
        for (int trial = 0; trial < 10; ++trial) {
          const std::complex<double> lambda =
              std::polar(random.uniform(0.99, 1.1), random.uniform(0.0, 3.14));
          const auto f = response.about(ComplexEnclosure(lambda, 0.0), 0.0);
          const auto z = balls.response(plant.ports().measured_displacement, lambda);
          const auto v = balls.response(plant.ports().measured_velocity, lambda);
          EXPECT_TRUE(z.is_in(f.displacement.value)) << lambda;
          EXPECT_TRUE(v.is_in(f.velocity.value)) << lambda;
        }
      }
    }
  }
}

/// The closed map of a loop whose delay is no more than a sample, as Arb has it.
BallMatrix closed_map(const SampledBalls& balls, const LinearPlant<double>& plant,
                      const PdGains<double>& gains) {
  const slong n = balls.order();
  const auto& ports = plant.ports();
  BallMatrix map(n + 1);
  for (slong j = 0; j < n; ++j) {
    const Ball gain = Ball(gains.proportional) * Ball(ports.measured_displacement[j]) +
                      Ball(gains.differential) * Ball(ports.measured_velocity[j]);
    for (slong i = 0; i < n; ++i)
      map.set(i, j, balls.map().at(i, j) + balls.map().at(i, n + 1) * gain);
    map.set(n, j, gain);
  }
  for (slong i = 0; i < n; ++i) map.set(i, n, balls.map().at(i, n));
  return map;
}

/// Random gains, corners too, in random boxes of proved charts: the roots that Arb isolates agree.
TEST(ProvedModalChart, IsNotContradictedByArb) {
  Random random(3);
  for (const double late : {0.0, 0.0009765625}) {
    const ConductorWithAbsorber conductor = binary_conductor(5);
    const LinearPlant<double> plant = linear_plant(conductor);
    const double tau = 0.00390625;
    const SampledBalls balls(plant, tau, late);
    const ProvedChart chart = proved_chart({enclosed_poles(conductor), {tau, late}},
                                           {{-300.0, 300.0, 5}, {-10.0, 10.0, 5}}, 3e-3, [] {});
    std::array<int, 3> asked{};
    for (int trial = 0; trial < 400; ++trial) {
      const auto& [box, stability] = chart.boxes[random.index(chart.boxes.size())];
      const PdGains<double> gains{
          random.index(2) == 0 ? box.proportional_from : box.proportional_to,
          box.differential_from + random.unit() * (box.differential_to - box.differential_from)};
      const auto roots =
          count_roots(closed_map(balls, plant, gains).characteristic_polynomial(0.0));
      ++asked.at(static_cast<std::size_t>(stability));
      if (stability == ProvedStability::stable) {
        EXPECT_EQ(roots.outside, 0) << gains.proportional << " " << gains.differential;
      }
      if (stability == ProvedStability::unstable) {
        EXPECT_GT(roots.outside, 0) << gains.proportional << " " << gains.differential;
      }
    }
    EXPECT_GT(asked[0], 50);
    EXPECT_GT(asked[1], 50);
  }
}

}  // namespace
}  // namespace holdfast::test
