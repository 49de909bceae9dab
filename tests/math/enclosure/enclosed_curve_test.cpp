#include <functional>

#include "holdfast/math/enclosure/enclosed_angle.hpp"
#include "holdfast/math/enclosure/enclosed_curve.hpp"

#include "support/random.hpp"

namespace holdfast {
namespace {

using Exact = std::complex<long double>;

/// A curve in extended precision.
using ExactCurve = std::function<Exact(long double)>;

struct TriedCurve {
  ExactCurve exact;
  EnclosedCurve enclosed;
};

std::complex<double> random_point(test::Random& random, double size) {
  return std::polar(random.log_uniform(0.1, 1.0) * size, random.uniform(0.0, 2.0 * pi<double>));
}

/// A number inside a disc about a random centre, and the disc.
std::pair<Exact, ComplexEnclosure> random_disc(test::Random& random, double size) {
  const std::complex<double> centre = random_point(random, size);
  const double radius = size * random.log_uniform(1e-12, 1e-2);
  const std::complex<double> inside = random_point(random, 0.9 * radius);
  return {Exact(centre) + Exact(inside), {centre, radius}};
}

struct TriedSpiral {
  Exact start, rate;
  EnclosedSpiral enclosed;

  Exact at(long double t) const { return start * std::exp(rate * t); }
  TriedCurve curve() const {
    return {[z = *this](long double t) { return z.at(t); }, enclosed.curve()};
  }
};

TriedSpiral random_spiral(test::Random& random, double fastest) {
  const auto [start, start_disc] = random_disc(random, random.log_uniform(0.1, 3.0));
  const auto [rate, rate_disc] = random_disc(random, random.log_uniform(1e-4, fastest));
  return {start, rate, {start_disc, rate_disc}};
}

/// Value, slope, Taylor's rest and moduli, at places along the curve.
void expect_holds(const TriedCurve& curve) {
  const EnclosedCurve& z = curve.enclosed;
  const auto apart = [](const Exact& number, const ComplexEnclosure& disc) {
    return std::abs(number - Exact(disc.middle())) - static_cast<long double>(disc.radius());
  };
  EXPECT_LE(apart(curve.exact(0.0L), z.value()), 0.0L);
  for (const long double t : {-1.0L, -0.6L, -0.2L, 0.2L, 0.7L, 1.0L}) {
    const Exact here = curve.exact(t);
    const Exact line = Exact(z.value().middle()) + t * Exact(z.slope().middle());
    const long double known = z.value().radius() + std::abs(t) * z.slope().radius();
    EXPECT_LE(std::abs(here - line), known + 0.5L * t * t * z.bend() + 1e-17L);
    EXPECT_LE(std::abs(here), z.most());
    EXPECT_GE(std::abs(here), z.least());
    const Exact slope = (curve.exact(t + 1e-4L) - curve.exact(t - 1e-4L)) / 2e-4L;
    EXPECT_LE(std::abs(slope), z.steepest() * (1.0L + 1e-7L) + 1e-12L);
  }
}

TEST(EnclosedCurve, SpiralsAreHeld) {
  test::Random random(31);
  for (int trial = 0; trial < 2000; ++trial) {
    const TriedSpiral spiral = random_spiral(random, 3.0);
    expect_holds(spiral.curve());
    const int power = static_cast<int>(random.index(4));
    expect_holds({[&](long double t) { return std::pow(spiral.at(t), power); },
                  spiral.enclosed.to_the(power).curve()});
    expect_holds(
        {[&](long double t) { return std::conj(spiral.at(t)); }, conj(spiral.enclosed).curve()});
    for (const long double t : {-1.0L, 0.4L, 1.0L}) {
      EXPECT_LE(std::abs(spiral.at(t)), spiral.enclosed.most());
      EXPECT_LE(std::abs(spiral.at(t) - Exact(spiral.enclosed.start().middle())),
                spiral.enclosed.way() + spiral.enclosed.start().radius());
    }
  }
}

TEST(EnclosedCurve, OperationsHoldTheirResults) {
  test::Random random(32);
  for (int trial = 0; trial < 2000; ++trial) {
    const TriedSpiral a = random_spiral(random, 0.5), b = random_spiral(random, 0.5);
    const EnclosedCurve x = a.enclosed.curve(), y = b.enclosed.curve();
    expect_holds({[&](long double t) { return a.at(t) + b.at(t); }, x + y});
    expect_holds({[&](long double t) { return a.at(t) - b.at(t); }, x - y});
    expect_holds({[&](long double t) { return a.at(t) * b.at(t); }, x * y});
    expect_holds({[&](long double t) { return Exact(1) / a.at(t); }, inverse(x)});
    expect_holds(
        {[&](long double t) { return a.at(t) - b.at(t); }, difference(a.enclosed, b.enclosed)});
    expect_holds(
        {[&](long double t) { return a.at(t) * (b.at(t) - a.at(t)) / (a.at(t) + Exact(9)); },
         x * (y - x) * inverse(x + ComplexEnclosure(9.0))});
  }
}

/// Of numbers that are exact the bounds are next to what they bound.
TEST(EnclosedCurve, IsSharp) {
  const auto exact = [](double x, double y) { return ComplexEnclosure({x, y}, 0.0); };
  const EnclosedSpiral slow(exact(1.0, 0.0), exact(0.0, 0.01)), same(exact(0.9, 0.0), slow.rate());
  EXPECT_NEAR(slow.curve().bend(), 1e-4, 1e-9);
  EXPECT_NEAR(slow.most(), 1.0, 1e-14);
  EXPECT_LT(difference(slow, same).bend(), 1.02e-5) << "they turn as one";
  EXPECT_LT((slow.curve() * same.curve()).bend(), 3.7e-4);
  EXPECT_LT(inverse(slow.curve()).bend(), 3.2e-4);
  EXPECT_GT(slow.curve().least(), 0.98);
  const EnclosedSpiral dead(exact(1e-30, 0.0), exact(-20.0, 0.0));
  EXPECT_LT(difference(slow, dead).bend(), 1.01e-4) << "what has died out does not count";
}

TEST(EnclosedCurve, WhatMayPassZeroHasNoInverse) {
  const EnclosedCurve through({{0.1, 0.0}, 0.0}, {{0.2, 0.0}, 0.0}, 0.0);
  EXPECT_EQ(through.least(), 0.0);
  EXPECT_FALSE(std::isfinite(inverse(through).bend()));
  EXPECT_FALSE(std::isfinite(inverse(through).most()));
  const EnclosedCurve nothing({}, {}, std::numeric_limits<double>::quiet_NaN());
  EXPECT_FALSE(std::isfinite(nothing.most()));
}

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
