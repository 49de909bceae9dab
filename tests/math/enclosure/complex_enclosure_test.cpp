// Discs of complex numbers against long doubles, in which their arguments and results are taken
// from all of the discs.

#include "holdfast/math/enclosure/complex_enclosure.hpp"

#include "support/random.hpp"

namespace holdfast::test {
namespace {

using Long = std::complex<long double>;

/// A disc of some size and radius, and a number in it: at its middle, within, or on its rim.
struct Sample {
  ComplexEnclosure disc;
  Long number;
};

Long number_in(const ComplexEnclosure& disc, Random& random) {
  const long double share = random.unit() < 0.5 ? 1.0L : static_cast<long double>(random.unit());
  const auto angle = static_cast<long double>(random.uniform(0.0, 6.2831853));
  // Just within: the rim itself is rounded.
  const long double within = share * (1.0L - 4e-19L) * static_cast<long double>(disc.radius());
  return Long(disc.middle()) + std::polar(within, angle);
}

Sample sample(Random& random, double least = 1e-3, double most = 1e3, double relative = 0.3) {
  const std::complex<double> centre =
      std::polar(random.log_uniform(least, most), random.uniform(0.0, 6.2831853));
  const double radius = random.unit() < 0.3 ? 0.0 : random.log_uniform(1e-17, relative);
  const ComplexEnclosure disc(centre, radius * std::abs(centre));
  return {disc, number_in(disc, random)};
}

/// @param slack  of long doubles, relative
void expect_holds(const ComplexEnclosure& disc, const Long& number, const char* what) {
  const long double away = std::abs(number - Long(disc.middle()));
  EXPECT_LE(away, static_cast<long double>(disc.radius()) + 4e-19L * std::abs(number)) << what;
}

TEST(ComplexEnclosure, OperationsHoldWhatTheyAreOf) {
  Random random(1);
  for (int trial = 0; trial < 100000; ++trial) {
    const auto [a, x] = sample(random);
    const auto [b, y] = sample(random);
    expect_holds(a + b, x + y, "sum");
    expect_holds(a - b, x - y, "difference");
    expect_holds(a * b, x * y, "product");
    expect_holds(a / b, x / y, "quotient");
    expect_holds(inverse(b), 1.0L / y, "inverse");
    expect_holds(conj(a), std::conj(x), "conjugate");
    expect_holds(a.times_i(), Long(0.0L, 1.0L) * x, "i a");
    const Enclosure real = a.real(), imaginary = a.imaginary();
    EXPECT_LE(real.lower(), x.real());
    EXPECT_GE(real.upper(), x.real());
    EXPECT_LE(imaginary.lower(), x.imag());
    EXPECT_GE(imaginary.upper(), x.imag());
    EXPECT_GE(a.magnitude(), std::abs(x));
    EXPECT_LE(a.least_modulus(), std::abs(x));
  }
}

/// On the rims that are farthest: where the arguments' own directions add up.
TEST(ComplexEnclosure, ProductsAndQuotientsHoldTheirFarthestPoints) {
  Random random(2);
  for (int trial = 0; trial < 20000; ++trial) {
    const auto a = sample(random).disc, b = sample(random).disc;
    const auto outward = [](const ComplexEnclosure& disc, long double sign) {
      const Long centre(disc.middle());
      return centre * (1.0L + sign * (1.0L - 4e-19L) * static_cast<long double>(disc.radius()) /
                                  std::abs(centre));
    };
    expect_holds(a * b, outward(a, 1.0L) * outward(b, 1.0L), "product");
    expect_holds(inverse(a), 1.0L / outward(a, -1.0L), "inverse");
    EXPECT_GE(a.magnitude(), std::abs(outward(a, 1.0L)));
    EXPECT_LE(a.least_modulus(), std::abs(outward(a, -1.0L)));
  }
}

/// A few roundings wide where the arguments are doubles, after a hundred products too.
TEST(ComplexEnclosure, IsNarrow) {
  Random random(3);
  for (int trial = 0; trial < 1000; ++trial) {
    const ComplexEnclosure a(sample(random).disc.middle(), 0.0);
    const ComplexEnclosure b(sample(random).disc.middle(), 0.0);
    EXPECT_LT((a * b).radius(), 1.2e-15 * (a * b).magnitude());
    EXPECT_LT((a / b).radius(), 3e-15 * (a / b).magnitude());
    EXPECT_LT((a + b).radius(), 2.3e-16 * (a.magnitude() + b.magnitude()));
  }
  const ComplexEnclosure turn({0.6, 0.8}, 1e-15);
  EXPECT_LT(power(turn, 100).radius(), 2e-13);
}

TEST(ComplexEnclosure, PowersHoldRepeatedProducts) {
  Random random(4);
  for (int trial = 0; trial < 2000; ++trial) {
    const auto [a, x] = sample(random, 0.5, 2.0, 1e-3);
    Long product(1.0L);
    for (int count = 0; count < 12; ++count, product *= x)
      expect_holds(power(a, count), product, "power");
  }
}

TEST(ComplexEnclosure, ExponentialsHoldThoseOfLongDoubles) {
  Random random(5);
  for (int trial = 0; trial < 5000; ++trial) {
    const auto [a, x] = sample(random, 1e-6, 30.0, trial % 2 == 0 ? 1e-15 : 0.02);
    const ComplexEnclosure e = exponential(a);
    // Of long doubles themselves the argument's digits are lost.
    const long double away = std::abs(std::exp(x) - Long(e.middle()));
    EXPECT_LE(away, static_cast<long double>(e.radius()) + 1e-17L * std::abs(std::exp(x)));
    EXPECT_LT(e.radius(), (3.0 * a.radius() + 1e-10) * e.magnitude());
  }
  // Where the bound itself is near: e^r − 1 against r/(1 − r).
  for (const double r : {1e-9, 0.01, 0.3, 0.9})
    EXPECT_GE(exponential(ComplexEnclosure(0.0, r)).radius(), std::expm1(r));
}

TEST(ComplexEnclosure, WhatHasNoBoundIsUnknown) {
  const double infinity = std::numeric_limits<double>::infinity();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(inverse(ComplexEnclosure({1.0, 1.0}, 1.5)).radius(), infinity);
  EXPECT_EQ(inverse(ComplexEnclosure(0.0)).radius(), infinity);
  EXPECT_EQ(ComplexEnclosure({nan, 0.0}, 0.0).radius(), infinity);
  EXPECT_EQ(ComplexEnclosure({0.0, infinity}, 0.0).radius(), infinity);
  EXPECT_EQ(ComplexEnclosure(0.0, nan).radius(), infinity);
  EXPECT_EQ(ComplexEnclosure(0.0, -1.0).radius(), infinity);
  EXPECT_EQ(exponential(ComplexEnclosure(0.0, 1.0)).radius(), infinity);
  EXPECT_EQ(exponential(ComplexEnclosure({1e9, 0.0}, 0.0)).radius(), infinity);
  EXPECT_EQ((ComplexEnclosure({1e200, 0.0}, 0.0) * ComplexEnclosure({1e200, 0.0}, 0.0)).radius(),
            infinity);
  EXPECT_EQ(ComplexEnclosure(Enclosure::unknown()).radius(), infinity);
  EXPECT_EQ(ComplexEnclosure(0.0, infinity).least_modulus(), 0.0);
  // Too small for its square: nothing is said to be above 0 that may not be.
  EXPECT_LE(ComplexEnclosure({3e-300, 4e-300}, 0.0).least_modulus(), 5e-300);
  EXPECT_GE(ComplexEnclosure({3e-300, 4e-300}, 0.0).magnitude(), 5e-300);
  EXPECT_GT((ComplexEnclosure({3e-170, 0.0}, 0.0) * ComplexEnclosure({4e-170, 0.0}, 0.0)).radius(),
            0.0);
}

TEST(ComplexEnclosure, OfTwoEnclosuresHoldsTheRectangle) {
  const ComplexEnclosure a(Enclosure(1.0, 2.0), Enclosure(-1.0, 1.0));
  for (const double x : {1.0, 2.0})
    for (const double y : {-1.0, 1.0}) expect_holds(a, {x, y}, "corner");
  EXPECT_LT(ComplexEnclosure(Enclosure(3.0)).radius(), 1e-270);
}

}  // namespace
}  // namespace holdfast::test
