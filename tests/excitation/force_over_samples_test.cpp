#include "holdfast/excitation/force_over_samples.hpp"

#include "support/random.hpp"

namespace holdfast {
namespace {

MultiHarmonicForce force_of_three_lines() {
  return {{{0.5, 10.0}, {0.2, 33.0, 0.7}, {0.1, 4.0, -2.0}}, nullptr};
}

std::shared_ptr<const RecordedForce> record_of_steps(RecordInterpolation interpolation) {
  return std::make_shared<const RecordedForce>(std::vector<double>{0.0, 0.0104, 0.0371, 0.0502},
                                               std::vector<double>{0.3, -0.4, 0.9, 0.2},
                                               interpolation);
}

MultiHarmonicForce force_with_record() {
  return {force_of_three_lines().harmonics, record_of_steps(RecordInterpolation::linear)};
}

/// The largest force of the harmonics, at any phases.
double sum_of_amplitudes(const MultiHarmonicForce& force) {
  double sum = 0.0;
  for (const Harmonic& line : force.harmonics) sum += line.amplitude;
  return sum;
}

TEST(ForceOverSamples, ExactlyItIsTheForceItself) {
  test::Random random(1331);
  const MultiHarmonicForce force = force_with_record();
  ForceOverSamples over(force, ForceHold::exact, 0.001);
  for (std::int64_t j = 0; j < 60; ++j) {
    const double time = static_cast<double>(j) * 0.001;
    over.begin_sample(j, time);
    EXPECT_EQ(over.held(), 0.0);
    for (int trial = 0; trial < 10; ++trial) {
      const double after = random.uniform(0.0, 0.001);
      EXPECT_EQ(over.at(after), force.at(time + after));
    }
    Series coefficients(8), expected(8);
    over.expand(0.0003, 0.0005, coefficients);
    force.expand(time + 0.0003, 0.0005, expected);
    EXPECT_EQ(coefficients, expected);
  }
}

TEST(ForceOverSamples, AnInstantOfEveryPeriodIsThatInstant) {
  for (const MultiHarmonicForce& force : {force_of_three_lines(), force_with_record()}) {
    for (const ForceHold hold : {ForceHold::exact, ForceHold::sampled}) {
      ForceOverSamples over(force, hold, 0.0013);
      for (const double after : {0.0, 0.0004, 0.0013}) {
        const PeriodInstant instant = over.instant(after);
        for (std::int64_t j = 0; j < 300; ++j) {
          over.begin_sample(j, static_cast<double>(j) * 0.0013);
          ASSERT_NEAR(over.at(instant), over.at(after), 1e-14) << j << ", " << after;
        }
      }
    }
  }
}

TEST(ForceOverSamples, HeldItIsThatOfTheSample) {
  const MultiHarmonicForce force = force_with_record();
  ForceOverSamples over(force, ForceHold::sampled, 0.001);
  for (std::int64_t j = 0; j < 60; ++j) {
    const double time = static_cast<double>(j) * 0.001;
    over.begin_sample(j, time);
    EXPECT_EQ(over.held(), force.at(time));
    for (const double after : {0.0, 0.0004, 0.00099}) EXPECT_EQ(over.at(after), over.held());
    EXPECT_EQ(over.next_break(0.0002), std::numeric_limits<double>::infinity());
    Series coefficients = Series::Constant(6, 9.0);
    over.expand(0.0003, 0.0005, coefficients);
    EXPECT_EQ(coefficients[0], over.held());
    EXPECT_TRUE(coefficients.tail(5).isZero(0.0));
  }
  EXPECT_TRUE(over.is_regular());
  EXPECT_EQ(over.highest_angular_frequency(), 0.0);
  EXPECT_TRUE(over.phases().empty());
}

/// F cos ω t_j and F sin ω t_j by their definition.
void expect_phases(const ForceOverSamples& over, const std::vector<Harmonic>& lines, double period,
                   std::int64_t index) {
  ASSERT_EQ(over.phases().size(), lines.size());
  for (std::size_t l = 0; l < lines.size(); ++l) {
    const double cycles = static_cast<double>(index) * (lines[l].frequency * period);
    const double angle = 2.0 * pi<double> * (cycles - std::floor(cycles));
    const double rounding = 1e-15 * (1.0 + cycles);
    EXPECT_NEAR(over.phases()[l].cosine, lines[l].amplitude * std::cos(angle), rounding) << index;
    EXPECT_NEAR(over.phases()[l].sine, lines[l].amplitude * std::sin(angle), rounding) << index;
  }
}

TEST(ForceOverSamples, ItsPhasesAreThoseOfTheSampleInAnyOrder) {
  test::Random random(1332);
  const MultiHarmonicForce force = force_of_three_lines();
  const double period = 0.0037;
  ForceOverSamples over(force, ForceHold::exact, period);
  std::int64_t index = 0;
  for (int step = 0; step < 2000; ++step) {
    over.begin_sample(index, static_cast<double>(index) * period);
    expect_phases(over, force.harmonics, period, index);
    // On to the next sample, the same one again, or to any other one.
    const double choice = random.unit();
    if (choice < 0.9) {
      ++index;
    } else if (choice < 0.97) {
      index = static_cast<std::int64_t>(random.index(100000));
    }
  }
}

TEST(ForceOverSamples, EveryBreakOfARecordIsMetOnceInItsOrder) {
  const MultiHarmonicForce force{{}, record_of_steps(RecordInterpolation::held)};
  const double period = 0.001;
  ForceOverSamples over(force, ForceHold::exact, period);
  EXPECT_FALSE(over.is_regular());
  std::vector<double> breaks;
  for (std::int64_t j = 0; j < 60; ++j) {
    const double time = static_cast<double>(j) * period;
    over.begin_sample(j, time);
    for (double after = over.next_break(0.0); after < period; after = over.next_break(after)) {
      ASSERT_GT(after, 0.0);
      breaks.push_back(time + after);
      ASSERT_LT(breaks.size(), 10U);
    }
  }
  ASSERT_EQ(breaks.size(), 3U);  // the row at 0 is no later than the first sample
  for (std::size_t row = 0; row < 3; ++row)
    EXPECT_NEAR(breaks[row], force.record->times()[row + 1], 1e-16);
}

TEST(ForceOverSamples, ABreakIsAlwaysLaterHoweverLateTheSample) {
  test::Random random(1333);
  for (int draw = 0; draw < 2000; ++draw) {
    const double time = random.log_uniform(1.0, 1e9), period = 0.001;
    const double at = time + random.unit() * period;
    MultiHarmonicForce force;
    force.record = std::make_shared<const RecordedForce>(std::vector<double>{at, at + 1.0},
                                                         std::vector<double>{1.0, 1.0},
                                                         RecordInterpolation::held);
    ForceOverSamples over(force, ForceHold::exact, period);
    over.begin_sample(7, time);
    double after = 0.0;
    int met = 0;
    for (; met < 20 && after < period; ++met) {
      const double next = over.next_break(after);
      ASSERT_GT(next, after);
      after = next;
    }
    ASSERT_LT(met, 5) << "a break is passed, not approached";
  }
}

TEST(ForceOverSamples, ItsBoundsHoldAtAllTimes) {
  test::Random random(1334);
  const MultiHarmonicForce force = force_of_three_lines();
  ForceOverSamples over(force, ForceHold::exact, 0.001);
  over.begin_sample(0, 0.0);
  const ForceBounds bounds = over.bounds();
  Vector<double, 3> largest = Vector<double, 3>::Zero();
  for (int trial = 0; trial < 20000; ++trial) {
    Vector<double, 3> taylor;
    force.expand(random.uniform(0.0, 10.0), 1.0, taylor);
    taylor[2] *= 2.0;
    largest = largest.cwiseMax(taylor.cwiseAbs());
  }
  EXPECT_LE(largest[0], bounds.value);
  EXPECT_LE(largest[1], bounds.rate);
  EXPECT_LE(largest[2], bounds.second_rate);
  EXPECT_GE(largest[0], 0.7 * bounds.value);
  EXPECT_GE(largest[1], 0.7 * bounds.rate);
  EXPECT_GE(largest[2], 0.7 * bounds.second_rate);
  const ForceBounds held = ForceOverSamples(force, ForceHold::sampled, 0.001).bounds();
  EXPECT_DOUBLE_EQ(held.value, sum_of_amplitudes(force));
  EXPECT_EQ(held.rate, 0.0);
  EXPECT_EQ(held.second_rate, 0.0);
}

// Where the force is said to be regular, its bounds are relied on: a held record is part of it.
TEST(ForceOverSamples, TheBoundsOfARegularForceBoundAllOfIt) {
  for (const bool with_record : {false, true}) {
    MultiHarmonicForce force = force_of_three_lines();
    if (with_record) {
      force.record = std::make_shared<const RecordedForce>(
          std::vector<double>{0.0, 1.0}, std::vector<double>{7.0, 7.0}, RecordInterpolation::held);
    }
    for (const ForceHold hold : {ForceHold::sampled, ForceHold::exact}) {
      ForceOverSamples over(force, hold, 0.001);
      double largest = 0.0;
      for (std::int64_t j = 0; j < 500; ++j) {
        over.begin_sample(j, static_cast<double>(j) * 0.001);
        if (over.is_regular()) largest = std::max(largest, std::abs(over.at(0.0)));
      }
      EXPECT_LE(largest, over.bounds().value) << "record: " << with_record;
    }
  }
}

}  // namespace
}  // namespace holdfast
