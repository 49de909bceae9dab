#include "holdfast/chaos/lyapunov_run.hpp"

#include "support/dense_routes.hpp"
#include "support/kollar_case.hpp"
#include "support/random.hpp"

namespace holdfast {
namespace {

using Matrix2 = Matrix<double, 2>;
using Matrix5 = Matrix<double, 5>;
constexpr double infinity = std::numeric_limits<double>::infinity();

Matrix2 rotation(double angle) {
  Matrix2 q;
  q << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  return q;
}

TEST(Lyapunov, AGenericBasisSortsTheExponents) {
  LyapunovSpectrum<double, 2> spectrum(rotation(1.0));
  const Matrix2 map = Vector<double, 2>(0.5, 2.0).asDiagonal();
  for (int n = 0; n < 10000; ++n) spectrum.push(map);
  EXPECT_NEAR(spectrum.exponents()[0], std::log(2.0), 1e-3);
  EXPECT_NEAR(spectrum.exponents()[1], std::log(0.5), 1e-3);
}

TEST(Lyapunov, HenonMapLosesAreaAtItsKnownRate) {
  const double a = 1.4, b = 0.3;
  double x = 0.1, y = 0.1;
  LyapunovSpectrum<double, 2> spectrum;
  for (int n = 0; n < 200000; ++n) {
    Matrix2 tangent;
    tangent << -2 * a * x, 1, b, 0;
    spectrum.push(tangent);
    const double next = 1 - a * x * x + y;
    y = b * x;
    x = next;
  }
  EXPECT_NEAR(spectrum.exponents().sum(), std::log(b), 1e-12);
  // Literature (Sprott 2003): 0.41922; the orbit's own scatter is what the standard error says.
  EXPECT_NEAR(spectrum.exponents()[0], 0.41922, 4 * spectrum.standard_errors()[0]);
  EXPECT_LT(spectrum.standard_errors()[0], 0.003);
}

TEST(Lyapunov, TriangularProductsHaveTheMeanLogarithmsOfTheirDiagonals) {
  test::Random random(131);
  LyapunovSpectrum<double, 5> spectrum;
  Vector<double, 5> sum = Vector<double, 5>::Zero();
  const int steps = 2000;
  for (int n = 0; n < steps; ++n) {
    Matrix5 map = Matrix5::Zero();
    for (int i = 0; i < 5; ++i) {
      map(i, i) = random.sign() * random.log_uniform(0.2, 3.0);
      sum[i] += std::log(std::abs(map(i, i))) / steps;
      for (int j = i + 1; j < 5; ++j) map(i, j) = random.uniform(-1, 1);
    }
    spectrum.push(map);
  }
  EXPECT_LE((spectrum.exponents() - sum).cwiseAbs().maxCoeff(), 1e-13);
}

TEST(Lyapunov, ANullDirectionHasExactlyMinusInfinity) {
  test::Random random(133);
  LyapunovSpectrum<double, 5> spectrum;
  for (int n = 0; n < 500; ++n) {
    const Matrix5 full = random.matrix<Matrix5>();
    Matrix5 flat = full;
    flat.row(2) = flat.row(0) + flat.row(1);
    spectrum.push(n == 250 ? flat : full);
  }
  EXPECT_TRUE(spectrum.exponents().head<4>().allFinite());
  EXPECT_EQ(spectrum.exponents()[4], -infinity);
  EXPECT_EQ(spectrum.standard_errors()[4], 0.0);
}

TEST(Lyapunov, ASingularMapKeepsTheExponentOfWhatItDoesNotAnnihilate) {
  LyapunovSpectrum<double, 2> spectrum(rotation(1.0));
  const Matrix2 map = Vector<double, 2>(0.0, 1.0).asDiagonal();
  for (int n = 0; n < 10000; ++n) spectrum.push(map);
  EXPECT_NEAR(spectrum.exponents()[0], 0.0, 1e-3);
  EXPECT_EQ(spectrum.exponents()[1], -infinity);
}

TEST(Lyapunov, TheZeroMapAnnihilatesEverything) {
  LyapunovSpectrum<double, 2> spectrum;
  spectrum.push(Matrix2::Zero());
  EXPECT_EQ(spectrum.exponents()[0], -infinity);
  EXPECT_EQ(spectrum.exponents()[1], -infinity);
}

TEST(Lyapunov, ADirectionThatVanishesInSpiteOfTheRankIsMinusInfinity) {
  LyapunovSpectrum<double, 2> spectrum;
  Matrix2 map = Matrix2::Zero();
  map(0, 0) = 2.0;
  spectrum.push(map, 2);  // a rank that is told wrong
  EXPECT_DOUBLE_EQ(spectrum.exponents()[0], std::log(2.0));
  EXPECT_EQ(spectrum.exponents()[1], -infinity);
}

TEST(Lyapunov, RankCountsIndependentRows) {
  Matrix2 flat;
  flat << 1, 2, 2, 4;
  EXPECT_EQ((LyapunovSpectrum<double, 2>::rank_of(flat)), 1);
  EXPECT_EQ((LyapunovSpectrum<double, 2>::rank_of(rotation(0.3))), 2);
  const auto loop = test::KollarCase{}.loop();
  EXPECT_EQ((LyapunovSpectrum<double, 5>::rank_of(loop.backlash_map())), 4);
}

TEST(LyapunovObserver, WithoutBacklashTheExponentsAreTheLogarithmsOfTheLoopsEigenvalues) {
  test::KollarCase which;
  which.width = 0.0;
  which.sampling_period = 0.01;
  which.processing_delay = 0.004;
  LyapunovObserver observer(which.loop(), which.gains);
  auto motion = which.motion();
  run_trajectory(motion, 50000, std::nullopt, observer);
  const Vector<double, 5> expected = test::log_moduli_of(which.loop().engaged_map(which.gains));
  // The turning of the basis adds a bounded sum: a share of order ln(‖S‖)/n.
  EXPECT_LE((observer.spectrum().exponents() - expected).cwiseAbs().maxCoeff(), 20.0 / 50000);
}

TEST(LyapunovObserver, ReadAtEverySampleItIsTheSpectrumSoFarAndIsNotDisturbed) {
  test::KollarCase which;
  which.sampling_period = 0.011;
  which.processing_delay = 0.0055;
  which.width = 0.002;
  const auto loop = which.loop();
  LyapunovObserver read(loop, which.gains), unread(loop, which.gains);
  LyapunovSpectrum<double, 5> expected;
  auto motion = which.motion();
  run_trajectory(motion, 1000, std::nullopt, read, unread, [&](const auto& sample) {
    expected.push(sample.engaged ? loop.engaged_map(which.gains) : loop.backlash_map());
    const auto now = read.spectrum().exponents(), wanted = expected.exponents();
    ASSERT_EQ(read.spectrum().steps(), sample.index + 1);
    for (int i = 0; i < 5; ++i) {
      if (std::isfinite(wanted[i])) {
        ASSERT_NEAR(now[i], wanted[i], 1e-10) << sample.index << " " << i;
      } else {
        ASSERT_EQ(now[i], wanted[i]);
      }
    }
  });
  EXPECT_EQ(read.spectrum().exponents(), unread.spectrum().exponents());
}

TEST(LyapunovObserver, ItsSpectrumGoesOnSampleBySample) {
  test::KollarCase which;
  which.width = 0.002;
  const auto loop = which.loop();
  LyapunovObserver all(loop, which.gains), first(loop, which.gains);
  auto motion = which.motion();
  run_trajectory(motion, 1003, std::nullopt, first, all);
  LyapunovSpectrum<double, 5> spectrum = first.spectrum();
  run_trajectory(motion, 400, std::nullopt, all, [&](const MotionSample<double>& sample) {
    spectrum.push(sample.engaged ? loop.engaged_map(which.gains) : loop.backlash_map());
  });
  EXPECT_EQ(spectrum.steps(), 1403);
  EXPECT_LE((spectrum.exponents() - all.spectrum().exponents()).head<4>().cwiseAbs().maxCoeff(),
            1e-10);
}

}  // namespace
}  // namespace holdfast
