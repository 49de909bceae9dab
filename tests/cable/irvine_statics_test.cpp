#include "holdfast/cable/statics.hpp"
#include "holdfast/plant/reduction.hpp"

#include "support/random.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

struct ParabolicCase {
  Conductor<double> conductor;
  double position;
  double load;

  IrvinePointLoad<double> model() const { return {conductor, position}; }
  double relative_load() const { return load / conductor.weight(); }
};

ParabolicCase random_parabolic_case(test::Random& random) {
  const double span = random.log_uniform(1.0, 500.0);
  const Conductor<double> conductor{random.log_uniform(0.01, 10.0),
                                    span,
                                    span * random.log_uniform(0.003, 0.12),
                                    random.log_uniform(1e-6, 1e-3),
                                    random.log_uniform(1e8, 2e11),
                                    0.01,
                                    9.81};
  const double relative =
      random.sign() > 0 ? random.log_uniform(0.001, 20.0) : -random.log_uniform(0.001, 0.49);
  return {conductor, span * random.uniform(0.02, 0.98), relative * conductor.weight()};
}

TEST(IrvineStatics, TheAdditionalTensionSolvesTheCubic) {
  test::Random random(311);
  for (int draw = 0; draw < 500; ++draw) {
    const auto which = random_parabolic_case(random);
    const double h = which.model().relative_additional_tension(which.load);
    const double parameter = which.conductor.irvine_parameter(), p = which.relative_load();
    const double x = which.position / which.conductor.span;
    const double terms[] = {h * h * h, (2 + parameter / 24) * h * h, (1 + parameter / 12) * h,
                            -parameter / 2 * x * (1 - x) * p * (1 + p)};
    double sum = 0.0, size = 0.0;
    for (const double term : terms) sum += term, size += std::abs(term);
    EXPECT_LE(std::abs(sum), 1e-14 * size);
    EXPECT_GT(h, -1.0);
  }
}

/// ∫ [(μg/H) w + ½ w'²] dx over the span, by Simpson's rule on either side of the kink, w' by the
/// parabolas' own central differences, which are exact.
double lengthening(const ParabolicCase& which) {
  const auto model = which.model();
  const double weight = which.conductor.weight_per_length() / which.conductor.parabolic_tension();
  const auto piece = [&](double from, double to) {
    const auto integrand = [&](double x, double slope) {
      return weight * model.deflection(x, which.load) + slope * slope / 2;
    };
    // w is a parabola here: its slope is linear between those of the halves' chords.
    const double middle = (from + to) / 2, half = middle - from;
    const double w0 = model.deflection(from, which.load);
    const double w1 = model.deflection(middle, which.load);
    const double w2 = model.deflection(to, which.load);
    const double slope = (w2 - w0) / (2 * half), bend = (w2 - 2 * w1 + w0) / (half * half);
    return half / 3 *
           (integrand(from, slope - bend * half) + 4 * integrand(middle, slope) +
            integrand(to, slope + bend * half));
  };
  return piece(0.0, which.position) + piece(which.position, which.conductor.span);
}

TEST(IrvineStatics, TheCableStretchesAsMuchAsItsTensionAsks) {
  test::Random random(312);
  for (int draw = 0; draw < 300; ++draw) {
    const auto which = random_parabolic_case(random);
    const auto& c = which.conductor;
    const double added = which.model().tension(which.load) - c.parabolic_tension();
    const double stretch = added * c.effective_length() / c.axial_stiffness();
    const double scale =
        c.effective_length() * c.parabolic_tension() / c.axial_stiffness() + c.sag * c.sag / c.span;
    EXPECT_NEAR(lengthening(which), stretch, 1e-11 * (scale + std::abs(stretch)));
  }
}

TEST(IrvineStatics, TheLoadIsCarriedByTheKinkAndTheSupportsStandStill) {
  test::Random random(313);
  for (int draw = 0; draw < 200; ++draw) {
    const auto which = random_parabolic_case(random);
    const auto model = which.model();
    const double span = which.conductor.span, place = which.position;
    const double step = 1e-4 * std::fmin(place, span - place);
    const auto w = [&](double x) { return model.deflection(x, which.load); };
    // One-sided second-order differences are exact on a parabola.
    const double before = (3 * w(place) - 4 * w(place - step) + w(place - 2 * step)) / (2 * step);
    const double after = (-3 * w(place) + 4 * w(place + step) - w(place + 2 * step)) / (2 * step);
    EXPECT_NEAR(model.tension(which.load) * (before - after) / which.load, 1.0, 1e-7);
    EXPECT_EQ(w(0.0), 0.0);
    EXPECT_NEAR(w(span), 0.0, 1e-14 * span);
    EXPECT_EQ(model.displacement(which.load), w(place / span * span));
  }
}

