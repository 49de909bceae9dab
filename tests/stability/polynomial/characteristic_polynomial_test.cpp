#include "holdfast/stability/polynomial/characteristic_polynomial.hpp"
#include "holdfast/math/linalg/spectral_radius.hpp"
#include "holdfast/stability/polynomial/dominant_factor.hpp"

#include "support/dense_routes.hpp"
#include "support/random_loop.hpp"

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

/// A monic polynomial in powers of μ = λ − 1 with the roots λ given and λ = 0.
Polynomial<double, 5> polynomial_of_roots(
    const std::vector<std::complex<double>>& roots_in_lambda) {
  std::vector<std::complex<double>> product = {1.0};
  const auto times = [&product](const std::complex<double>& root) {
    product.insert(product.begin(), 0.0);
    for (std::size_t k = 0; k + 1 < product.size(); ++k) product[k] -= root * product[k + 1];
  };
  for (const auto& root : roots_in_lambda) times(root - 1.0);
  times(-1.0);
  Polynomial<double, 5> result;
  for (int k = 0; k <= 5; ++k) result[k] = product[static_cast<std::size_t>(k)].real();
  return result;
}

TEST(QuadraticFactor, GivesTheRadiusOfPairsAndOfRealRoots) {
  // λ = 0.5 ± 0.4i about 1: μ = −0.5 ± 0.4i
  EXPECT_NEAR((QuadraticFactor<double>{1.0, 0.41}.radius()), std::sqrt(0.41), 1e-15);
  // λ = 0.9 and −1.2 about 1: μ = −0.1 and −2.2
  EXPECT_NEAR((QuadraticFactor<double>{2.3, 0.22}.radius()), 1.2, 1e-15);
}

/// A pair and real roots move past one another: each in turn is dominant, and the pair becomes real
/// on the way.
TEST(DominantFactor, FollowsWhicheverRootIsDominant) {
  DominantFactor<double, 5> follower;
  for (int step = 0; step <= 400; ++step) {
    const double t = step / 400.0;
    const std::complex<double> pair = std::polar(0.95 - 0.3 * t, 0.4);
    const double spread = 0.02 - 0.05 * t;  // of a second pair, real from t = 0.4 on
    const std::complex<double> offset =
        spread > 0 ? std::complex<double>(0, std::sqrt(spread)) : std::sqrt(-spread);
    const std::complex<double> other = -0.6 - 0.4 * t + offset;
    const std::vector<std::complex<double>> all = {pair, std::conj(pair), other,
                                                   -0.6 - 0.4 * t - offset};
    double largest = 0.0;
    for (const auto& root : all) largest = std::max(largest, std::abs(root));
    EXPECT_NEAR(follower.radius(polynomial_of_roots(all)), largest, 1e-10) << step;
  }
}

TEST(DominantFactor, DoesNotRestOnThePath) {
  const auto loop = sampled_loop(kollar2022_plant(), Sampling<double>{0.005});
  const auto polynomial = characteristic_polynomial(loop);
  test::Random random(7);
  DominantFactor<double, 5> wandering;
  for (int draw = 0; draw < 1000; ++draw) {
    const PdGains<double> gains{random.uniform(-1000, 200), random.uniform(-40, 20)};
    DominantFactor<double, 5> fresh;
    EXPECT_NEAR(wandering.radius(polynomial.at(gains)), fresh.radius(polynomial.at(gains)), 1e-11);
  }
}

/// Along random rows of random loops, against the loop built and solved in extended precision.
TEST(DominantFactor, AgreesWithExtendedPrecisionAlongRandomRows) {
  test::Random random(20260402);
  double worst = 0.0;
  for (int draw = 0; draw < 200; ++draw) {
    const auto plant = test::random_plant(random);
    const auto sampling = test::random_sampling(plant, random);
    const auto from = test::random_gains(plant, sampling.period, random);
    const auto to = test::random_gains(plant, sampling.period, random);
    const auto polynomial = characteristic_polynomial(sampled_loop(plant, sampling));
    const auto precise = characteristic_polynomial(test::precise_loop(plant, sampling));
    DominantFactor<double, 6> follower;
    for (int step = 0; step <= 50; ++step) {
      const double t = step / 50.0;
      const double p = from.proportional + t * (to.proportional - from.proportional);
      const double d = from.differential + t * (to.differential - from.differential);
      long double largest = 0;
      for (const auto& root : roots(precise.at({p, d}))) {
        largest = std::max(largest, std::abs(1.0L + root));
      }
      const double radius = follower.radius(with_root_at_zero<double, 6>(polynomial.at({p, d})));
      const double error = std::abs(static_cast<double>(radius - largest));
      if (!(error <= worst)) worst = error;
    }
  }
  EXPECT_LT(worst, 1e-10);
}

}  // namespace
}  // namespace holdfast
