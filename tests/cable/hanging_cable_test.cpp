#include "holdfast/cable/hanging_cable.hpp"

#include "support/random.hpp"

namespace holdfast {
namespace {

using Extent = CatenaryExtent<double>;

struct Segment {
  double weight, stiffness, tension, vertical, length;
  Extent extent() const { return catenary_extent(weight, stiffness, tension, vertical, length); }
};

Segment random_segment(test::Random& random) {
  return {random.log_uniform(0.1, 10.0), random.log_uniform(1e2, 1e6),
          random.log_uniform(0.5, 100.0), random.uniform(-20.0, 20.0),
          random.log_uniform(0.1, 10.0)};
}

TEST(CatenaryExtent, TwoSegmentsEndToEndAreOne) {
  test::Random random(321);
  for (int draw = 0; draw < 300; ++draw) {
    const auto whole = random_segment(random);
    Segment left = whole, right = whole;
    left.length = random.uniform(0.1, 0.9) * whole.length;
    right.length = whole.length - left.length;
    right.vertical = whole.vertical - whole.weight * left.length;
    const Extent all = whole.extent(), a = left.extent(), b = right.extent();
    EXPECT_NEAR(a.horizontal + b.horizontal, all.horizontal, 1e-12 * whole.length);
    EXPECT_NEAR(a.vertical + b.vertical, all.vertical, 1e-12 * (1 + std::abs(all.vertical)));
    EXPECT_LE((a.derivative + b.derivative - all.derivative).norm(),
              1e-12 * (1 + all.derivative.norm()));
  }
}

TEST(CatenaryExtent, ItsDerivativeIsThatOfDifferencesSymmetricAndPositive) {
  test::Random random(322);
  for (int draw = 0; draw < 300; ++draw) {
    const auto segment = random_segment(random);
    const Matrix<double, 2> derivative = segment.extent().derivative;
    Matrix<double, 2> differences;
    for (int i = 0; i < 2; ++i) {
      Segment before = segment, after = segment;
      double Segment::*force = i == 0 ? &Segment::tension : &Segment::vertical;
      const double step = 1e-5 * segment.tension;
      before.*force -= step;
      after.*force += step;
      const Extent low = before.extent(), high = after.extent();
      differences.col(i) << high.horizontal - low.horizontal, high.vertical - low.vertical;
      differences.col(i) /= 2 * step;
    }
    EXPECT_LE((derivative - differences).norm(), 1e-6 * derivative.norm());
    EXPECT_EQ(derivative(0, 1), derivative(1, 0));
    const Eigen::SelfAdjointEigenSolver<Matrix<double, 2>> solver(derivative);
    EXPECT_GT(solver.eigenvalues()[0], 0.0);
  }
}

TEST(CatenaryExtent, PointsOfAStiffCableLieOnTheHyperbolicCosine) {
  const double weight = 2.0, tension = 5.0, half = 3.0, a = tension / weight;
  const double support = tension * std::sinh(half / a);  // V = H sinh(wL/2H)
  for (double x = 0.25; x <= 6.0; x += 0.25) {
    const double s = a * (std::sinh(half / a) + std::sinh((x - half) / a));
    const Extent extent = catenary_extent(weight, 1e14, tension, support, s);
    EXPECT_NEAR(extent.horizontal, x, 1e-12);
    EXPECT_NEAR(extent.vertical, a * (std::cosh(half / a) - std::cosh((x - half) / a)), 1e-12);
  }
}

TEST(HangingCable, TheBareCableHasItsSagAtMidSpan) {
  for (const double ratio : {1e-3, 0.01, 0.0453125, 0.125, 0.3, 0.49}) {
    auto conductor = kollar2022_conductor();
    conductor.sag = ratio * conductor.span;
    const HangingCable<double> cable(conductor);
    const double half = cable.unstretched_length() / 2;
    const auto middle = cable.extent(cable.bare(), half);
    EXPECT_NEAR(middle.horizontal, conductor.span / 2, 1e-13 * conductor.span) << ratio;
    EXPECT_NEAR(middle.vertical / conductor.sag, 1.0, 1e-9) << ratio;
    EXPECT_NEAR(cable.whole(cable.bare(), 0.0, half).vertical, 0.0, 1e-12);
  }
}

TEST(HangingCable, AStiffOneHasTheLengthAndTensionOfTheHyperbolicCosine) {
  auto conductor = kollar2022_conductor();
  conductor.youngs_modulus = 1e22;  // no strain above round-off
  const HangingCable<double> cable(conductor);
  const double a = cable.bare_tension() / conductor.weight_per_length();
  EXPECT_NEAR(a * (std::cosh(3.2 / a) - 1.0), conductor.sag, 1e-12);
  EXPECT_NEAR(2 * a * std::sinh(3.2 / a), cable.unstretched_length(), 1e-12);
}

TEST(HangingCable, TheMaterialCoordinateIsTheInverseOfTheExtent) {
  const HangingCable<double> cable(kollar2022_conductor());
  for (double x = 0.0; x <= 6.4; x += 0.08) {
    const double s = cable.material_coordinate(x);
    EXPECT_NEAR(cable.extent(cable.bare(), s).horizontal, x, 1e-13);
  }
}

TEST(HangingCable, EveryLoadLeavesTheSupportsWhereTheyAre) {
  test::Random random(323);
  for (int draw = 0; draw < 400; ++draw) {
    auto conductor = kollar2022_conductor();
    conductor.sag = conductor.span * random.log_uniform(0.005, 0.45);
    const HangingCable<double> cable(conductor);
    const double place = cable.unstretched_length() * random.uniform(0.03, 0.97);
    const double load = random.sign() * conductor.weight() * random.log_uniform(1e-3, 1e3);
    const auto loaded = cable.under_load(load, place);
    ASSERT_EQ(loaded.outcome, EquilibriumOutcome::converged) << conductor.sag << ' ' << load;
    const auto spanned = cable.whole(loaded, load, place);
    EXPECT_NEAR(spanned.horizontal, 6.4, 1e-10) << load;
    EXPECT_NEAR(spanned.vertical, 0.0, 1e-10) << load;
    EXPECT_GT(loaded.tension, 0.0);
  }
}

/// ∫ w (L − x) ds, the moment of the cable's weight about the right support.
double moment_of_weight(const HangingCable<double>& cable, const LoadedCable<double>& loaded,
                        double load, double place) {
  constexpr int intervals = 400;
  double sum = 0.0;
  for (const auto& [from, to] : {std::pair{0.0, place}, {place, cable.unstretched_length()}}) {
    for (int k = 0; k <= intervals; ++k) {
      const double weight = k == 0 || k == intervals ? 1.0 : (k % 2 == 1 ? 4.0 : 2.0);
      const double s = from + (to - from) * k / intervals;
      sum += weight * (to - from) / (3.0 * intervals) *
             (cable.span() - cable.point(loaded, load, place, s)[0]);
    }
  }
  return cable.weight_per_length() * sum;
}

TEST(HangingCable, TheSupportsCarryTheWeightAndTheLoadByTheirMoments) {
  const HangingCable<double> cable(kollar2022_conductor());
  const double place = cable.material_coordinate(0.64);
  for (const double load : {-2.0, -0.4, 0.2, 1.5696, 10.0}) {
    const auto loaded = cable.under_load(load, place);
    const double moment = moment_of_weight(cable, loaded, load, place) +
                          load * (6.4 - cable.extent(loaded, place).horizontal);
    EXPECT_NEAR(loaded.vertical_force * 6.4, moment, 1e-8) << load;
  }
}

TEST(CatenaryPointLoad, TheStiffnessIsTheDerivativeOfTheLoad) {
  for (const double place : {0.64, 3.2, 5.0}) {
    const CatenaryPointLoad<double> model(kollar2022_conductor(), place);
    for (const double load : {-1.2, -0.3, 0.0, 1.5696, 6.0}) {
      const double step = 1e-4;
      const double slope =
          (model.displacement(load + step) - model.displacement(load - step)) / (2 * step);
      EXPECT_NEAR(model.stiffness(load) * slope, 1.0, 1e-6) << place << ' ' << load;
    }
  }
}

TEST(CatenaryPointLoad, SmallLoadsObeyReciprocity) {
  const CatenaryPointLoad<double> here(kollar2022_conductor(), 0.64);
  const CatenaryPointLoad<double> there(kollar2022_conductor(), 4.1);
  const double load = 1e-3;
  const double forth = here.deflection(4.1, load) - here.deflection(4.1, -load);
  const double back = there.deflection(0.64, load) - there.deflection(0.64, -load);
  EXPECT_NEAR(forth / back, 1.0, 1e-6);
  EXPECT_GT(std::abs(back), 1e-6);
}

}  // namespace
}  // namespace holdfast
