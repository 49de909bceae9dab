#include "holdfast/math/signal/spectrum.hpp"
#include "holdfast/math/signal/spectrum_lines.hpp"

#include "support/random.hpp"

namespace holdfast {
namespace {

/// offset + amplitude · cos(2π · cycles · n / size + phase)
std::vector<double> tone(std::size_t size, double cycles, double amplitude, double phase = 0.0,
                         double offset = 0.0) {
  std::vector<double> signal(size);
  for (std::size_t n = 0; n < size; ++n) {
    const double turn = static_cast<double>(n) / static_cast<double>(size);
    signal[n] = offset + amplitude * std::cos(2.0 * pi<double> * cycles * turn + phase);
  }
  return signal;
}

/// Amplitude of line k by the sum that defines it, in long double.
double defined_amplitude(const std::vector<double>& signal, std::size_t k) {
  std::complex<long double> sum = 0;
  for (std::size_t n = 0; n < signal.size(); ++n) {
    const std::size_t turned = k * n % signal.size();
    const long double angle = 2.0L * pi<long double> * static_cast<long double>(turned) /
                              static_cast<long double>(signal.size());
    sum += static_cast<long double>(signal[n]) * std::polar(1.0L, -angle);
  }
  const bool single = k == 0 || 2 * k == signal.size();
  return static_cast<double>((single ? 1.0L : 2.0L) * std::abs(sum) /
                             static_cast<long double>(signal.size()));
}

TEST(Spectrum, IsThatOfTheSumsThatDefineIt) {
  // The error relative to the largest line grows with the logarithm of the length.
  test::Random random(29);
  for (const std::size_t size : {2U, 3U, 64U, 97U, 100U, 231U}) {
    std::vector<double> signal(size);
    for (double& value : signal) value = random.uniform(-1.0, 1.0);
    const auto lines = amplitude_spectrum(signal, 0.01, SpectralWindow::rectangular);
    ASSERT_EQ(lines.size(), size / 2 + 1);
    for (std::size_t k = 0; k < lines.size(); ++k)
      EXPECT_NEAR(lines[k].amplitude, defined_amplitude(signal, k), 1e-14) << size << " " << k;
  }
}

TEST(Spectrum, ASineOfWholePeriodsShowsItsAmplitudeOnItsLineAlone) {
  for (const std::size_t size : {1000U, 1001U, 2100U}) {
    const auto lines =
        amplitude_spectrum(tone(size, 37, 0.8, 0.4), 0.001, SpectralWindow::rectangular);
    ASSERT_EQ(lines.size(), size / 2 + 1);
    for (std::size_t k = 0; k < lines.size(); ++k) {
      EXPECT_NEAR(lines[k].amplitude, k == 37 ? 0.8 : 0.0, 1e-13) << k;
      EXPECT_NEAR(lines[k].frequency, static_cast<double>(k) / (0.001 * static_cast<double>(size)),
                  1e-10);
    }
  }
}

TEST(Spectrum, AConstantStandsAtZeroFrequencyWithItsOwnSize) {
  for (const auto window : {SpectralWindow::rectangular, SpectralWindow::hann}) {
    const auto lines = amplitude_spectrum(tone(64, 0, 0.0, 0.0, -3.0), 0.1, window);
    EXPECT_NEAR(lines[0].amplitude, 3.0, 1e-13);
    EXPECT_NEAR(lines[5].amplitude, 0.0, 1e-13);
  }
}

TEST(Spectrum, AHannWindowKeepsTheAmplitudeAndGivesHalfToEachNeighbour) {
  const auto lines = amplitude_spectrum(tone(500, 40, 1.2, 1.0), 0.01, SpectralWindow::hann);
  EXPECT_NEAR(lines[40].amplitude, 1.2, 1e-13);
  EXPECT_NEAR(lines[39].amplitude, 0.6, 1e-13);
  EXPECT_NEAR(lines[41].amplitude, 0.6, 1e-13);
  EXPECT_NEAR(lines[38].amplitude, 0.0, 1e-13);
}

TEST(Spectrum, WhatIsOutOfRangeIsRefused) {
  EXPECT_THROW(amplitude_spectrum({}, 0.1, SpectralWindow::hann), InvalidParameter);
  EXPECT_THROW(amplitude_spectrum({1.0}, 0.1, SpectralWindow::hann), InvalidParameter);
  for (const double period : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(),
                              std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW(amplitude_spectrum({1.0, 2.0}, period, SpectralWindow::hann), InvalidParameter)
        << period;
  }
}

TEST(SamplesPerCommonPeriod, IsTheDenominatorOfFrequencyTimesPeriod) {
  EXPECT_EQ(samples_per_common_period(10.0, 0.001), 100);
  EXPECT_EQ(samples_per_common_period(10.0, 0.011), 100);
  EXPECT_EQ(samples_per_common_period(10.0, 0.01), 10);
  EXPECT_EQ(samples_per_common_period(4.0, 0.25), 1);
  EXPECT_EQ(samples_per_common_period(std::sqrt(2.0), 0.01), 0);
}

TEST(WholePeriodSamples, IsTheLongestRecordOfWholePeriods) {
  EXPECT_EQ(whole_period_samples(10001, 10.0, 0.001), 10000);
  EXPECT_EQ(whole_period_samples(10000, 10.0, 0.001), 10000);
  EXPECT_EQ(whole_period_samples(9999, 10.0, 0.001), 9900);
  EXPECT_EQ(whole_period_samples(9091, 10.0, 0.011), 9000);
  EXPECT_EQ(whole_period_samples(50, 10.0, 0.011), 50) << "too short for even one";
  EXPECT_EQ(whole_period_samples(1234, std::sqrt(2.0), 0.01), 1234) << "never coincide";
}

struct Tone {
  double cycles;  ///< in the whole record
  double amplitude;
};

std::vector<double> chord(std::size_t samples, const std::vector<Tone>& tones, double offset) {
  std::vector<double> signal(samples, offset);
  for (const Tone& one : tones) {
    for (std::size_t n = 0; n < samples; ++n) {
      const double turn = static_cast<double>(n) / static_cast<double>(samples);
      signal[n] += one.amplitude * std::cos(2 * pi<double> * one.cycles * turn + 0.3);
    }
  }
  return signal;
}

std::vector<double> noise(std::size_t samples, std::uint64_t seed, double size = 1.0) {
  test::Random random(seed);
  std::vector<double> signal(samples);
  for (double& value : signal) value = size * random.normal();
  return signal;
}

std::vector<SpectralLine> plain_lines(const std::vector<double>& signal) {
  return amplitude_spectrum(signal, 0.01, SpectralWindow::rectangular);
}
std::vector<SpectralLine> hann_lines(const std::vector<double>& signal) {
  return amplitude_spectrum(signal, 0.01, SpectralWindow::hann);
}

TEST(LinePowers, AddUpToTheMeanSquareForEvenAndOddRecords) {
  for (const std::size_t samples : {200U, 201U}) {
    auto signal = noise(samples, 741);
    double mean_square = 0, sum = 0;
    for (const double value : signal) mean_square += value * value / static_cast<double>(samples);
    for (const double power : line_powers(plain_lines(signal), samples)) sum += power;
    EXPECT_NEAR(sum, mean_square, 1e-13);
  }
}

TEST(SubharmonicShares, SplitThePowerAmongTheDivisions) {
  // 20 s with f = 6 Hz: 120 cycles. Half a squared is the power: 8, 2 and 0.5, the mean left out.
  const auto signal = chord(2000, {{120, 4.0}, {240, 2.0}, {60, 1.0}}, 7.0);
  const SubharmonicShares found = subharmonic_shares(plain_lines(signal), 2000, {6.0, 4});
  ASSERT_EQ(found.shares.size(), 4U);
  EXPECT_NEAR(found.shares[0], 10.0 / 10.5, 1e-12);
  EXPECT_NEAR(found.shares[1], 1.0, 1e-12);
  EXPECT_NEAR(found.shares[2], 10.0 / 10.5, 1e-12);
  EXPECT_NEAR(found.shares[3], 1.0, 1e-12);
  EXPECT_EQ(found.division, 2);
  EXPECT_EQ(subharmonic_shares(plain_lines(signal), 2000, {6.0, 4, 0.95}).division, 1);
}

TEST(SubharmonicShares, FiveForcingPeriodsAreFoundAsTheFifth) {
  const auto signal = chord(5000, {{500, 1.0}, {100, 0.2}, {300, 0.3}, {1700, 0.1}}, 0.0);
  EXPECT_EQ(subharmonic_shares(plain_lines(signal), 5000, {10.0}).division, 5);
}

TEST(SubharmonicShares, AMapIsAskedForDivisionsOfOneCycleASample) {
  for (const int period : {2, 3, 4, 7, 12}) {
    test::Random random(742);
    std::vector<double> values(static_cast<std::size_t>(period)), signal(2520);
    for (double& value : values) value = random.normal();
    for (std::size_t n = 0; n < signal.size(); ++n) signal[n] = values[n % values.size()];
    const auto lines = amplitude_spectrum(signal, 1.0, SpectralWindow::rectangular);
    EXPECT_EQ(subharmonic_shares(lines, signal.size(), {1.0}).division, period);
  }
}

TEST(SubharmonicShares, HalfALineIsTolerated) {
  // 100.4 cycles: the record is not whole; the tone's own line is the nearest one.
  const auto lines = plain_lines(chord(1000, {{100, 1.0}}, 0.0));
  EXPECT_NEAR(subharmonic_shares(lines, 1000, {10.04, 1}).shares[0], 1.0, 1e-12);
  EXPECT_NEAR(subharmonic_shares(lines, 1000, {10.06, 1}).shares[0], 0.0, 1e-12);
}

TEST(SubharmonicShares, NoiseHasNoDivisionAndTooFineOnesAreNotAsked) {
  const auto lines = plain_lines(noise(4000, 743));
  const SubharmonicShares found = subharmonic_shares(lines, 4000, {10.0, 400});
  EXPECT_EQ(found.division, 0);
  EXPECT_NEAR(found.shares[9], 1.0 / 40, 0.02) << "one line in forty";
  EXPECT_GT(found.shares[132], 0.2) << "one in three";
  for (std::size_t m = 134; m <= 400; ++m) EXPECT_EQ(found.shares[m - 1], 0.0) << m;
}

TEST(SubharmonicShares, ASignalAtRestBelongsToTheBase) {
  EXPECT_EQ(subharmonic_shares(plain_lines(std::vector<double>(100, 0.0)), 100, {10.0}).division,
            1);
}

TEST(LinesHolding, CountsTheStrongestFirst) {
  const auto lines = plain_lines(chord(2000, {{50, 3.0}, {120, 1.0}, {240, 1.0}, {60, 0.01}}, 5.0));
  EXPECT_EQ(lines_holding(lines, 2000, 0.8), 1U);
  EXPECT_EQ(lines_holding(lines, 2000, 0.9), 2U);
  EXPECT_EQ(lines_holding(lines, 2000, 0.99), 3U);
  EXPECT_EQ(lines_holding(plain_lines(std::vector<double>(64, 0.0)), 64, 0.99), 0U);
  EXPECT_GT(lines_holding(plain_lines(noise(2000, 744)), 2000, 0.99), 700U);
}

TEST(ContinuousShare, IsThatOfTheNoiseUnderTheLines) {
  auto signal = chord(20000, {{321.4, 1.0}, {1000.7, 0.5}, {2718.3, 0.2}}, 2.0);
  EXPECT_LT(continuous_share(hann_lines(signal), 20000), 1e-5);
  EXPECT_NEAR(continuous_share(hann_lines(noise(20000, 745)), 20000), 1.0, 0.05);
  const auto hiss = noise(20000, 746, 0.2);
  for (std::size_t n = 0; n < signal.size(); ++n) signal[n] += hiss[n];
  const double truth = 0.04 / (0.04 + 0.5 * (1.0 + 0.25 + 0.04));
  EXPECT_NEAR(continuous_share(hann_lines(signal), 20000) / truth, 1.0, 0.1);
}

TEST(SpectrumLines, WhatIsOutOfRangeIsRefused) {
  const auto lines = plain_lines(noise(100, 747));
  EXPECT_THROW(line_powers(lines, 99), InvalidParameter);
  EXPECT_THROW(line_powers({}, 0), InvalidParameter);
  EXPECT_THROW(subharmonic_shares(lines, 100, {0.0}), InvalidParameter);
  EXPECT_THROW(subharmonic_shares(lines, 100, {10.0, 0}), InvalidParameter);
  EXPECT_THROW(subharmonic_shares(lines, 100, {10.0, 4, 1.5}), InvalidParameter);
  EXPECT_THROW(lines_holding(lines, 100, 0.0), InvalidParameter);
  EXPECT_THROW(continuous_share(lines, 102), InvalidParameter);
}

}  // namespace
}  // namespace holdfast
