// The proof that a moving spectrum stays inside, against spectra of the matrices covered.

#include "holdfast/math/linalg/moving_spectrum.hpp"

#include "support/dense_routes.hpp"
#include "support/random.hpp"

namespace holdfast::test {
namespace {

Eigen::MatrixXd normal_entries(Random& random, Eigen::Index n) {
  Eigen::MatrixXd m(n, n);
  for (auto& entry : m.reshaped()) entry = random.normal();
  return m;
}

double radius_of(const Eigen::MatrixXd& matrix) { return moduli_of(matrix)[0]; }

/// S(0) of a spectral radius, whose eigenvalues move by about `step` over the stretch.
TaylorMatrix drawn_stretch(Random& random, Eigen::Index n, double radius, double step) {
  const Eigen::MatrixXd centre = normal_entries(random, n);
  TaylorMatrix moving{{centre * (radius / radius_of(centre)) - Eigen::MatrixXd::Identity(n, n)},
                      1e-3 * step * normal_entries(random, n).cwiseAbs()};
  double size = step;
  for (int k = 1; k <= 4; ++k, size *= 0.3)
    moving.terms.push_back(size / std::sqrt(static_cast<double>(n)) * normal_entries(random, n));
  return moving;
}

/// S(x) with a share of the remainder, of which any sign may be the true one.
Eigen::MatrixXd matrix_at(const TaylorMatrix& moving, double x, Random& random) {
  const Eigen::Index n = moving.remainder.rows();
  Eigen::MatrixXd sum = moving.terms.back();
  for (std::size_t k = moving.terms.size() - 1; k > 0; --k)
    sum = (x * sum + moving.terms[k - 1]).eval();
  Eigen::MatrixXd signs = normal_entries(random, n).cwiseSign();
  return Eigen::MatrixXd::Identity(n, n) + sum + signs.cwiseProduct(moving.remainder);
}

/// The largest radius among 41 matrices of the stretch.
double sampled_radius(const TaylorMatrix& moving, Random& random) {
  double largest = 0.0;
  for (int i = -20; i <= 20; ++i)
    largest = std::max(largest, radius_of(matrix_at(moving, i / 20.0, random)));
  return largest;
}

TEST(MovingSpectrum, NoMatrixOfAProvedStretchHasARootOutside) {
  Random random(310);
  int proved = 0, left = 0;
  for (int draw = 0; draw < 400; ++draw) {
    const auto n = static_cast<Eigen::Index>(1 + random.index(8));
    const double gap = 1.0 / random.log_uniform(1.0, 1000.0);
    const TaylorMatrix moving =
        drawn_stretch(random, n, 1.0 - gap, gap * std::exp(random.uniform(-5.0, 2.0)));
    const MovingSpectrum roots(moving);
    EXPECT_TRUE(roots.inside_at_centre()) << draw;
    const double largest = sampled_radius(moving, random);
    EXPECT_TRUE(!roots.inside() || largest < 1.0) << draw;
    proved += roots.inside() ? 1 : 0;
    left += largest >= 1.0 ? 1 : 0;
  }
  EXPECT_GT(proved, 100);  // or the test shows nothing
  EXPECT_GT(left, 50);
}

// What moves little against its distance to the circle is decided: the proof is not an empty one.
TEST(MovingSpectrum, ProvesWhatMovesLittle) {
  Random random(311);
  for (int draw = 0; draw < 100; ++draw) {
    const double gap = std::exp(random.uniform(-6.0, 0.0));
    const TaylorMatrix moving = drawn_stretch(random, 5, 1.0 - gap, 1e-4 * gap);
    EXPECT_TRUE(MovingSpectrum<double>(moving).inside()) << draw;
  }
}

// A double root at the centre has no basis of eigenvectors, and must not need one.
TEST(MovingSpectrum, TakesRootsThatCoincide) {
  TaylorMatrix moving{{Eigen::MatrixXd::Zero(3, 3)}, Eigen::MatrixXd::Zero(3, 3)};
  moving.terms[0] << -0.5, 0.1, 0.0, 0.0, -0.5, 0.1, 0.0, 0.0, -0.5;
  moving.terms.emplace_back(0.01 * Eigen::MatrixXd::Ones(3, 3));
  EXPECT_TRUE(MovingSpectrum<double>(moving).inside());
  moving.remainder.setConstant(0.3);  // 0.5 + 0.9 is outside
  EXPECT_FALSE(MovingSpectrum<double>(moving).inside());
}

TEST(MovingSpectrum, WhatIsOutsideOrNotFiniteHasNoProof) {
  Random random(312);
  TaylorMatrix moving = drawn_stretch(random, 4, 1.01, 1e-6);
  EXPECT_FALSE(MovingSpectrum<double>(moving).inside_at_centre());
  moving = drawn_stretch(random, 4, 0.5, 1e-6);
  moving.remainder(2, 1) = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(MovingSpectrum<double>(moving).inside());
  moving.terms[0](0, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(MovingSpectrum<double>(moving).inside_at_centre());
}

// c (λI − S)⁻¹ g from its moving sums, against a dense solution at each x.
TEST(MovingSpectrum, ResponsesHoldAllOverTheStretch) {
  Random random(313);
  const std::complex<double> turn(0.0, 0.02);
  for (int draw = 0; draw < 60; ++draw) {
    const Eigen::Index n = 5;
    TaylorMatrix moving = drawn_stretch(random, n, 0.9, 1e-3);
    const MovingSpectrum roots(moving);
    ASSERT_TRUE(roots.inside()) << draw;
    const double angle = random.uniform(-3.0, 3.0);
    TaylorNumber from_one{{}, std::pow(0.02, 5) / 120.0};
    MovingVector source{{}, Eigen::VectorXd::Zero(n)};
    std::complex<double> term = std::polar(1.0, angle);
    for (std::size_t k = 0; k < 5; ++k) {
      from_one.terms.push_back(k == 0 ? term - 1.0 : term);
      term *= turn / static_cast<double>(k + 1);
      source.terms.emplace_back(std::pow(0.05, static_cast<double>(k)) *
                                normal_entries(random, n).col(0).cast<std::complex<double>>());
    }
    const Eigen::MatrixXd rows = normal_entries(random, n).topRows(2);
    const std::vector<TaylorNumber> answers = roots.responses(from_one, source, rows);
    ASSERT_EQ(answers.size(), 2U);
    for (const double x : {-1.0, -0.4, 0.0, 0.7, 1.0}) {
      Eigen::VectorXcd g = Eigen::VectorXcd::Zero(n);
      for (std::size_t k = 5; k > 0; --k) g = x * g + source.terms[k - 1];
      const std::complex<double> on_circle = std::polar(1.0, angle + 0.02 * x);
      const Eigen::MatrixXcd shifted =
          on_circle * Eigen::MatrixXd::Identity(n, n) - matrix_at(moving, x, random);
      const Eigen::VectorXcd expected = rows.cast<std::complex<double>>() * solution_of(shifted, g);
      for (Eigen::Index i = 0; i < 2; ++i) {
        const TaylorNumber& answer = answers[static_cast<std::size_t>(i)];
        std::complex<double> sum = 0.0;
        for (std::size_t k = answer.terms.size(); k > 0; --k) sum = x * sum + answer.terms[k - 1];
        EXPECT_LE(std::abs(sum - expected[i]), answer.remainder + 1e-12 * answer.size())
            << draw << ' ' << x;
        EXPECT_LT(answer.remainder, 0.1 * (1.0 + answer.size())) << draw;
      }
    }
  }
}

}  // namespace
}  // namespace holdfast::test
