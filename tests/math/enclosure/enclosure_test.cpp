#include "holdfast/math/enclosure/enclosure.hpp"

#include "support/testing.hpp"

namespace holdfast {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Doubles of all sizes and signs, round ones and those at the ends of the range among them.
class SomeDoubles {
 public:
  double next() {
    switch (random_() % 8) {
      case 0:
        return static_cast<double>(random_() % 17) - 8.0;
      case 1:
        return std::ldexp(mantissa_(random_), -1074 + static_cast<int>(random_() % 60));
      case 2:
        return std::ldexp(mantissa_(random_), 900 + static_cast<int>(random_() % 120));
      default:
        return std::ldexp(mantissa_(random_), static_cast<int>(random_() % 80) - 40);
    }
  }

 private:
  std::mt19937_64 random_{5};
  std::uniform_real_distribution<double> mantissa_{-1.0, 1.0};
};

TEST(Enclosure, RoundsToTheNeighboursOrJustBeyond) {
  SomeDoubles doubles;
  for (int trial = 0; trial < 200000; ++trial) {
    const double x = doubles.next();
    const double below = std::nextafter(x, -infinity), above = std::nextafter(x, infinity);
    const double tiny = std::abs(x) < 0x1p-840 ? 0x1p-892 : 0.0;  // the error bound is normal
    EXPECT_LE(detail::rounded_down(x), below);
    EXPECT_GE(detail::rounded_down(x), std::nextafter(below, -infinity) - tiny);
    EXPECT_GE(detail::rounded_up(x), above);
    EXPECT_LE(detail::rounded_up(x), std::nextafter(above, infinity) + tiny);
    EXPECT_TRUE(std::isnormal(detail::rounding_of(x)));
  }
}

/// The exact result is near + rest, |rest| no more than half a unit of near.
void expect_holds(const Enclosure& enclosure, double near, double rest) {
  EXPECT_TRUE(enclosure.lower() < near || (enclosure.lower() == near && rest >= 0.0));
  EXPECT_TRUE(near < enclosure.upper() || (enclosure.upper() == near && rest <= 0.0));
}

/// By the exact rests of sums and products (Knuth, Dekker), and the exact residual of quotients.
TEST(Enclosure, OfTwoNumbersHoldsTheExactResult) {
  SomeDoubles doubles;
  for (int trial = 0; trial < 200000; ++trial) {
    const double a = doubles.next(), b = doubles.next();
    const double sum = a + b, of_b = sum - a, rest = (a - (sum - of_b)) + (b - of_b);
    if (std::isfinite(sum)) expect_holds(Enclosure(a) + Enclosure(b), sum, rest);
    const double product = a * b;
    if (std::isfinite(product) && std::abs(product) > 1e-280)
      expect_holds(Enclosure(a) * Enclosure(b), product, std::fma(a, b, -product));
    const double quotient = a / b;
    if (std::abs(quotient) < 1e280 && std::abs(quotient) > 1e-280 && std::abs(a) > 1e-250)
      expect_holds(Enclosure(a) / Enclosure(b), quotient,
                   std::fma(-quotient, b, a) * (b > 0.0 ? 1.0 : -1.0));
  }
}

/// Of wider ones what any two numbers inside give.
TEST(Enclosure, HoldsWhatAnyNumbersInsideGive) {
  SomeDoubles doubles;
  std::mt19937 random(9);
  const auto inside = [&](const Enclosure& x) {
    const double share = static_cast<double>(random() % 5) / 4.0;
    return std::clamp(x.lower() + share * (x.upper() - x.lower()), x.lower(), x.upper());
  };
  const auto some = [&] {
    const double one = std::clamp(doubles.next(), -1e100, 1e100);
    const double other = std::clamp(doubles.next(), -1e100, 1e100);
    return Enclosure(std::min(one, other), std::max(one, other));
  };
  for (int trial = 0; trial < 50000; ++trial) {
    const Enclosure a = some(), b = some();
    const double x = inside(a), y = inside(b);
    EXPECT_TRUE((a + b).contains(x + y));
    EXPECT_TRUE((a - b).contains(x - y));
    EXPECT_TRUE((a * b).contains(x * y));
    if (y != 0.0) {
      EXPECT_TRUE((a / b).contains(x / y));
    }
    EXPECT_TRUE(square(a).contains(x * x));
    EXPECT_TRUE(abs(a).contains(std::abs(x)));
    EXPECT_TRUE((-a).contains(-x));
    EXPECT_LE(std::abs(x - a.middle()), a.radius());
    EXPECT_LE(std::abs(x), a.magnitude());
  }
}

TEST(Enclosure, KnowsNothingWhereNothingCanBeKnown) {
  const auto knows_nothing = [](const Enclosure& x) {
    return x.lower() == -infinity && x.upper() == infinity;
  };
  EXPECT_TRUE(knows_nothing(Enclosure(1.0) / Enclosure(-1.0, 2.0)));
  EXPECT_TRUE(knows_nothing(Enclosure(1.0) / Enclosure(0.0)));
  EXPECT_TRUE(knows_nothing(Enclosure(std::numeric_limits<double>::quiet_NaN())));
  EXPECT_TRUE(knows_nothing(Enclosure(2.0, 1.0)));
  EXPECT_TRUE(knows_nothing(Enclosure(0.0) * Enclosure::unknown()));
  EXPECT_TRUE(knows_nothing(Enclosure::unknown() - Enclosure::unknown()));
  EXPECT_EQ((Enclosure(1e308) * Enclosure(1e308)).upper(), infinity);
  EXPECT_LT((Enclosure(1e308) * Enclosure(1e308)).lower(), infinity);
  EXPECT_FALSE(Enclosure(-1e-320, 1.0).is_positive());
  EXPECT_FALSE(Enclosure(0.0, 1.0).is_positive());
  EXPECT_TRUE(Enclosure(1e-320, 1.0).is_positive());
  EXPECT_FALSE(Enclosure(-1.0, 0.0).is_negative());
}

TEST(Enclosure, OfADecimalHoldsItAndHardlyMore) {
  // 0.1 is no double: 10 · 0.1 is 1 for the decimal alone.
  const Enclosure tenth = Enclosure::of_decimal(0.1);
  EXPECT_TRUE((tenth * Enclosure(10.0)).contains(1.0));
  EXPECT_LT(tenth.lower(), 0.1);
  EXPECT_GT(tenth.upper(), 0.1);
  EXPECT_TRUE(Enclosure::of_decimal(0.0) == Enclosure(0.0));
}

TEST(Enclosure, IntersectionOfWhatDoesNotMeetKnowsNothing) {
  EXPECT_TRUE(intersection(Enclosure(0.0, 2.0), Enclosure(1.0, 3.0)) == Enclosure(1.0, 2.0));
  EXPECT_TRUE(intersection(Enclosure(0.0, 1.0), Enclosure(2.0, 3.0)) == Enclosure::unknown());
}

}  // namespace
}  // namespace holdfast
