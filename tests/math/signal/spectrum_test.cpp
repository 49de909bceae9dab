#include "holdfast/math/signal/spectrum.hpp"

#include "support/random.hpp"
#include "support/testing.hpp"

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
  // The fast transform's error grows with the logarithm of the length, relative to the largest
  // line.
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

TEST(Spectrum, AnAlternatingSignalStandsAtTheNyquistFrequency) {
  const auto lines = amplitude_spectrum(tone(64, 32, 2.0), 0.01, SpectralWindow::rectangular);
  EXPECT_NEAR(lines[32].amplitude, 2.0, 1e-13);
  EXPECT_NEAR(lines[32].frequency, 50.0, 1e-12);
}

TEST(Spectrum, AHannWindowKeepsTheAmplitudeAndGivesHalfToEachNeighbour) {
  const auto lines = amplitude_spectrum(tone(500, 40, 1.2, 1.0), 0.01, SpectralWindow::hann);
  EXPECT_NEAR(lines[40].amplitude, 1.2, 1e-13);
  EXPECT_NEAR(lines[39].amplitude, 0.6, 1e-13);
  EXPECT_NEAR(lines[41].amplitude, 0.6, 1e-13);
  EXPECT_NEAR(lines[38].amplitude, 0.0, 1e-13);
}

TEST(Spectrum, AHannWindowLeaksLessFromABrokenPeriod) {
  const auto plain = amplitude_spectrum(tone(500, 40.5, 1.0), 0.01, SpectralWindow::rectangular);
  const auto hann = amplitude_spectrum(tone(500, 40.5, 1.0), 0.01, SpectralWindow::hann);
  EXPECT_LT(hann[100].amplitude, 0.01 * plain[100].amplitude);
}

TEST(Spectrum, HoldsTheEnergyOfTheSignal) {
  // Parseval: the mean square is the sum of ½ a² over the lines, of a² at zero and Nyquist.
  test::Random random(111);
  for (const std::size_t size : {256U, 333U}) {
    std::vector<double> signal(size);
    double mean_square = 0;
    for (double& value : signal) {
      value = random.normal();
      mean_square += value * value / static_cast<double>(size);
    }
    double sum = 0;
    const auto lines = amplitude_spectrum(signal, 1.0, SpectralWindow::rectangular);
    for (std::size_t k = 0; k < lines.size(); ++k) {
      const bool once = k == 0 || 2 * k == size;
      sum += (once ? 1.0 : 0.5) * lines[k].amplitude * lines[k].amplitude;
    }
    EXPECT_NEAR(sum, mean_square, 1e-13);
  }
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

}  // namespace
}  // namespace holdfast
