#include "holdfast/cable/bar_chain.hpp"

#include "support/random.hpp"

namespace holdfast {
namespace {

using Reach = Vector<double, 2>;

Reach random_reach(test::Random& random) {
  const double angle = random.uniform(0.0, 2 * pi<double>), length = random.uniform(0.5, 1.5);
  return {length * std::cos(angle), length * std::sin(angle)};
}

double stored_energy(const Reach& reach, double length, double axial_stiffness) {
  return 0.5 * axial_stiffness / length * std::pow(reach.norm() - length, 2);
}

TEST(Bar, ItsTensionIsHookesLawAlongIt) {
  const Reach reach(3.0, 4.0);
  EXPECT_NEAR(bar_tension<double>(reach, 4.0, 20.0), 5.0, 1e-14);
  const Reach pull = bar_pull<double>(reach, 4.0, 20.0);
  EXPECT_NEAR(pull[0], 3.0, 1e-14);
  EXPECT_NEAR(pull[1], 4.0, 1e-14);
  EXPECT_NEAR(bar_tension<double>(reach, 5.0, 20.0), 0.0, 1e-14);
  EXPECT_LT(bar_tension<double>(reach, 6.0, 20.0), 0.0);
}

TEST(Bar, ItsPullIsTheGradientOfItsEnergyAndItsStiffnessTheDerivativeOfThePull) {
  test::Random random(341);
  for (int draw = 0; draw < 200; ++draw) {
    const Reach reach = random_reach(random);
    const double length = random.uniform(0.5, 1.5), axial = random.log_uniform(1.0, 1e5);
    const Reach pull = bar_pull<double>(reach, length, axial);
    const Matrix<double, 2> stiffness = bar_stiffness(reach, length, axial);
    EXPECT_LE((stiffness - stiffness.transpose()).norm(), 1e-15 * stiffness.norm());
    const double h = 1e-5;
    for (int i = 0; i < 2; ++i) {
      const Reach step = h * Reach::Unit(i);
      const double slope = (stored_energy(reach + step, length, axial) -
                            stored_energy(reach - step, length, axial)) /
                           (2 * h);
      EXPECT_NEAR(pull[i], slope, 1e-8 * axial);
      const Reach change = (bar_pull<double>(reach + step, length, axial) -
                            bar_pull<double>(reach - step, length, axial)) /
                           (2 * h);
      EXPECT_LE((stiffness.col(i) - change).norm(), 1e-8 * axial);
    }
  }
}

TEST(Bar, ItTurnsWithItsReach) {
  test::Random random(342);
  for (int draw = 0; draw < 50; ++draw) {
    const Reach reach = random_reach(random);
    const double angle = random.uniform(0.0, 6.0);
    Matrix<double, 2> turn;
    turn << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
    const Reach turned = turn * reach;
    EXPECT_LE(
        (bar_pull<double>(turned, 0.8, 50.0) - turn * bar_pull<double>(reach, 0.8, 50.0)).norm(),
        1e-12);
    EXPECT_LE((bar_stiffness(turned, 0.8, 50.0) -
               turn * bar_stiffness(reach, 0.8, 50.0) * turn.transpose())
                  .norm(),
              1e-12);
  }
}

TEST(BarChain, ItsLengthsAndMassesAddUpToTheCables) {
  const auto conductor = kollar2022_conductor();
  const double whole = HangingCable<double>(conductor).unstretched_length();
  for (const int elements : {2, 3, 10, 41, 160}) {
    const BarChain chain(conductor, 0.64, elements);
    ASSERT_EQ(chain.elements(), elements);
    ASSERT_EQ(chain.free_nodes(), elements - 1);
    double length = 0.0;
    for (int e = 0; e < elements; ++e) length += chain.length(e);
    EXPECT_NEAR(length, whole, 1e-13);
    double mass = 0.5 * conductor.mass_per_length * (chain.length(0) + chain.length(elements - 1));
    for (int node = 0; node < chain.free_nodes(); ++node) mass += chain.mass(node);
    EXPECT_NEAR(mass, conductor.mass_per_length * whole, 1e-14);
  }
}

TEST(BarChain, ANodeLiesAtTheAbsorbersMaterialPointBetweenEqualBars) {
  const auto conductor = kollar2022_conductor();
  const HangingCable<double> cable(conductor);
  for (const double position : {0.01, 0.64, 3.2, 5.9, 6.39}) {
    for (const int elements : {2, 10, 37}) {
      const BarChain chain(conductor, position, elements);
      double s = 0.0;
      for (int e = 0; e <= chain.loaded_node(); ++e) {
        EXPECT_EQ(chain.length(e), chain.length(0));
        s += chain.length(e);
      }
      for (int e = chain.loaded_node() + 1; e < elements; ++e)
        EXPECT_EQ(chain.length(e), chain.length(elements - 1));
      EXPECT_NEAR(s, cable.material_coordinate(position), 1e-13) << position << ' ' << elements;
    }
  }
}

TEST(BarChain, BarsOnEitherSideAreAsEqualAsTheirNumberAllows) {
  const BarChain chain(kollar2022_conductor(), 0.64, 100);
  EXPECT_EQ(chain.loaded_node(), 9) << "a tenth of the bars lies before it";
  EXPECT_NEAR(chain.length(0) / chain.length(99), 1.0, 0.05);
}

TEST(BarChain, ItsFirstGuessHangsOnTheLoadedCatenary) {
  const auto conductor = kollar2022_conductor();
  const BarChain chain(conductor, 0.64, 40);
  const CatenaryPointLoad<double> exact(conductor, 0.64);
  for (const double load : {0.0, 1.5696, 4.0}) {
    const auto nodes = chain.catenary_positions(load);
    ASSERT_EQ(nodes.cols(), 39);
    EXPECT_NEAR(
        nodes(1, chain.loaded_node()) - chain.catenary_positions(0.0)(1, chain.loaded_node()),
        exact.displacement(load), 1e-13);
    EXPECT_GT(chain.smallest_tension(nodes), 0.0);
    Reach across = Reach::Zero();
    for (int e = 0; e < chain.elements(); ++e) across += chain.reach(nodes, e);
    EXPECT_LE((across - Reach(conductor.span, 0.0)).norm(), 1e-13);
  }
}

TEST(BarChain, TheSmallestTensionIsThatOfASlackBar) {
  const BarChain chain(kollar2022_conductor(), 0.64, 10);
  auto nodes = chain.catenary_positions(0.0);
  nodes.col(4) = 0.5 * (nodes.col(3) + nodes.col(5));
  nodes.col(4)[0] -= 0.01;  // the bar before it is too short by then
  const double tension =
      bar_tension<double>(chain.reach(nodes, 4), chain.length(4), chain.axial_stiffness());
  ASSERT_LT(tension, 0.0);
  EXPECT_EQ(chain.smallest_tension(nodes), tension);
}

TEST(BarChain, BadInputIsRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto conductor = kollar2022_conductor();
  for (const int elements : {-1, 0, 1})
    EXPECT_THROW(BarChain(conductor, 0.64, elements), InvalidParameter);
  for (const double position : {0.0, 6.4, -1.0, nan})
    EXPECT_THROW(BarChain(conductor, position, 10), InvalidParameter);
  for (const double sag : {0.0, 3.2, nan}) {
    auto other = conductor;
    other.sag = sag;
    EXPECT_THROW(BarChain(other, 0.64, 10), InvalidParameter);
  }
}

}  // namespace
}  // namespace holdfast
