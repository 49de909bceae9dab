#include "holdfast/motion/batch/two_mass_series.hpp"

#include "holdfast/contact/mode_dynamics.hpp"
#include "holdfast/motion/taylor_step.hpp"
#include "support/random.hpp"
#include "support/random_loop.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

TEST(TwoMassSeries, IsThatOfTaylorStep) {
  test::Random random(31);
  for (int trial = 0; trial < 500; ++trial) {
    const TwoMass<double> plant = test::random_plant(random);
    const AffineDynamics dynamics = engaged_dynamics(plant);
    const double rate = balanced_norm(dynamics.state), length = random.unit() / rate;
    const Vector<double, 4> z = random.matrix<Vector<double, 4>>();
    const double command = random.uniform(-1.0, 1.0), omega = rate * random.unit();
    const double cosine = random.uniform(-1.0, 1.0), sine = random.uniform(-1.0, 1.0);

    const auto terms = LaneTerms<double>()(rate * length);
    EXPECT_LE(std::abs(terms.most - terms_for(rate * length)), 1);
    const auto row = [&](Eigen::Index i) {
      return LaneAcceleration<double>{
          {dynamics.state(i, 0), dynamics.state(i, 1), dynamics.state(i, 2), dynamics.state(i, 3)},
          dynamics.command[i] * command,
          dynamics.force[i]};
    };
    const TwoMassSeries<double> series({row(1), row(3)}, {z[0], z[1], z[2], z[3]},
                                       {{omega, {cosine, sine}}}, length, terms);
    Series force(terms.most);
    std::complex<double> turning(cosine, sine);
    double factorial = 1.0;
    for (Eigen::Index k = 0; k < force.size(); ++k) {
      force[k] = turning.real() / factorial;
      turning *= std::complex<double>(0.0, omega * length);
      factorial *= static_cast<double>(k + 1);
      EXPECT_NEAR(series.force[static_cast<std::size_t>(k)], force[k], 1e-15);
    }
    const TaylorStep<4> step(dynamics, z, command, force, length);
    for (const double x : {0.0, 0.3, 1.0}) {
      const std::array<double, 4> there = series.state_at(x);
      for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(there[i], series.value(series.state[i], x));
        const double size = step.coefficients().row(static_cast<Eigen::Index>(i)).cwiseAbs().sum();
        EXPECT_NEAR(series.value(series.state[i], x), step.state(x)[static_cast<Eigen::Index>(i)],
                    1e-14 * size);
      }
    }
  }
}

TEST(TwoMassSeries, HasAsManyTermsAsItsLengthAsksFor) {
  const LaneTerms<double> terms;
  EXPECT_EQ(terms(0.0).most, 1);
  EXPECT_EQ(terms(1.0).most, most_terms);
  EXPECT_EQ(terms(std::numeric_limits<double>::quiet_NaN()).most, 1);
  for (double turns = 1e-6; turns < 1.0; turns *= 1.003)
    EXPECT_EQ(terms(turns).most, terms_for(turns)) << turns;
}

}  // namespace
}  // namespace holdfast
