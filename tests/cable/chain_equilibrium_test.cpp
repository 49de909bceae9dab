#include "holdfast/cable/bar_chain.hpp"

#include "holdfast/cable/statics.hpp"
#include "support/random.hpp"

namespace holdfast {
namespace {

constexpr double resting_weight = 0.16 * 9.81;

BarChain kollar_chain(int elements) { return {kollar2022_conductor(), 0.64, elements}; }

/// Displacement of the loaded node under a further force.
double chain_displacement(int elements, double force) {
  const BarChain chain = kollar_chain(elements);
  const auto loaded = chain_equilibrium(chain, resting_weight + force);
  const auto rest = chain_equilibrium(chain, resting_weight);
  return loaded.nodes(1, chain.loaded_node()) - rest.nodes(1, chain.loaded_node());
}

Vector<double, 2> pull_of(const BarChain& chain, const BarChain::Nodes& nodes, int element) {
  return bar_pull<double>(chain.reach(nodes, element), chain.length(element),
                          chain.axial_stiffness());
}

TEST(ChainEquilibrium, NoForceIsLeftAtAnyNode) {
  for (const int elements : {4, 10, 40, 160}) {
    const BarChain chain = kollar_chain(elements);
    for (const double load : {-1.0, -0.2, 0.0, 0.2, resting_weight, 20.0}) {
      const auto found = chain_equilibrium(chain, load);
      EXPECT_EQ(found.outcome, EquilibriumOutcome::converged) << elements << ' ' << load;
      const double left = unbalanced_forces(chain, found.nodes, load).cwiseAbs().maxCoeff();
      EXPECT_EQ(found.unbalanced, left);
      EXPECT_LE(left, 1e-7) << elements << ' ' << load;
      EXPECT_GT(chain.smallest_tension(found.nodes), 0.0);
    }
  }
}

TEST(ChainEquilibrium, TheHorizontalPullIsTheSameAllAlong) {
  const BarChain chain = kollar_chain(40);
  const auto found = chain_equilibrium(chain, 2.0);
  const double first = pull_of(chain, found.nodes, 0)[0];
  for (int e = 1; e < chain.elements(); ++e)
    EXPECT_NEAR(pull_of(chain, found.nodes, e)[0], first, 1e-8) << e;
}

TEST(ChainEquilibrium, TheSupportsCarryTheWeightAndTheLoad) {
  const BarChain chain = kollar_chain(40);
  const double load = 2.0;
  const auto found = chain_equilibrium(chain, load);
  double weight = load;
  for (int node = 0; node < chain.free_nodes(); ++node) weight += chain.mass(node) * 9.81;
  const double left = pull_of(chain, found.nodes, 0)[1];
  const double right = -pull_of(chain, found.nodes, chain.elements() - 1)[1];
  EXPECT_NEAR(left + right, weight, 1e-7);
}

TEST(ChainEquilibrium, TheTangentStiffnessIsTheDerivativeOfTheForces) {
  test::Random random(351);
  const BarChain chain = kollar_chain(10);
  BarChain::Nodes nodes = chain_equilibrium(chain, resting_weight).nodes;
  for (auto& coordinate : nodes.reshaped()) coordinate += random.uniform(-1e-4, 1e-4);
  const Eigen::MatrixXd tangent(tangent_stiffness(chain, nodes));
  EXPECT_LE((tangent - tangent.transpose()).norm(), 1e-15 * tangent.norm());
  const double h = 1e-6;
  for (Eigen::Index j = 0; j < tangent.cols(); ++j) {
    BarChain::Nodes before = nodes, after = nodes;
    before.reshaped()[j] -= h;
    after.reshaped()[j] += h;
    const BarChain::Nodes change =
        (unbalanced_forces(chain, before, 1.0) - unbalanced_forces(chain, after, 1.0)) / (2 * h);
    EXPECT_LE((tangent.col(j) - change.reshaped()).norm(), 1e-6 * tangent.col(j).norm()) << j;
    for (Eigen::Index i = 0; i < tangent.rows(); ++i) {
      const bool inside = std::abs(i - j) <= 3;
      EXPECT_TRUE(inside || tangent(i, j) == 0.0) << i << ' ' << j;
    }
  }
}

TEST(ChainEquilibrium, ItIsStable) {
  const BarChain chain = kollar_chain(40);
  const auto found = chain_equilibrium(chain, resting_weight);
  const Eigen::MatrixXd tangent(tangent_stiffness(chain, found.nodes));
  EXPECT_EQ(tangent.llt().info(), Eigen::Success);
}

TEST(ChainEquilibrium, ItApproachesTheExactStaticsWithTheSquareOfTheBarLength) {
  const double exact = exact_statics(kollar2022_conductor(), 0.64, 0.16).displacement(0.2);
  double before = std::abs(chain_displacement(10, 0.2) - exact);
  for (const int elements : {20, 40, 80, 160}) {
    const double miss = std::abs(chain_displacement(elements, 0.2) - exact);
    EXPECT_NEAR(std::log2(before / miss), 2.0, 0.1) << elements;
    before = miss;
  }
  EXPECT_LT(before, 1e-3 * exact);
}

TEST(ChainEquilibrium, ItsTensionApproachesTheExactOneToo) {
  const double exact = exact_statics(kollar2022_conductor(), 0.64, 0.16).tension(0.0);
  const auto miss = [&](int elements) {
    const BarChain chain = kollar_chain(elements);
    return std::abs(pull_of(chain, chain_equilibrium(chain, resting_weight).nodes, 0)[0] - exact);
  };
  EXPECT_NEAR(std::log2(miss(20) / miss(40)), 2.0, 0.1);
  EXPECT_NEAR(std::log2(miss(40) / miss(80)), 2.0, 0.1);
}

TEST(ChainEquilibrium, ALoadThatIsNoNumberIsRefused) {
  const BarChain chain = kollar_chain(10);
  EXPECT_THROW(chain_equilibrium(chain, std::numeric_limits<double>::quiet_NaN()),
               InvalidParameter);
  EXPECT_THROW(chain_equilibrium(chain, std::numeric_limits<double>::infinity()), InvalidParameter);
}

}  // namespace
}  // namespace holdfast
