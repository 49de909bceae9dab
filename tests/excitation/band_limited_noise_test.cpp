#include "holdfast/excitation/band_limited_noise.hpp"

#include "support/message_of.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

double noise_at(const std::vector<Harmonic>& harmonics, double time) {
  double force = 0.0;
  for (const Harmonic& harmonic : harmonics) force += harmonic.at(time);
  return force;
}

/// 8 lines at 2, 2.5, …, 5.5 Hz: f_a T + ½ = 4 is whole, the period is T = 2 s.
constexpr NoiseBand periodic_band{0.7, 1.75, 5.75, 8, 3};
constexpr double periodic_band_period = 2.0;
/// Equally spaced instants of a period; sums over them are orthogonal below half as many cycles.
constexpr int instants_of_a_period = 128;

std::vector<double> noise_over_a_period() {
  const auto harmonics = band_limited_noise(periodic_band);
  std::vector<double> forces;
  for (int j = 0; j < instants_of_a_period; ++j) {
    forces.push_back(noise_at(harmonics, periodic_band_period * j / instants_of_a_period));
  }
  return forces;
}

TEST(BandLimitedNoise, ItsLinesAreEquallyStrongInTheMiddleOfEqualParts) {
  const NoiseBand band{0.5, 3.0, 13.0, 40, 1};
  const auto harmonics = band_limited_noise(band);
  ASSERT_EQ(harmonics.size(), 40U);
  for (std::size_t line = 0; line < harmonics.size(); ++line) {
    EXPECT_DOUBLE_EQ(harmonics[line].frequency, 3.125 + 0.25 * static_cast<double>(line));
    EXPECT_DOUBLE_EQ(harmonics[line].amplitude, 0.5 * std::sqrt(0.05));
    EXPECT_GE(harmonics[line].phase, 0.0);
    EXPECT_LT(harmonics[line].phase, 2.0 * pi<double>);
    EXPECT_NO_THROW(validate(harmonics[line]));
  }
}

TEST(BandLimitedNoise, ItsSpectrumIsFlatInTheBandAndZeroOutside) {
  const auto forces = noise_over_a_period();
  for (int cycles = 0; cycles < instants_of_a_period / 2; ++cycles) {
    std::complex<double> projection = 0.0;
    for (int j = 0; j < instants_of_a_period; ++j) {
      const double turns = static_cast<double>((cycles * j) % instants_of_a_period);
      projection +=
          forces[static_cast<std::size_t>(j)] *
          std::polar(2.0 / instants_of_a_period, -2.0 * pi<double> * turns / instants_of_a_period);
    }
    const double frequency = cycles / periodic_band_period;
    const bool inside = frequency > periodic_band.lowest && frequency < periodic_band.highest;
    const double amplitude = inside ? periodic_band.rms * std::sqrt(2.0 / 8.0) : 0.0;
    EXPECT_NEAR(std::abs(projection), amplitude, 1e-14) << frequency << " Hz";
  }
}

TEST(BandLimitedNoise, SameSeedSamePhasesOtherSeedOtherPhases) {
  std::set<double> phases;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto first = band_limited_noise({1.0, 1.0, 50.0, 200, seed});
    const auto again = band_limited_noise({1.0, 1.0, 50.0, 200, seed});
    for (std::size_t line = 0; line < first.size(); ++line) {
      ASSERT_EQ(first[line].phase, again[line].phase);
      phases.insert(first[line].phase);
    }
  }
  EXPECT_EQ(phases.size(), 20U * 200U) << "no phase occurs twice";
}

TEST(BandLimitedNoise, ItsPhasesAreThoseOfTheStandardsEngine) {
  // ISO C++ [rand.predef]: output 10 000 of a mt19937_64 of the seed 5489.
  constexpr std::uint64_t published = 9981545732273789042U;
  const auto harmonics = band_limited_noise({1.0, 1.0, 50.0, 10000, 5489});
  const double cycles = static_cast<double>(published >> 11U) * 0x1.0p-53;
  EXPECT_DOUBLE_EQ(harmonics.back().phase, 2.0 * pi<double> * cycles);
}

TEST(BandLimitedNoise, WithoutStrengthItIsSilent) {
  const auto harmonics = band_limited_noise({0.0, 0.0, 50.0});
  EXPECT_EQ(harmonics.size(), 1000U);
  EXPECT_EQ(noise_at(harmonics, 0.37), 0.0);
}

std::string refused_noise(const NoiseBand& band) {
  return tests::refused_name([&] { band_limited_noise(band); });
}

TEST(BandLimitedNoise, WhatIsOutOfRangeIsRefusedByName) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refused_noise({1.0, 1.0, 50.0}), "");
  for (const double wrong : {-0.1, infinity, not_a_number}) {
    EXPECT_EQ(refused_noise({wrong, 1.0, 50.0}), "noise rms") << wrong;
    EXPECT_EQ(refused_noise({1.0, wrong, 50.0}), "noise lowest frequency") << wrong;
  }
  for (const double wrong : {-50.0, 0.5, 1.0, infinity, not_a_number}) {
    EXPECT_EQ(refused_noise({1.0, 1.0, wrong}), "noise highest frequency") << wrong;
  }
  for (const int wrong : {0, -1}) {
    EXPECT_EQ(refused_noise({1.0, 1.0, 50.0, wrong}), "noise lines") << wrong;
  }
}

}  // namespace
}  // namespace holdfast
