#include "holdfast/cable/modes.hpp"

#include "support/random.hpp"

namespace holdfast {
namespace {

/// The paper's conductor with Young's modulus changed so that Irvine's parameter is the one given.
Conductor<double> conductor_of_parameter(double parameter) {
  auto conductor = kollar2022_conductor();
  conductor.youngs_modulus *= parameter / conductor.irvine_parameter();
  return conductor;
}

template <class Function>
double simpson(const Function& function, int intervals = 2000) {
  double sum = 0.0;
  for (int k = 0; k <= intervals; ++k) {
    const double weight = k == 0 || k == intervals ? 1.0 : (k % 2 == 1 ? 4.0 : 2.0);
    sum += weight * function(static_cast<double>(k) / intervals);
  }
  return sum / (3.0 * intervals);
}

TEST(IrvineModes, SymmetricFrequenciesSolveTheirEquationOnTheirOwnBranch) {
  test::Random random(331);
  for (int draw = 0; draw < 500; ++draw) {
    const double parameter = random.log_uniform(1e-3, 1e6);
    const int n = 1 + static_cast<int>(random.index(8));
    const double y = symmetric_frequency(n, parameter) / 2;
    const double residual = std::sin(y) - (y - 4.0 / parameter * y * y * y) * std::cos(y);
    const double scale = 1.0 + y + 4.0 / parameter * y * y * y;
    EXPECT_LE(std::abs(residual), 1e-13 * scale) << n << ' ' << parameter;
    EXPECT_GT(y, (n - 0.5) * pi<double>);
    EXPECT_LT(y, (n + 0.5) * pi<double>);
  }
}

TEST(IrvineModes, TheInextensibleCableSolvesTanYIsY) {
  for (int n = 1; n <= 6; ++n) {
    const double y = symmetric_frequency(n, std::numeric_limits<double>::infinity()) / 2;
    EXPECT_NEAR(std::tan(y) / y, 1.0, 1e-11) << n;
  }
}

TEST(IrvineModes, AtACrossoverTheFamiliesMeetAndBeyondItTheyHaveSwapped) {
  for (int n = 1; n <= 3; ++n) {
    const double crossover = 4.0 * n * n * pi<double> * pi<double>;
    EXPECT_NEAR(symmetric_frequency(n, crossover), 2.0 * n * pi<double>, 1e-13 * n);
    const auto family_at = [&](double parameter, int place) {
      return irvine_modes(conductor_of_parameter(parameter), 2 * n)[static_cast<std::size_t>(place)]
          .family;
    };
    // The pair is the modes 2n − 1 and 2n, counted from one.
    EXPECT_EQ(family_at(0.99 * crossover, 2 * n - 2), ModeFamily::symmetric) << n;
    EXPECT_EQ(family_at(0.99 * crossover, 2 * n - 1), ModeFamily::antisymmetric) << n;
    EXPECT_EQ(family_at(1.01 * crossover, 2 * n - 2), ModeFamily::antisymmetric) << n;
    EXPECT_EQ(family_at(1.01 * crossover, 2 * n - 1), ModeFamily::symmetric) << n;
  }
}

TEST(IrvineModes, ModesAscendAndCarryTheirFrequencyInHertz) {
  for (const double parameter : {0.1, 30.0, 1719.0}) {
    const auto conductor = conductor_of_parameter(parameter);
    const auto modes = irvine_modes(conductor, 9);
    ASSERT_EQ(modes.size(), 9U);
    double previous = 0.0;
    for (const auto& mode : modes) {
      EXPECT_GE(mode.dimensionless_frequency, previous);
      previous = mode.dimensionless_frequency;
      const double hertz = mode.dimensionless_frequency *
                           std::sqrt(conductor.parabolic_tension() / conductor.mass_per_length) /
                           (2 * pi<double> * conductor.span);
      EXPECT_NEAR(mode.frequency / hertz, 1.0, 1e-14);
    }
  }
}

TEST(IrvineModes, ShapesSolveIrvinesEquationBetweenSupportsAtRest) {
  // w'' + ω̄² w = λ² ∫ w dx: the additional tension is the same all along and follows Hooke's law.
  for (const double parameter : {0.5, 12.0, 39.0, 300.0, 1719.0}) {
    const auto conductor = conductor_of_parameter(parameter);
    for (const auto& mode : irvine_modes(conductor, 6)) {
      const auto shape = [&](double x) { return mode.shape(x); };
      const double frequency = mode.dimensionless_frequency;
      const double tension = parameter * simpson(shape);
      const double h = 1e-4, scale = frequency * frequency;
      EXPECT_NEAR(shape(0.0), 0.0, 1e-13);
      EXPECT_NEAR(shape(1.0), 0.0, 1e-13);
      for (double x = 0.05; x < 1.0; x += 0.1) {
        const double bend = (shape(x - h) - 2 * shape(x) + shape(x + h)) / (h * h);
        EXPECT_NEAR(bend + scale * shape(x), tension, 1e-5 * scale) << parameter << ' ' << x;
      }
    }
  }
}

TEST(IrvineModes, ShapesAreOrthogonalOfTheirFamilyAndOfSizeOne) {
  const auto modes = irvine_modes(kollar2022_conductor(), 6);
  for (std::size_t i = 0; i < modes.size(); ++i) {
    const double sign = modes[i].family == ModeFamily::symmetric ? 1.0 : -1.0;
    double largest = 0.0;
    for (double x = 0.0; x <= 1.0; x += 0.005) {
      EXPECT_NEAR(modes[i].shape(1.0 - x), sign * modes[i].shape(x), 1e-12);
      largest = std::fmax(largest, std::abs(modes[i].shape(x)));
    }
    EXPECT_GT(largest, 0.9);
    EXPECT_LT(largest, 1.0 + 1e-12);
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_NEAR(simpson([&](double x) { return modes[i].shape(x) * modes[j].shape(x); }), 0.0,
                  1e-9);
  }
}

TEST(IrvineModes, BadInputIsRefused) {
  auto conductor = kollar2022_conductor();
  EXPECT_THROW(irvine_modes(conductor, 0), InvalidParameter);
  conductor.sag = conductor.span / 2;
  EXPECT_THROW(irvine_modes(conductor, 3), InvalidParameter);
  conductor.sag = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(irvine_modes(conductor, 3), InvalidParameter);
}

}  // namespace
}  // namespace holdfast
