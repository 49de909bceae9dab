#include "holdfast/control/sampling_clock.hpp"

#include "support/message_of.hpp"
#include "support/random.hpp"

namespace holdfast {
namespace {

constexpr std::int64_t jitter_draws = 1000000;

/// The results for the seed 1234567 that Rosetta Code's task "Pseudo-random numbers/Splitmix64"
/// publishes.
TEST(SplitMix, GivesThePublishedSequence) {
  constexpr std::array<std::uint64_t, 5> published = {6457827717110365317U, 3203168211198807973U,
                                                      9817491932198370423U, 4593380528125082431U,
                                                      16408922859458223821U};
  for (std::uint64_t index = 0; index < published.size(); ++index) {
    EXPECT_EQ(detail::split_mix_64(1234567, index + 1), published[index]);
  }
}

TEST(SamplingClock, WithoutJitterIsTheGridToTheLastBit) {
  test::Random random(731);
  for (int draw = 0; draw < 100; ++draw) {
    const double period = random.log_uniform(1e-5, 1.0);
    const SamplingClock clock(period, {0.0, 17});
    for (int sample = 0; sample < 1000; ++sample) {
      const auto index = static_cast<std::int64_t>(random.log_uniform(1, 1e9)) - 1;
      ASSERT_EQ(clock.time(index), static_cast<double>(index) * period);
      ASSERT_EQ(clock.period_of(index), period);
    }
  }
  EXPECT_FALSE(std::signbit(SamplingClock(0.01).time(0)));
}

TEST(SamplingClock, StartsOnTheGridAndStraysByNoMoreThanTheHalfWidth) {
  constexpr double period = 1e-3, half_width = 2e-4;
  double largest = 0, least = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const SamplingClock clock(period, {half_width, seed});
    EXPECT_EQ(clock.time(0), 0.0);
    EXPECT_EQ(clock.deviation(0), 0.0);
    for (std::int64_t index = 1; index < 10000; ++index) {
      const double deviation = clock.deviation(index);
      ASSERT_LT(std::abs(deviation), half_width);
      ASSERT_NE(deviation, 0.0);
      // Round-off of instants up to 10 s.
      ASSERT_NEAR(clock.time(index), static_cast<double>(index) * period + deviation, 4e-15);
      largest = std::max(largest, deviation);
      least = std::min(least, deviation);
    }
  }
  EXPECT_GT(largest, 0.999 * half_width);
  EXPECT_LT(least, -0.999 * half_width);
}

TEST(SamplingClock, DeviationsFillTheirRangeEvenly) {
  const SamplingClock clock(1.0, {0.25, 6});
  constexpr std::size_t cells = 200;
  std::vector<double> visits(cells, 0.0);
  for (std::int64_t index = 1; index <= jitter_draws; ++index) {
    const double share = (clock.deviation(index) / 0.25 + 1) / 2;
    visits[static_cast<std::size_t>(share * static_cast<double>(cells))] += 1;
  }
  const double expected = static_cast<double>(jitter_draws) / static_cast<double>(cells);
  double chi_squared = 0;
  for (const double count : visits) chi_squared += (count - expected) * (count - expected);
  chi_squared /= expected;
  // Mean n and variance 2 n for n degrees of freedom; too even is as wrong as too uneven.
  const double freedom = static_cast<double>(cells) - 1;
  EXPECT_NEAR(chi_squared, freedom, 5 * std::sqrt(2 * freedom));
}

/// Mean of the products of the deviations in two sequences, in units of their variance.
double jitter_correlation(const SamplingClock& first, const SamplingClock& second,
                          std::int64_t shift) {
  double sum = 0;
  for (std::int64_t index = 1; index <= jitter_draws; ++index) {
    sum += first.deviation(index) * second.deviation(index + shift);
  }
  const double half_width = first.jitter().half_width;
  return 3 * sum / (half_width * half_width) / static_cast<double>(jitter_draws);
}

TEST(SamplingClock, DeviationsOfOtherSamplesAndOtherSeedsAreUncorrelated) {
  const SamplingClock clock(1.0, {0.25, 7}), other(1.0, {0.25, 8});
  const double limit = 5 / std::sqrt(static_cast<double>(jitter_draws));
  for (const std::int64_t shift : {1, 2, 3, 10, 1000}) {
    EXPECT_NEAR(jitter_correlation(clock, clock, shift), 0, limit) << shift;
  }
  for (const std::int64_t shift : {0, 1}) {
    EXPECT_NEAR(jitter_correlation(clock, other, shift), 0, limit) << shift;
  }
  EXPECT_NEAR(jitter_correlation(clock, clock, 0), 1, limit);
}

TEST(SamplingClock, TheHalfWidthScalesTheSameSequence) {
  const SamplingClock narrow(1.0, {0.125, 3}), wide(1.0, {0.25, 3});
  for (std::int64_t index = 0; index < 1000; ++index) {
    ASSERT_EQ(2 * narrow.deviation(index), wide.deviation(index));
  }
}

TEST(SamplingClock, PeriodsAreTheTimesBetweenSamples) {
  const SamplingClock clock(1e-3, {4e-4, 9});
  for (std::int64_t index = 0; index < 100000; ++index) {
    // Round-off of instants up to 100 s.
    ASSERT_NEAR(clock.period_of(index), clock.time(index + 1) - clock.time(index), 3e-14);
  }
}

/// The widest jitter that a processing delay leaves room for; the numbers are exact in binary.
TEST(SamplingClock, EveryForceIsAppliedBeforeTheNextSample) {
  constexpr double period = 1.0 / 1024, delay = period / 8;
  const Jitter jitter{(period - delay) / 2, 10};
  ASSERT_NO_THROW(validate({period, delay}, jitter));
  const SamplingClock clock(period, jitter);
  double shortest = period;
  for (std::int64_t index = 0; index < 100000; ++index) {
    ASSERT_GE(clock.period_of(index), delay);
    shortest = std::min(shortest, clock.period_of(index));
  }
  EXPECT_LT(shortest, 1.1 * delay) << "the bound was never tried";
}

std::string refused_jitter(const Sampling<double>& sampling, double half_width) {
  return tests::refused_name([&] { validate(sampling, Jitter{half_width, 1}); });
}

TEST(Jitter, WhatIsOutOfRangeIsRefusedByName) {
  const std::string name = "jitter half width";
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double half_width : {-1e-9, nan, std::numeric_limits<double>::infinity(), 0.5, 1.0}) {
    EXPECT_EQ(refused_jitter({1.0, 0.0}, half_width), name) << half_width;
    EXPECT_THROW(SamplingClock(1.0, {half_width, 1}), InvalidParameter) << half_width;
  }
  EXPECT_EQ(refused_jitter({1.0, 0.5}, 0.25 * (1 + 1e-12)), name);
  EXPECT_EQ(refused_jitter({1.0, 1.0}, 1e-9), name);
  EXPECT_EQ(refused_jitter({0.0, 0.0}, 0.0), "sampling period tau");
  EXPECT_EQ(refused_jitter({1.0, 1.5}, 0.0), "processing delay");
  EXPECT_THROW(SamplingClock{nan}, InvalidParameter);
}

TEST(Jitter, WhatIsJustInRangeIsAccepted) {
  EXPECT_EQ(refused_jitter({1.0, 0.0}, std::nextafter(0.5, 0.0)), "");
  EXPECT_EQ(refused_jitter({1.0, 0.5}, 0.25), "");
  EXPECT_EQ(refused_jitter({0.3, 0.1}, 0.1), "") << "meant as exactly the room that there is";
  EXPECT_EQ(refused_jitter({1.0, 1.0}, 0.0), "");
}

}  // namespace
}  // namespace holdfast
