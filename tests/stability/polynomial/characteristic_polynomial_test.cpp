#include "holdfast/stability/polynomial/characteristic_polynomial.hpp"

#include "holdfast/math/linalg/spectral_radius.hpp"
#include "support/dense_routes.hpp"
#include "support/random_loop.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

using Complex = std::complex<double>;

/// |p(x)| relative to the sum of the moduli of its terms, on the circle through x or at least 1.
template <class Coefficients>
double relative_value(const Coefficients& p, const Complex& x) {
  double size = 0, power = 1;
  for (int k = 0; k < p.size(); ++k, power *= std::max(1.0, std::abs(x)))
    size += std::abs(p[k]) * power;
  return std::abs(evaluate(p, x)) / size;
}

TEST(CharacteristicPolynomial, TheEigenvaluesOfTheLoopAreItsRoots) {
  test::Random random(191);
  for (int draw = 0; draw < 2000; ++draw) {
    const auto plant = test::random_plant(random);
    const auto sampling = test::random_sampling(plant, random);
    const auto gains = test::random_gains(plant, sampling.period, random);
    const auto loop = sampled_loop(plant, sampling);
    const auto in_mu = characteristic_polynomial(loop).at(gains);
    const auto in_lambda = shifted(in_mu, -1.0);
    Matrix<double, 5> shifted = loop.engaged_map(gains);
    shifted.topLeftCorner<4, 4>() = loop.increment + loop.present_force * gains.feedback_row();
    shifted(4, 4) = -1.0;
    const Vector<Complex, 5> mu = detail::balanced_eigenvalues<double, 5>(shifted);
    for (const Complex& root : mu) {
      EXPECT_LE(relative_value(in_mu, root), 1e-10);
      EXPECT_LE(relative_value(in_lambda, root + 1.0), 1e-10);
    }
  }
}

/// |p(x) − det((c + x) I − S)| over the sum of the moduli of the terms of p.
template <int Degree>
long double off_determinant(const Polynomial<long double, Degree>& p,
                            const Matrix<long double, Degree>& map,
                            const std::complex<long double>& x, long double centre) {
  using Square = Matrix<std::complex<long double>, Degree>;
  const Square shifted =
      (x + centre) * Square::Identity() - map.template cast<std::complex<long double>>();
  long double size = 0, power = 1;
  for (int k = 0; k <= Degree; ++k, power *= std::abs(x)) size += std::abs(p[k]) * power;
  return std::abs(evaluate(p, x) - test::determinant_of(shifted)) / size;
}

TEST(CharacteristicPolynomial, IsTheDeterminantOfTheSampledLoop) {
  test::Random random(192);
  for (int draw = 0; draw < 500; ++draw) {
    const auto plant = test::random_plant(random);
    const auto sampling = test::random_sampling(plant, random);
    const auto gains = test::random_gains(plant, sampling.period, random);
    const auto loop = test::precise_loop(plant, sampling);
    const PdGains<long double> precise{gains.proportional, gains.differential};
    EXPECT_LE(
        off_determinant<5>(characteristic_polynomial(loop).at(precise), loop.engaged_map(precise),
                           {random.uniform(-3, 1), random.uniform(-2, 2)}, 1.0L),
        1e-13L);
  }
}

TEST(CharacteristicPolynomial, IsTheDeterminantOfTheContinuousLoop) {
  test::Random random(193);
  for (int draw = 0; draw < 500; ++draw) {
    const auto plant = converted<long double>(test::random_plant(random));
    const PdGains<long double> gains{random.uniform(-1000, 1000), random.uniform(-100, 100)};
    const auto p = characteristic_polynomial(plant).at(gains);
    EXPECT_LE(
        off_determinant<4>(p, plant.state_matrix() + plant.control_input() * gains.feedback_row(),
                           {random.uniform(-50, 50), random.uniform(-100, 100)}, 0.0L),
        1e-13L);
    EXPECT_EQ(p[4], 1.0L);
  }
}

TEST(CharacteristicPolynomial, WithoutDelayZeroIsAStructuralRoot) {
  const auto loop = sampled_loop(kollar2022_plant(), Sampling<double>{0.01, 0.0});
  EXPECT_LE(std::abs(evaluate(characteristic_polynomial(loop).at({-557, -13}), -1.0)), 1e-12);
  EXPECT_LE(std::abs(shifted(characteristic_polynomial(loop).at({-557, -13}), -1.0)[0]), 1e-12);
}

TEST(CharacteristicPolynomial, VelocityFeedbackMovesNoStaticEquilibrium) {
  const auto continuous = characteristic_polynomial(kollar2022_plant());
  // D stands only before s³; at the plant's 7 Hz that term has this size.
  const double size = std::abs(continuous.differential[3]) * std::pow(44.0, 3);
  EXPECT_NEAR(continuous.differential[0], 0.0, 1e-13 * size);
}

TEST(Polynomial, ShiftedIsTheTaylorShift) {
  test::Random random(194);
  for (int draw = 0; draw < 1000; ++draw) {
    const Vector<double, 6> p = random.matrix<Vector<double, 6>>();
    const Complex mu(random.uniform(-1, 1), random.uniform(-1, 1));
    EXPECT_LE(std::abs(evaluate(shifted(p, -1.0), mu + 1.0) - evaluate(p, mu)), 1e-12);
  }
}

}  // namespace
}  // namespace holdfast
