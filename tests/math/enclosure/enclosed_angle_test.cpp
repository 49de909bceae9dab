#include "holdfast/math/enclosure/enclosed_angle.hpp"

#include "support/random.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

bool holds(const Enclosure& enclosure, long double value) {
  return static_cast<long double>(enclosure.lower()) <= value &&
         value <= static_cast<long double>(enclosure.upper());
}

TEST(EnclosedAngle, HoldsCosineAndSineOfExtendedPrecision) {
  test::Random random(5);
  for (int trial = 0; trial < 20000; ++trial) {
    const double x = random.sign() * random.log_uniform(1e-9, 1e5);
    const Enclosure cosine = cos(Enclosure(x)), sine = sin(Enclosure(x));
    const auto exact = static_cast<long double>(x);
    EXPECT_TRUE(holds(cosine, std::cos(exact))) << x;
    EXPECT_TRUE(holds(sine, std::sin(exact))) << x;
    EXPECT_LT(cosine.radius(), 1e-15 + 5e-16 * std::abs(x)) << x;
    EXPECT_LT(sine.radius(), 1e-15 + 5e-16 * std::abs(x)) << x;
  }
}

TEST(EnclosedAngle, HoldsThoseOfEveryAngleInside) {
  test::Random random(6);
  for (int trial = 0; trial < 5000; ++trial) {
    const double from = random.uniform(-20.0, 20.0), width = random.log_uniform(1e-8, 5.0);
    const Enclosure angle(from, from + width);
    const double x = std::min(from + random.unit() * width, angle.upper());
    EXPECT_TRUE(holds(cos(angle), std::cos(static_cast<long double>(x))));
    EXPECT_TRUE(holds(sin(angle), std::sin(static_cast<long double>(x))));
    EXPECT_GE(cos(angle).lower(), -1.0);
    EXPECT_LE(sin(angle).upper(), 1.0);
  }
}

/// With so few factors that what is left of the series shows.
TEST(EnclosedAngle, SeriesThatAreCutShortHoldTheirSums) {
  for (const int factors : {1, 2, 3})
    for (const double y : {0.1, 0.5, 0.9, 1.0}) {
      const auto squared = square(Enclosure(y));
      EXPECT_TRUE(holds(detail::nested_series(squared, 1.0, factors), std::cos(1.0L * y)));
      EXPECT_TRUE(
          holds(Enclosure(y) * detail::nested_series(squared, 2.0, factors), std::sin(1.0L * y)));
    }
}

TEST(EnclosedAngle, KnowsNothingOfWhatIsTooLarge) {
  for (const Enclosure& angle : {Enclosure(1e7), Enclosure::unknown()}) {
    EXPECT_EQ(cos(angle), Enclosure(-1.0, 1.0));
    EXPECT_EQ(sin(angle), Enclosure(-1.0, 1.0));
  }
}

TEST(EnclosedAngle, PiLiesBetweenItsBounds) {
  EXPECT_TRUE(holds(pi<Enclosure>, pi<long double>));
  EXPECT_EQ(pi<Enclosure>.upper(), std::nextafter(pi<Enclosure>.lower(), 4.0));
}

}  // namespace
}  // namespace holdfast
