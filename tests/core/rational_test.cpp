#include "holdfast/core/rational.hpp"

#include "support/random.hpp"

namespace holdfast {
namespace {

TEST(Rational, EveryFractionWithASmallDenominatorIsFoundInLowestTerms) {
  for (std::int64_t q = 1; q <= 200; ++q) {
    for (std::int64_t p = -2 * q; p <= 2 * q; ++p) {
      const auto found =
          reconstruct_rational(static_cast<double>(p) / static_cast<double>(q), 1000);
      ASSERT_TRUE(found) << p << '/' << q;
      const std::int64_t common = std::gcd(p, q);
      EXPECT_EQ(found->numerator, p / common);
      EXPECT_EQ(found->denominator, q / common);
    }
  }
}

TEST(Rational, ProductsOfDecimalsAreReadAsTheyWereMeant) {
  const auto eleven = reconstruct_rational(10.0 * 0.011, 1'000'000);
  ASSERT_TRUE(eleven);
  EXPECT_EQ(eleven->numerator, 11);
  EXPECT_EQ(eleven->denominator, 100);
  // Two fractions with denominators up to 10⁶ are 10⁻¹² apart, so below 2 nothing else lies within
  // 10⁻¹³.
  test::Random random(20);
  for (int draw = 0; draw < 2000; ++draw) {
    const auto tenth_hertz = static_cast<std::int64_t>(1 + random.index(2000));
    const auto ten_microseconds = static_cast<std::int64_t>(1 + random.index(1000));
    const double frequency = static_cast<double>(tenth_hertz) / 10.0;
    const double period = static_cast<double>(ten_microseconds) / 1e5;
    const auto found = reconstruct_rational(frequency * period, 1'000'000);
    ASSERT_TRUE(found);
    const std::int64_t p = tenth_hertz * ten_microseconds, q = 1'000'000;
    EXPECT_EQ(found->numerator, p / std::gcd(p, q)) << tenth_hertz << ' ' << ten_microseconds;
    EXPECT_EQ(found->denominator, q / std::gcd(p, q)) << tenth_hertz << ' ' << ten_microseconds;
  }
}

TEST(Rational, WholeNumbersAndZeroAreTheirOwnFraction) {
  EXPECT_EQ(reconstruct_rational(0.0, 1)->numerator, 0);
  EXPECT_EQ(reconstruct_rational(-7.0, 1)->numerator, -7);
  EXPECT_EQ(reconstruct_rational(-7.0, 1)->denominator, 1);
}

TEST(Rational, IrrationalNumbersHaveNoSmallFraction) {
  for (const double value :
       {std::sqrt(2.0), (1.0 + std::sqrt(5.0)) / 2.0, std::exp(1.0), -std::sqrt(3.0)}) {
    EXPECT_FALSE(reconstruct_rational(value, 100'000)) << value;
  }
}

TEST(Rational, TheLargestDenominatorIsALimitThatIsAdmitted) {
  EXPECT_TRUE(reconstruct_rational(1.0 / 17.0, 17));
  EXPECT_FALSE(reconstruct_rational(1.0 / 17.0, 16));
}

TEST(Rational, RefusesWhatIsNoFiniteNumberInReach) {
  for (const double value :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
        -std::numeric_limits<double>::infinity(), 1e17}) {
    EXPECT_THROW(reconstruct_rational(value, 10), InvalidParameter) << value;
  }
}

}  // namespace
}  // namespace holdfast
