#include "holdfast/span/span_roots.hpp"

#include <cmath>
#include <complex>
#include <random>

#include "span/drake_span.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

using Complex = std::complex<double>;

/// A string of length 1 whose waves run at 1 and whose impedance is 1.
TautString<double> unit_string(double damping_ratio = 0.0) {
  return {1.0, 1.0, 1.0, damping_ratio};
}

SpanRoot with_dashpot(double place, double damping, int n) {
  const SpanDevice device{place, LumpedDevice{{{damping}}, 0.0}};
  return span_roots(unit_string(), {device}, n).back();
}

/// sin β + i (c/Z_c) sin βa sin β(1 − a), s = iβ.
Complex krenk(const Complex& s, double place, double damping) {
  const Complex beta = s / Complex(0.0, 1.0);
  return std::sin(beta) +
         Complex(0.0, damping) * std::sin(beta * place) * std::sin(beta * (1.0 - place));
}

// Krenk (2000), computed apart with many digits.
TEST(SpanRoots, OfOneDashpotAreKrenks) {
  const auto damping = [](double place, double kappa) {
    return with_dashpot(place, kappa / (pi<double> * place), 1).damping();
  };
  EXPECT_NEAR(damping(0.02, 0.25), 0.00472195100051, 1e-13);
  EXPECT_NEAR(damping(0.02, 1.0), 0.0102114686718, 1e-12);
  EXPECT_NEAR(damping(0.02, 4.0), 0.00472756204958, 1e-13);
  EXPECT_NEAR(damping(0.05, 1.0), 0.0264392727833, 1e-12);
}

TEST(SpanRoots, OfADashpotAtMidSpanAreKnown) {
  // c = Z_c: sin β + i sin²(β/2) = 0 has tan(β/2) = 2i, β = π + i ln 3 for odd n.
  const auto roots = span_roots(unit_string(), {{0.5, LumpedDevice{{{1.0}}, 0.0}}}, 5);
  for (const int n : {1, 3, 5}) {
    const Complex beta = roots[static_cast<std::size_t>(n - 1)].root / Complex(0.0, 1.0);
    EXPECT_NEAR(std::abs(beta - Complex(n * pi<double>, 1.0986122886681098)), 0.0, 1e-10) << n;
  }
  // A node feels nothing.
  EXPECT_NEAR(roots[1].damping(), 0.0, 1e-12);
}

TEST(SpanRoots, OfTenThousandDashpotsSolveTheEquationAndKeepToItsAsymptote) {
  std::mt19937 random(2000);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::uniform_int_distribution<int> modes(1, 8);
  double worst = 0.0;
  for (int k = 0; k < 10000; ++k) {
    const int n = modes(random);
    const double place = 0.002 * std::pow(10.0, unit(random)) / n;
    const double kappa = 0.05 * std::pow(400.0, unit(random));
    const double damping = kappa / (n * pi<double> * place);
    const SpanRoot root = with_dashpot(place, damping, n);
    // The slope of the equation at a root is about 1 + κ.
    EXPECT_LT(std::abs(krenk(root.root, place, damping)), 1e-11 * (1.0 + kappa) * n);
    const double asymptote = place * kappa / (1.0 + kappa * kappa);
    EXPECT_NEAR(root.asymptotic, asymptote, 1e-12);
    worst = std::max(worst, std::abs(root.damping() / asymptote - 1.0) / (n * place));
    EXPECT_LE(root.damping(), 0.5 * place * (1.0 + 8.0 * n * place));
  }
  // Of second order in n a/L, and no less: a test that cannot fail would have 0 here.
  EXPECT_LT(worst, 8.0);
  EXPECT_GT(worst, 0.5);
}

TEST(SpanRoots, OfABareStringAreItsOwn) {
  const auto roots = span_roots(unit_string(0.013), {}, 3);
  for (int n = 1; n <= 3; ++n) {
    const SpanRoot& root = roots[static_cast<std::size_t>(n - 1)];
    EXPECT_NEAR(root.damping(), 0.013, 1e-14);
    EXPECT_NEAR(std::abs(root.root), n * pi<double>, 1e-12);
  }
}

TEST(SpanRoots, OfALightDeviceAreThoseOfFirstOrder) {
  const SpanDevice light{0.13, LumpedDevice{{tuned_branch(1e-6, 1.2, 0.2)}, 1e-7}};
  const auto roots = span_roots(unit_string(), {light, {0.8, LumpedDevice{{{1e-6}}, 0.0}}}, 9);
  for (const SpanRoot& root : roots)
    EXPECT_NEAR(root.damping(), root.first_order, 2e-4 * root.first_order);
}

TEST(SpanRoots, OfTwoDevicesDoNotDependOnTheirOrder) {
  const auto string = drake_string();
  const SpanDevice stock{1.3, stockbridge({4.0, {9.0, 24.0}, {0.15, 0.2}, 0.55, 0.4})};
  const SpanDevice dashpot{298.2, LumpedDevice{{{90.0}}, 0.0}};
  const auto one = span_roots(string, {stock, dashpot}, 120);
  const auto other = span_roots(string, {dashpot, stock}, 120);
  for (std::size_t n = 0; n < one.size(); ++n)
    EXPECT_NEAR(std::abs(one[n].root - other[n].root), 0.0, 1e-10 * std::abs(one[n].root));
  // From the other support they are the same.
  const auto mirrored =
      span_roots(string, {{300.0 - 1.3, stock.device}, {300.0 - 298.2, dashpot.device}}, 120);
  for (std::size_t n = 0; n < one.size(); ++n)
    EXPECT_NEAR(std::abs(one[n].root - mirrored[n].root), 0.0, 1e-9 * std::abs(one[n].root));
}

}  // namespace
}  // namespace holdfast
