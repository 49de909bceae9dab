#include "holdfast/math/stats/trusted_digits.hpp"

#include "support/testing.hpp"

namespace holdfast {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double none = std::numeric_limits<double>::quiet_NaN();

TEST(TrustedDigits, AreTheDecimalLogarithmOfTheRelativeDifference) {
  for (const long double reference : {1.0L, -3.0L, 2e-200L, -7e200L}) {
    for (int digits = 1; digits <= 15; ++digits) {
      const long double share = std::pow(10.0L, -digits);
      const auto value = static_cast<double>(reference * (1.0L + share));
      EXPECT_NEAR(trusted_digits(value, reference), digits, 0.1) << digits;
    }
  }
}

TEST(TrustedDigits, OfARoundedNumberAreThoseOfItsType) {
  // Half a unit of the last of 53 bits: 15.95 digits at least.
  if (!long_double_is_wider) GTEST_SKIP() << "long double is no wider than double here";
  for (const long double reference : {1.0L / 3.0L, 2.0L / 3.0L, std::sqrt(2.0L), pi<long double>})
    EXPECT_GE(trusted_digits(static_cast<double>(reference), reference), 15.95);
}

TEST(TrustedDigits, StayBetweenNoneAndAll) {
  EXPECT_EQ(trusted_digits(1.0, 1.0L), most_trusted_digits);
  EXPECT_EQ(trusted_digits(0.0, 0.0L), most_trusted_digits);
  EXPECT_EQ(trusted_digits(1.0, 1e300L), 0.0);
  EXPECT_EQ(trusted_digits(-1.0, 1.0L), 0.0);
  EXPECT_EQ(trusted_digits(1e300, 1.0L), 0.0);
  EXPECT_EQ(trusted_digits(1.0, 1.0L + 1e-18L), most_trusted_digits);
}

TEST(TrustedDigits, OfZeroNeedAScale) {
  EXPECT_EQ(trusted_digits(1e-16, 0.0L), 0.0);
  EXPECT_NEAR(trusted_digits(1e-16, 0.0L, 1.0L), 16.0, 1e-12);
  EXPECT_EQ(trusted_digits(0.0, 0.0L, 0.0L), most_trusted_digits);
  EXPECT_EQ(trusted_digits(1.0, 2.0L, 0.0L), 0.0);
}

TEST(TrustedDigits, OfWhatIsNotFiniteAreAllOrNone) {
  EXPECT_EQ(trusted_digits(infinity, static_cast<long double>(infinity)), most_trusted_digits);
  EXPECT_EQ(trusted_digits(none, static_cast<long double>(none)), most_trusted_digits);
  EXPECT_EQ(trusted_digits(infinity, -static_cast<long double>(infinity)), 0.0);
  EXPECT_EQ(trusted_digits(none, 1.0L), 0.0);
  EXPECT_EQ(trusted_digits(1.0, static_cast<long double>(none)), 0.0);
  EXPECT_EQ(trusted_digits(infinity, 1.0L), 0.0);
}

TEST(TrustedDigits, OfAVectorCompareItsLength) {
  const Vector<long double, 3> reference(3.0L, 0.0L, 4.0L);
  Vector<double, 3> value(3.0, 0.0, 4.0);
  EXPECT_EQ(trusted_digits(value, reference), most_trusted_digits);
  value[1] = 5e-9;
  EXPECT_NEAR(trusted_digits(value, reference), 9.0, 1e-9);
  value[1] = none;
  EXPECT_EQ(trusted_digits(value, reference), 0.0);
  EXPECT_EQ(trusted_digits(Matrix<double, 2>(Matrix<double, 2>::Zero()),
                           Matrix<long double, 2>(Matrix<long double, 2>::Zero())),
            most_trusted_digits);
}

TEST(PiOfANumberType, HasThePrecisionOfThatType) {
  EXPECT_EQ(pi_of<double>(), pi<double>);
  EXPECT_EQ(pi_of<long double>(), pi<long double>);
  EXPECT_EQ(long_double_is_wider, static_cast<long double>(pi<double>) != pi_of<long double>());
}

}  // namespace
}  // namespace holdfast
