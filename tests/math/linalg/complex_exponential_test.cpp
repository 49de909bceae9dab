// e^x − 1 and its integral of complex numbers, against extended precision and the definition.

#include "holdfast/math/linalg/complex_exponential.hpp"

#include "support/testing.hpp"

namespace holdfast::test {
namespace {

using Complex = std::complex<double>;
using Wide = std::complex<long double>;

double relative_error(const Complex& found, const Wide& expected) {
  return static_cast<double>(std::abs(Wide(found) - expected) / std::abs(expected));
}

/// Σ xⁿ/n!, n ≥ 1, of a small number.
Wide series(const Wide& x) {
  Wide sum(0), term(1);
  for (int n = 1; n < 40; ++n) sum += term *= x / static_cast<long double>(n);
  return sum;
}

TEST(ComplexExponential, LosesNothingNearZero) {
  for (const double size : {1e-300, 1e-16, 1e-9, 1e-4, 0.1, 1.0}) {
    for (const Complex& direction :
         {Complex(1, 0), Complex(0, 1), Complex(-1, 2), Complex(1, -1)}) {
      const Complex x = size * direction;
      EXPECT_LT(relative_error(complex_expm1(x), series(Wide(x))), 4e-16) << x;
    }
    EXPECT_LT(relative_error(circle_increment(size), series(Wide(0, size))), 4e-16) << size;
  }
}

TEST(ComplexExponential, IsThatOfTheLibraryElsewhere) {
  for (const Complex& x : {Complex(2, 3), Complex(-5, 1), Complex(0.5, -20)})
    EXPECT_LT(relative_error(complex_expm1(x), std::exp(Wide(x)) - 1.0L), 1e-15) << x;
  EXPECT_EQ(circle_increment(0.0), Complex(0));
}

TEST(ComplexExponential, IntegralIsTheLengthWhereNothingGrows) {
  EXPECT_EQ(exponential_integral(Complex(0), 0.3), Complex(0.3));
  EXPECT_LT(std::abs(exponential_integral(Complex(0, 1e-18), 0.3) - 0.3), 1e-16);
  const Complex s(-2.0, 7.0);
  EXPECT_LT(std::abs(exponential_integral(s, 0.3) * s - (std::exp(0.3 * s) - 1.0)), 1e-15);
}

}  // namespace
}  // namespace holdfast::test
