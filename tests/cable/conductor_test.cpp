#include "holdfast/cable/conductor.hpp"

#include "support/message_of.hpp"
#include "support/random.hpp"

namespace holdfast {
namespace {

Conductor<double> random_conductor(test::Random& random) {
  const double span = random.log_uniform(1.0, 1000.0);
  return {random.log_uniform(0.01, 100.0),
          span,
          span * random.log_uniform(0.001, 0.12),
          random.log_uniform(1e-6, 1e-2),
          random.log_uniform(1e9, 2e11),
          random.uniform(0.0, 0.1),
          random.uniform(1.0, 10.0)};
}

/// ∫ (ds/dx)³ dx / L of the parabola of that sag ratio, by Simpson's rule.
double parabola_stretch(double ratio) {
  constexpr int intervals = 2000;
  double sum = 0.0;
  for (int k = 0; k <= intervals; ++k) {
    const double slope = 4.0 * ratio * (1.0 - 2.0 * k / intervals);
    const double weight = k == 0 || k == intervals ? 1.0 : (k % 2 == 1 ? 4.0 : 2.0);
    sum += weight * std::pow(1.0 + slope * slope, 1.5);
  }
  return sum / (3.0 * intervals);
}

double effective_length_miss(double ratio) {
  Conductor<double> conductor = kollar2022_conductor();
  conductor.sag = ratio * conductor.span;
  return std::abs(parabola_stretch(ratio) - conductor.effective_length() / conductor.span);
}

std::string refusal_of(const Conductor<double>& conductor) {
  return tests::message_of<InvalidParameter>([&] { validate(conductor); });
}

TEST(Conductor, HalfOfTheParabolaIsInMomentEquilibrium) {
  test::Random random(301);
  for (int draw = 0; draw < 200; ++draw) {
    const auto conductor = random_conductor(random);
    const double moment = conductor.weight() / 2 * conductor.span / 4;
    EXPECT_NEAR(conductor.parabolic_tension() * conductor.sag / moment, 1.0, 1e-14);
  }
}

TEST(Conductor, IrvinesParameterIsTheRatioOfElasticToGeometricCompliance) {
  test::Random random(302);
  for (int draw = 0; draw < 200; ++draw) {
    const auto c = random_conductor(random);
    // (μgL/H)² L EA/(H L_e) with H = μgL²/(8f)
    const double ratio = c.sag / c.span;
    const double expected = 512.0 * ratio * ratio * ratio * c.youngs_modulus * c.area /
                            (c.mass_per_length * c.gravity * c.span) / (1.0 + 8.0 * ratio * ratio);
    EXPECT_NEAR(c.irvine_parameter() / expected, 1.0, 1e-13);
  }
}

TEST(Conductor, TheEffectiveLengthIsThatOfTheParabolaUpToTheFourthPowerOfTheSagRatio) {
  for (const double ratio : {0.08, 0.04, 0.02}) {
    const double order = std::log2(effective_length_miss(ratio) / effective_length_miss(ratio / 2));
    EXPECT_NEAR(order, 4.0, 0.1) << ratio;
  }
}

TEST(Conductor, TheWaveTravelsTheSpanTwiceInThePeriodOfTheTautString) {
  test::Random random(303);
  for (int draw = 0; draw < 50; ++draw) {
    const auto c = random_conductor(random);
    const double speed = c.transverse_wave_speed();
    EXPECT_NEAR(speed * speed * c.mass_per_length / c.parabolic_tension(), 1.0, 1e-14);
  }
}

TEST(Conductor, AdmitsThePapersAndRandomOnes) {
  test::Random random(304);
  EXPECT_NO_THROW(validate(kollar2022_conductor()));
  for (int draw = 0; draw < 50; ++draw) EXPECT_NO_THROW(validate(random_conductor(random)));
}

TEST(Conductor, RefusesEveryMemberOutsideItsRange) {
  struct Member {
    double Conductor<double>::*value;
    const char* name;
  };
  const Member members[] = {{&Conductor<double>::mass_per_length, "mass per length mu"},
                            {&Conductor<double>::span, "span L"},
                            {&Conductor<double>::sag, "sag f"},
                            {&Conductor<double>::area, "area"},
                            {&Conductor<double>::youngs_modulus, "Young's modulus E"},
                            {&Conductor<double>::gravity, "gravity g"},
                            {&Conductor<double>::damping_ratio, "damping ratio zeta"}};
  for (const auto& member : members) {
    for (const double value : {-1.0, std::numeric_limits<double>::quiet_NaN(),
                               std::numeric_limits<double>::infinity()}) {
      auto conductor = kollar2022_conductor();
      conductor.*member.value = value;
      EXPECT_EQ(refusal_of(conductor).rfind(member.name, 0), 0U) << refusal_of(conductor);
    }
  }
}

TEST(Conductor, RefusesZeroWhereNothingWouldHang) {
  for (double Conductor<double>::*member :
       {&Conductor<double>::mass_per_length, &Conductor<double>::sag, &Conductor<double>::area,
        &Conductor<double>::youngs_modulus, &Conductor<double>::gravity}) {
    auto conductor = kollar2022_conductor();
    conductor.*member = 0.0;
    EXPECT_THROW(validate(conductor), InvalidParameter);
  }
}

TEST(Conductor, AdmitsNoSagOfHalfTheSpanAndNoCriticalDamping) {
  auto conductor = kollar2022_conductor();
  conductor.sag = 0.499 * conductor.span;
  EXPECT_NO_THROW(validate(conductor));
  conductor.sag = 0.5 * conductor.span;
  EXPECT_NE(refusal_of(conductor).find("below half the span"), std::string::npos);
  conductor = kollar2022_conductor();
  conductor.damping_ratio = 0.0;
  EXPECT_NO_THROW(validate(conductor));
  conductor.damping_ratio = 1.0;
  EXPECT_THROW(validate(conductor), InvalidParameter);
}

TEST(Conductor, APositionLiesStrictlyInsideTheSpan) {
  EXPECT_NO_THROW(require_inside_span(0.64, 6.4));
  for (const double place : {0.0, 6.4, -1.0, 7.0, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(require_inside_span(place, 6.4), InvalidParameter) << place;
}

}  // namespace
}  // namespace holdfast
