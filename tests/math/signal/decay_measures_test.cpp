#include "holdfast/math/signal/decay_measures.hpp"

#include "holdfast/core/types.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

/// z = z₀ e^{−σt} [cos ωt + ripple cos(20 ωt)].
struct DampedCosine {
  double initial = 0.004;
  double period = 0.5;
  double decrement = 0.2;
  double ripple = 0.0;

  double at(double t) const {
    const double phase = 2 * pi<double> * t / period;
    return initial * std::exp(-decrement * t / period) *
           (std::cos(phase) + ripple * std::cos(20 * phase));
  }
  DecayRecord record(double duration, double interval) const {
    DecayRecord record;
    for (int k = 0; k * interval <= duration; ++k) {
      record.times.push_back(k * interval);
      record.displacements.push_back(at(k * interval));
    }
    return record;
  }
  /// ωt of the first opposite peak: tan ωt = −σ/ω there.
  double first_peak_time() const {
    return (pi<double> - std::atan(decrement / (2 * pi<double>))) * period / (2 * pi<double>);
  }
};

TEST(DecayMeasures, ADampedCosineShowsItsPeriodDecrementAndOppositePeak) {
  for (const double decrement : {0.02, 0.2, 0.6}) {
    for (const double sign : {1.0, -1.0}) {
      DampedCosine motion;
      motion.decrement = decrement;
      motion.initial *= sign;
      const auto found = decay_measures(motion.record(2.0, 0.001));
      EXPECT_NEAR(found.period, motion.period, 1e-6);
      EXPECT_NEAR(found.logarithmic_decrement, decrement, 1e-6);
      EXPECT_NEAR(found.first_peak_time, motion.first_peak_time(), 1e-6);
      EXPECT_NEAR(found.first_peak / motion.at(motion.first_peak_time()), 1.0, 1e-7);
    }
  }
}

TEST(DecayMeasures, AFinerRecordIsMoreExactByTheSquareOfTheInterval) {
  const DampedCosine motion;
  const auto miss = [&](double interval) {
    return std::abs(decay_measures(motion.record(2.0, interval)).first_peak_time -
                    motion.first_peak_time());
  };
  EXPECT_LT(miss(0.001), 0.5 * miss(0.008));
  EXPECT_LT(miss(0.008), 0.008 / 10) << "the parabola sees between the samples";
}

TEST(DecayMeasures, ARippleThatDoesNotReachTheEquilibriumMakesNoPeak) {
  DampedCosine smooth, rippled;
  rippled.ripple = 0.03;
  const auto expected = decay_events(smooth.record(2.0, 0.0005));
  const auto found = decay_events(rippled.record(2.0, 0.0005));
  ASSERT_EQ(found.crossings.size(), expected.crossings.size());
  ASSERT_EQ(found.peaks.size(), found.crossings.size() - 1);
  for (std::size_t k = 0; k < found.peaks.size(); ++k) {
    EXPECT_GT(found.peaks[k].time, found.crossings[k]);
    EXPECT_LT(found.peaks[k].time, found.crossings[k + 1]);
    EXPECT_NEAR(found.peaks[k].value / expected.peaks[k].value, 1.0, 1.5 * 0.03);
  }
  const auto measures = decay_measures(rippled.record(2.0, 0.0005));
  EXPECT_NEAR(measures.period / rippled.period, 1.0, 1e-3);
  EXPECT_NEAR(measures.logarithmic_decrement, rippled.decrement, 1e-2);
}

TEST(DecayMeasures, TheDecrementIsTheSlopeOfTheLineNearestToTheLogarithms) {
  const std::array<double, 4> peaks{-3.0, 2.5, -1.9, 1.7};
  double moment = 0.0, spread = 0.0;
  for (int k = 0; k < 4; ++k) {
    moment += (k - 1.5) * std::log(std::abs(peaks[static_cast<std::size_t>(k)]));
    spread += (k - 1.5) * (k - 1.5);
  }
  EXPECT_NEAR(logarithmic_decrement(peaks), -2.0 * moment / spread, 1e-14);
  EXPECT_NEAR(logarithmic_decrement<double>({8.0, -4.0, 2.0, -1.0}), 2 * std::log(2.0), 1e-14);
}

TEST(DecayMeasures, WhatTheRecordIsTooShortForIsNoNumber) {
  const DampedCosine motion;  // crosses at 0.125, 0.375, 0.625, … s
  const auto measures = [&](double duration) {
    return decay_measures(motion.record(duration, 0.001));
  };
  EXPECT_TRUE(std::isnan(measures(0.3).first_peak));
  EXPECT_TRUE(std::isnan(measures(0.3).first_peak_time));
  EXPECT_FALSE(std::isnan(measures(0.4).first_peak));
  EXPECT_TRUE(std::isnan(measures(1.1).period));
  EXPECT_TRUE(std::isnan(measures(1.1).logarithmic_decrement));
  EXPECT_FALSE(std::isnan(measures(1.2).period));
  EXPECT_FALSE(std::isnan(measures(1.2).logarithmic_decrement));
  for (const auto& record : {DecayRecord{}, DecayRecord{{0.0}, {1.0}}})
    EXPECT_TRUE(std::isnan(decay_measures(record).first_peak));
}

TEST(DecayMeasures, ColumnsOfUnequalLengthAreRefused) {
  auto record = DampedCosine{}.record(1.0, 0.001);
  record.displacements.pop_back();
  EXPECT_THROW(decay_events(record), InvalidParameter);
  EXPECT_THROW(decay_measures(record), InvalidParameter);
}

}  // namespace
}  // namespace holdfast
