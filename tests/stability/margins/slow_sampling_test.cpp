#include "holdfast/stability/margins/slow_sampling.hpp"

#include "holdfast/control/sampled_loop.hpp"
#include "support/dense_routes.hpp"
#include "support/lagging_plant.hpp"
#include "support/random_loop.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

/// |K (λI − A_d)⁻¹ (Γ₀ + Γ₁/λ)|
double return_ratio(const SampledLoop<double>& loop, const PdGains<double>& gains,
                    const std::complex<double>& lambda) {
  const Matrix<std::complex<double>, 4> resolvent =
      lambda * Matrix<std::complex<double>, 4>::Identity() -
      loop.transition.cast<std::complex<double>>();
  const Vector<std::complex<double>, 4> source =
      loop.present_force.cast<std::complex<double>>() +
      loop.previous_force.cast<std::complex<double>>() / lambda;
  const Eigen::VectorXcd state = test::solution_of(resolvent, source);
  return std::abs(gains.proportional * state[0] + gains.differential * state[1]);
}

TEST(SlowSampling, BoundsTheReturnRatioOutsideTheUnitCircle) {
  const auto plant = kollar2022_plant();
  const PdGains<double> gains{-557.0, -13.0};
  for (const double fraction : {0.0, 0.3, 1.0}) {
    const SlowSamplingBound bound(plant, gains, fraction);
    for (double period = 0.01; period < 10.0; period *= 1.7) {
      const auto loop = sampled_loop(plant, Sampling<double>{period, fraction * period});
      for (const double radius : {1.0, 1.2, 5.0}) {
        for (int k = 0; k <= 200; ++k) {
          const auto lambda = std::polar(radius, pi<double> * k / 200.0);
          EXPECT_LE(return_ratio(loop, gains, lambda), bound.at(period) * (1.0 + 1e-9))
              << fraction << ' ' << period << ' ' << lambda;
        }
      }
    }
  }
}

TEST(SlowSampling, NoLongerPeriodIsUnstable) {
  const auto plant = kollar2022_plant();
  for (const PdGains<double>& gains :
       {PdGains<double>{-557.0, -13.0}, {-557.0, 100.0}, {3000.0, -40.0}, {0.0, 0.0}}) {
    for (const double fraction : {0.0, 0.5, 0.9, 1.0}) {
      const double from = SlowSamplingBound(plant, gains, fraction).certain_from();
      ASSERT_TRUE(std::isfinite(from));
      for (double period = from; period < 1e3 * from; period *= 1.01) {
        const auto loop = sampled_loop(plant, Sampling<double>{period, fraction * period});
        ASSERT_LT((spectral_radius<double, 5>(loop.engaged_map(gains))), 1.0)
            << fraction << ' ' << period;
      }
    }
  }
}

TEST(SlowSampling, IsNeverCertainWithoutDamping) {
  auto plant = kollar2022_plant();
  plant.conductor_damping = plant.absorber_damping = 0.0;
  const SlowSamplingBound bound(plant, {-557.0, -13.0}, 0.0);
  EXPECT_EQ(bound.certain_from(), std::numeric_limits<double>::infinity());
  for (double period = 1e-4; period < 10.0; period *= 3.0)
    EXPECT_EQ(bound.at(period), std::numeric_limits<double>::infinity()) << period;
}

TEST(SlowSampling, OfAnyOrderIsThatOfTheResolventPolynomials) {
  test::Random random(20264);
  for (int draw = 0; draw < 50; ++draw) {
    const TwoMass<double> plant = test::random_plant(random);
    const PdGains<double> gains = test::random_gains(plant, 0.01, random);
    const SlowSamplingBound closed(plant, gains, 0.3),
        general(test::through_ports(plant), gains, 0.3);
    for (const double period : {0.01, 0.3, 2.0}) {
      if (!std::isfinite(closed.at(period))) continue;
      EXPECT_NEAR(general.at(period), closed.at(period), 1e-6 * closed.at(period) + 1e-14) << draw;
    }
  }
}
}  // namespace
}  // namespace holdfast
