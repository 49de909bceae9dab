// Roots of sums over poles, against the eigenvalues of a dense matrix with the same polynomial.

#include "holdfast/math/roots/pole_sum_roots.hpp"

#include <Eigen/Eigenvalues>

#include "support/random.hpp"
#include "support/testing.hpp"

namespace holdfast::test {
namespace {

/// 1 = Σ a_k/(λ − e_k) has the eigenvalues of diag(e) + 1 aᵀ as roots: they are found alone where
/// the coupling is weak, by the iteration where it is strong.
TEST(PoleSumRoots, AreTheEigenvaluesOfTheDenseMatrix) {
  using Complex = std::complex<double>;
  Random random(20260);
  for (double coupling = 1e-6; coupling < 1.0; coupling *= 1.25) {
    PoleSum<double> sum;
    for (int k = 1; k <= 20; ++k) {
      const Complex e = std::polar(1.0 - 0.02 * random.unit(), 0.1 * k + 0.02 * random.unit());
      const Complex a = coupling * 0.1 * Complex(random.normal(), random.normal());
      sum.parts.push_back({e - 1.0, a, 0.0});
      sum.parts.push_back({std::conj(e) - 1.0, std::conj(a), 0.0});
    }
    sum.parts.push_back({-0.3 - 0.2 * random.unit(), coupling * 0.1 * random.normal(), 0.0});
    Eigen::MatrixXcd matrix = Eigen::MatrixXcd::Zero(41, 41);
    for (Eigen::Index k = 0; k < matrix.cols(); ++k) {
      const auto& part = sum.parts[static_cast<std::size_t>(k)];
      matrix.col(k).setConstant(part.present);
      matrix(k, k) += 1.0 + part.increment;
    }
    const Eigen::VectorXcd expected = matrix.eigenvalues();
    const auto roots = pole_sum_roots(sum, false);
    ASSERT_EQ(roots.size(), sum.parts.size());
    Eigen::ArrayXcd all = Eigen::Map<const Eigen::ArrayXcd>(roots.data(), matrix.cols());
    for (const Complex& one : expected) {
      Eigen::Index nearest;
      EXPECT_LT((all - one).abs().minCoeff(&nearest), 1e-12);
      all[nearest] = 9.0;  // each root once
    }
  }
}

/// λ² − 1.6 λ + 0.65: from the real pole the iteration must leave the axis.
TEST(PoleSumRoots, OfOneRealPoleMayBeAPair) {
  const auto roots = pole_sum_roots(PoleSum<double>{{{-0.1, 0.7, -0.65}}}, true);
  ASSERT_EQ(roots.size(), 2U);
  EXPECT_LT(std::abs(roots[0] + roots[1] - 1.6) + std::abs(roots[0] * roots[1] - 0.65), 1e-14);
}

}  // namespace
}  // namespace holdfast::test
