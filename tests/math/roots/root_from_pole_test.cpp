// Following a root from a pole, against roots in closed form.

#include "holdfast/math/roots/root_from_pole.hpp"

#include "support/testing.hpp"

namespace holdfast::test {
namespace {

using Complex = std::complex<double>;

/// 1 = g of k/((s − a)(s − b)): the roots of a quadratic.
TEST(RootFromPole, OfTwoPolesIsARootOfTheQuadratic) {
  const Complex a(-1.0, 2.0), b(-0.5, 5.0), k(0.7, 0.3);
  const auto gain = [&](const Complex& s) { return k / ((s - a) * (s - b)); };
  const Complex half = (a + b) / 2.0, root = std::sqrt((a - b) * (a - b) / 4.0 + k);
  for (const Complex& begin : {a, b}) {
    const Complex found = root_from_pole(gain, begin);
    EXPECT_LT(std::min(std::abs(found - half - root), std::abs(found - half + root)), 1e-12);
  }
  EXPECT_GT(std::abs(root_from_pole(gain, a) - root_from_pole(gain, b)), 1.0);
}

/// So weak a pole moves by its residue alone: r/(1 − b) for g = r/(s − p) + b.
TEST(RootFromPole, AWeakPoleMovesByItsResidue) {
  const Complex pole(-0.2, 3.0), rest(0.3, -0.4);
  for (const double weak : {0.0, 1e-12, 1e-9}) {
    const Complex residue = weak * Complex(1.0, 2.0);
    const auto gain = [&](const Complex& s) { return residue / (s - pole) + rest; };
    const Complex expected = pole + residue / (1.0 - rest);
    EXPECT_LT(std::abs(root_from_pole(gain, pole) - expected), 1e-13 + 1e-5 * weak) << weak;
  }
}

/// s² + 2s + 1 + 4(1 − ε): a pair that meets on the real axis at ε = 1 + …; beyond, two real roots.
TEST(RootFromPole, GoesPastAMeetingOnTheRealAxis) {
  const Complex pole(-1.0, 2.0);
  const auto gain = [&](const Complex& s) { return 4.5 / ((s - pole) * (s - std::conj(pole))); };
  // (s + 1)² = −4 + 4.5.
  const Complex found = root_from_pole(gain, pole);
  EXPECT_NEAR(std::abs(found.real() + 1.0), std::sqrt(0.5), 1e-9);
  EXPECT_NEAR(found.imag(), 0.0, 1e-9);
}

}  // namespace
}  // namespace holdfast::test