TEST(IrvineStatics, TheStiffnessIsTheDerivativeOfTheLoad) {
  test::Random random(314);
  for (int draw = 0; draw < 300; ++draw) {
    const auto which = random_parabolic_case(random);
    const auto model = which.model();
    const double step = 1e-5 * std::abs(which.load);
    const double slope =
        (model.displacement(which.load + step) - model.displacement(which.load - step)) /
        (2 * step);
    EXPECT_NEAR(model.stiffness(which.load) * slope, 1.0, 1e-5);
  }
}

/// A law F(w) for the readings: linear, or bent by a cubic.
struct ForceLaw {
  double linear = 50.0, quadratic = 0.0, cubic = 0.0;
  double force(double w) const { return ((cubic * w + quadratic) * w + linear) * w; }
  double stiffness(double) const { return linear; }
};

TEST(ConductorStiffness, AStraightLineIsReadAlikeByAll) {
  for (const auto reading :
       {StiffnessReading::tangent, StiffnessReading::secant, StiffnessReading::least_squares})
    for (const ReadingRange& range : {ReadingRange{0.008, 0.007}, {0.01, 0.0}, {0.0, 0.003}})
      EXPECT_NEAR(conductor_stiffness(ForceLaw{}, reading, range), 50.0, 1e-11);
}

template <class Statics>
double regression_slope(const Statics& statics, const ReadingRange& range, int points) {
  const double middle = (range.below - range.above) / 2, width = range.below + range.above;
  double moment = 0.0, spread = 0.0;
  for (int k = 0; k < points; ++k) {
    const double offset = width * (static_cast<double>(k) / (points - 1) - 0.5);
    moment += offset * statics.force(middle + offset);
    spread += offset * offset;
  }
  return moment / spread;
}

TEST(ConductorStiffness, TheLeastSquaresLineIsThatOfManyPoints) {
  const auto expect_alike = [](const auto& statics, const ReadingRange& range, int points) {
    const double slope = conductor_stiffness(statics, StiffnessReading::least_squares, range);
    EXPECT_NEAR(slope / regression_slope(statics, range, points), 1.0, 1.0 / points);
  };
  const auto conductor = kollar2022_conductor();
  expect_alike(irvine_statics(conductor, 0.64, 0.16), {0.008, 0.007}, 20001);
  expect_alike(irvine_statics(conductor, 0.64, 0.16), {0.02, 0.0}, 20001);
  expect_alike(exact_statics(conductor, 0.64, 0.16), {0.008, 0.007}, 401);
}

TEST(ConductorStiffness, OnABentLawTheReadingsAreTheirClosedForms) {
  const ForceLaw law{50.0, 300.0, 2e4};
  const ReadingRange even{0.01, 0.01};
  EXPECT_EQ(conductor_stiffness(law, StiffnessReading::tangent, even), 50.0);
  // ∫ w F dw / ∫ w² dw over ± a: k + (3/5) c a²; the secant sees k + c a².
  EXPECT_NEAR(conductor_stiffness(law, StiffnessReading::least_squares, even),
              50.0 + 0.6 * 2e4 * 1e-4, 1e-10);
  EXPECT_NEAR(conductor_stiffness(law, StiffnessReading::secant, even), 50.0 + 2e4 * 1e-4, 1e-10);
}

TEST(ConductorStiffness, ANegativeOrEmptyRangeIsRefusedWhereOneIsRead) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const auto reading : {StiffnessReading::secant, StiffnessReading::least_squares})
    for (const ReadingRange& range :
         {ReadingRange{0.0, 0.0}, {-0.001, 0.01}, {0.01, -0.001}, {nan, 0.01}})
      EXPECT_THROW(conductor_stiffness(ForceLaw{}, reading, range), InvalidParameter);
  EXPECT_EQ(conductor_stiffness(ForceLaw{}, StiffnessReading::tangent, {0.0, 0.0}), 50.0);
  const auto statics = exact_statics(kollar2022_conductor(), 0.64, 0.16);
  EXPECT_THROW(conductor_stiffness(statics, StiffnessReading::secant, {0.01, 1.0}),
               InvalidParameter)
      << "a metre up is beyond what lifts the cable";
}

}  // namespace
}  // namespace holdfast
