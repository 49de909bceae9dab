#include "holdfast/stability/margins/margins.hpp"

#include "holdfast/control/loop_map.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/math/linalg/spectral_radius.hpp"
#include "holdfast/stability/margins/slow_sampling.hpp"
#include "holdfast/stability/response/loop_response.hpp"

#include "support/dense_routes.hpp"
#include "support/lagging_plant.hpp"
#include "support/random_loop.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

struct LoopCase {
  Sampling<double> sampling;
  PdGains<double> gains;
};

const LoopCase loop_cases[] = {{{0.001, 0.0}, {-557.0, -13.0}},
                               {{0.010, 0.0}, {-557.0, -6.0}},
                               {{0.010, 0.004}, {-557.0, -13.0}},
                               {{0.003, 0.003}, {-200.0, 1.0}},
                               {{0.050, 0.0}, {-20.0, -1.0}}};

double radius_of_map(const Sampling<double>& sampling, const PdGains<double>& gains) {
  return spectral_radius(loop_map(kollar2022_plant(), sampling).closed_map(gains));
}

TEST(LoopMargins, OfTheGainEndWhereTheSpectralRadiusIsOne) {
  for (const LoopCase& c : loop_cases) {
    const double p = c.gains.proportional, d = c.gains.differential;
    const LoopMargins margins = loop_margins(kollar2022_plant(), c.sampling, c.gains);
    ASSERT_EQ(margins.outcome, MarginOutcome::stable);
    EXPECT_NEAR(1.0 - margins.unit_circle, radius_of_map(c.sampling, c.gains), 1e-9);
    ASSERT_GT(margins.largest_factor, 1.0);
    ASSERT_LT(margins.least_factor, 1.0);
    for (const double factor : {margins.largest_factor, margins.least_factor}) {
      const auto at = [&](double share) {
        const double moved = 1.0 + share * (factor - 1.0);
        return radius_of_map(c.sampling, {moved * p, moved * d});
      };
      for (int k = 0; k < 200; ++k) EXPECT_LT(at(k / 200.0), 1.0) << factor << ' ' << k;
      EXPECT_GT(at(1.0 + 1e-5), 1.0) << factor;
    }
  }
}

/// Against a dense scan of L over the circle by the loop's transfer functions.
TEST(LoopMargins, OfThePhaseAreThoseOfADenseScan) {
  for (const LoopCase& c : loop_cases) {
    const LoopMargins margins = loop_margins(kollar2022_plant(), c.sampling, c.gains);
    const LoopResponse<double> response(loop_map(kollar2022_plant(), c.sampling));
    double least = std::numeric_limits<double>::infinity();
    std::complex<double> before = 0.0;
    constexpr int steps = 40000;
    for (int k = 1; k <= steps; ++k) {
      const auto at = response.at_angle(pi<double> * k / steps);
      const std::complex<double> loop =
          c.gains.proportional * at.displacement + c.gains.differential * at.velocity;
      const double was = std::abs(before), is = std::abs(loop);
      if (k > 1 && (was < 1.0) != (is < 1.0))
        least = std::min(least,
                         std::abs(std::arg(before + (1.0 - was) / (is - was) * (loop - before))));
      before = loop;
    }
    if (std::isinf(least)) {
      EXPECT_TRUE(std::isinf(margins.phase));
      continue;
    }
    EXPECT_NEAR(margins.phase, least, 2e-3);
  }
}

TEST(LoopMargins, OfTheDelayAreThoseOfTheDelayAlone) {
  for (const LoopCase& c : loop_cases) {
    const MarginEnd delay = loop_margins(kollar2022_plant(), c.sampling, c.gains).delay;
    const MarginEnd alone =
        stability_margins(kollar2022_plant(), c.sampling, c.gains).processing_delay.above;
    EXPECT_EQ(delay.outcome, alone.outcome);
    EXPECT_EQ(delay.position, alone.position);
  }
}

TEST(LoopMargins, OfAnUnstableLoopAreNone) {
  const LoopMargins margins = loop_margins(kollar2022_plant(), {0.05}, {-557.0, -13.0});
  EXPECT_EQ(margins.outcome, MarginOutcome::not_stable);
  EXPECT_LT(margins.unit_circle, 0.0);
  EXPECT_TRUE(std::isnan(margins.largest_factor));
  EXPECT_TRUE(std::isnan(margins.phase));
  EXPECT_EQ(margins.delay.outcome, MarginEndOutcome::undefined);
}

TEST(LoopMargins, RefuseWhatIsNoLoop) {
  EXPECT_THROW(loop_margins(kollar2022_plant(), {0.0}, {-557.0, -13.0}), InvalidParameter);
  EXPECT_THROW(loop_margins(kollar2022_plant(), {0.001}, {-557.0, INFINITY}), InvalidParameter);
}

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
