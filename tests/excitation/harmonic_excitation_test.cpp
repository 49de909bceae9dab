#include "holdfast/excitation/harmonic_excitation.hpp"
#include "support/reference/sample_excitation.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

TEST(Excitation, IsTheCosineAndSineOfItsPhase) {
  const HarmonicExcitation<double> force{0.5, 10.0};
  for (int j = 0; j < 500; ++j) {
    const auto sample = sample_excitation(force, 0.003, j);
    const double phase = 2.0 * pi<double> * 10.0 * 0.003 * j;
    EXPECT_NEAR(sample.cosine, 0.5 * std::cos(phase), 1e-13);
    EXPECT_NEAR(sample.sine, 0.5 * std::sin(phase), 1e-13);
  }
}

TEST(Excitation, StartsAtItsAmplitude) {
  const auto sample = sample_excitation(HarmonicExcitation<double>{0.5, 10.0}, 0.001, 0);
  EXPECT_EQ(sample.cosine, 0.5);
  EXPECT_EQ(sample.sine, 0.0);
}

TEST(Excitation, KeepsItsPhaseAfterBillionsOfSamples) {
  // 1 / 64 s and 16 Hz are exact in binary: every fourth sample closes a cycle, however late.
  const HarmonicExcitation<double> force{2.0, 16.0};
  const std::int64_t late = std::int64_t{1} << 48;
  EXPECT_EQ(sample_excitation(force, 1.0 / 64.0, late).cosine, 2.0);
  EXPECT_NEAR(sample_excitation(force, 1.0 / 64.0, late + 1).sine, 2.0, 1e-15);
  EXPECT_NEAR(sample_excitation(force, 1.0 / 64.0, late + 2).cosine, -2.0, 1e-15);
}

TEST(Excitation, ItsAngularFrequencyIsThatOfAFullTurnPerCycle) {
  EXPECT_DOUBLE_EQ((HarmonicExcitation<double>{1.0, 10.0}.angular_frequency()),
                   20.0 * std::acos(-1.0));
}

TEST(Excitation, WhatIsOutOfRangeIsRefused) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
  for (const double amplitude : {-0.1, infinity, not_a_number}) {
    EXPECT_THROW(validate(HarmonicExcitation<double>{amplitude, 10.0}), InvalidParameter)
        << amplitude;
  }
  for (const double frequency : {0.0, -1.0, infinity, not_a_number}) {
    EXPECT_THROW(validate(HarmonicExcitation<double>{0.5, frequency}), InvalidParameter)
        << frequency;
  }
  EXPECT_NO_THROW(validate(HarmonicExcitation<double>{0.0, 10.0}));
}

}  // namespace
}  // namespace holdfast
