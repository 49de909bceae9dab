#include "holdfast/orbit/itinerary_maps.hpp"
#include "holdfast/orbit/periodic_orbit.hpp"

#include "support/dense_routes.hpp"
#include "support/kollar_case.hpp"
#include "support/random.hpp"

namespace holdfast {
namespace {

using Maps = std::vector<Matrix<double, 5>>;
using DenseMatrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
using DenseVector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;

/// x₀ of the closed sequence x_{k+1} = M_k x_k + g_k from its whole block-cyclic system, in long
/// double.
/// @param additions  g_k, one below the other
Vector<double, 5> first_of_cycle(const Maps& maps, const DenseVector& additions) {
  const auto size = static_cast<Eigen::Index>(5 * maps.size());
  DenseMatrix system = DenseMatrix::Identity(size, size);
  DenseVector right(size);
  for (Eigen::Index k = 0; k < size; k += 5) {
    const Eigen::Index next = (k + 5) % size;
    system.block<5, 5>(next, k) -= maps[static_cast<std::size_t>(k / 5)].cast<long double>();
    right.segment<5>(next) = additions.segment<5>(k);
  }
  return DenseVector(system.fullPivLu().solve(right)).head<5>().cast<double>();
}

Maps random_maps(test::Random& random, std::size_t count, double scale) {
  Maps maps(count);
  for (auto& map : maps) map = scale * random.matrix<Matrix<double, 5>>();
  return maps;
}

/// What closes a sequence whose last map alone adds something, by the whole system and by its ends.
void expect_closed(test::Random& random, const Maps& maps, double tolerance) {
  const Vector<double, 5> open = random.matrix<Vector<double, 5>>();
  DenseVector additions = DenseVector::Zero(static_cast<Eigen::Index>(5 * maps.size()));
  additions.tail<5>() = open.cast<long double>();
  const Vector<double, 5> expected = first_of_cycle(maps, additions);
  const Vector<double, 5> found = CyclicSystem<double>(maps).correction(open);
  // Of a sequence that expands x₀ is far smaller than what it closes.
  const double size = std::max(open.norm(), expected.norm());
  EXPECT_LE((found - expected).norm(), tolerance * size) << maps.size();
  const std::vector<Eigen::MatrixXd> others(maps.begin(), maps.end());
  const CyclicSystem<double, Eigen::Dynamic> of_any_order(others);
  EXPECT_LE((of_any_order.correction(open) - expected).norm(), tolerance * size);
}

TEST(CyclicSystem, ClosesContractionsAndExpansionsAlike) {
  // Scales from contraction by a hundred a map to expansion by ten: the product spans 1e±60.
  test::Random random(813);
  for (const double scale : {0.01, 0.3, 0.6, 1.0, 10.0})
    for (int trial = 0; trial < 10; ++trial)
      expect_closed(random, random_maps(random, 1 + random.index(30), scale), 1e-10);
}

TEST(CyclicSystem, ClosesSequencesThatGrowByAMillionOnTheirWay) {
  // Some maps expand by a hundred and others contract by more: no digit may be lost to the peak.
  test::Random random(814);
  for (int trial = 0; trial < 20; ++trial) {
    Maps maps = random_maps(random, 30, 0.3);
    for (std::size_t k = 10; k < 13; ++k) maps[k] *= 300.0;
    for (std::size_t k = 20; k < 23; ++k) maps[k] *= 1e-3;
    expect_closed(random, maps, 1e-9);
  }
}

TEST(CyclicSystem, ClosesGrowingAndDecayingDirectionsTogether) {
  // Products of 1e40 and 1e-40 at once: neither direction alone could be followed.
  test::Random random(815);
  Matrix<double, 5> saddle = Matrix<double, 5>::Zero();
  saddle.diagonal() << 25.0, 10.0, 0.5, 0.1, 0.04;
  for (int trial = 0; trial < 20; ++trial) {
    const Matrix<double, 5> turn = test::orthogonal_factor_of(random.matrix<Matrix<double, 5>>());
    expect_closed(random, Maps(30, turn * saddle * turn.transpose()), 1e-12);
  }
}

TEST(CyclicSystem, IsRegularJustBesideASingularSequence) {
  test::Random random(819);
  Matrix<double, 5> map = Matrix<double, 5>::Zero();
  map.diagonal() << 1.0 - 1e-9, 0.5, -0.7, 0.2, 0.0;
  const Vector<double, 5> open = random.matrix<Vector<double, 5>>();
  const Vector<double, 5> found = CyclicSystem<double>({map}).correction(open);
  for (int i = 0; i < 5; ++i)
    EXPECT_NEAR(found[i], open[i] / (1.0 - map(i, i)), 1e-6 * std::abs(found[i]));
}

// ---- the loop's own maps -----------------------------------------------------------------------

struct ContactSequence {
  IdealLoop<double> loop;
  Rational ratio;
  Itinerary itinerary;
};

ContactSequence random_sequence(test::Random& random) {
  test::KollarCase which;
  which.sampling_period = 0.01;
  which.processing_delay = random.unit() * 0.01;
  ContactSequence sequence{which.ideal_loop(), {1, 10}, {}};
  for (std::size_t j = 0; j < 10 * (1 + random.index(3)); ++j)
    sequence.itinerary.push_back(random.unit() < 0.6 ? 1 : 0);
  return sequence;
}

template <class Scalar>
std::optional<PeriodicSolution<ItineraryMaps<Scalar>>> solve_sequence(
    const ContactSequence& sequence) {
  const ItineraryMaps<Scalar> maps(converted<Scalar>(sequence.loop), sequence.ratio);
  return periodic_solution(maps, sequence.itinerary, maps_of_blocks(maps, sequence.itinerary));
}

TEST(PeriodicSolution, ClosesForAnySequenceOfContacts) {
  test::Random random(816);
  for (int trial = 0; trial < 50; ++trial) {
    const ContactSequence sequence = random_sequence(random);
    const ItineraryMaps<double> maps(sequence.loop, sequence.ratio);
    const auto solution = solve_sequence<double>(sequence);
    ASSERT_TRUE(solution);
    const std::size_t samples = sequence.itinerary.size();
    ASSERT_EQ(solution->states.size(), samples);
    const double size = solution->states.front().head<4>().norm();
    for (std::size_t j = 0; j < samples; ++j) {
      const Vector<double, 5> next =
          maps.step(solution->states[j], sequence.itinerary[j] != 0, j % 10);
      EXPECT_LE((next - solution->states[(j + 1) % samples]).head<4>().norm(), 1e-12 * size);
    }
    EXPECT_LE(solution->closure_error, 1e-12 * size);
  }
}

TEST(PeriodicSolution, IsThatOfTheWholeSystemInLongDouble) {
  test::Random random(817);
  for (int trial = 0; trial < 20; ++trial) {
    const ContactSequence sequence = random_sequence(random);
    const ItineraryMaps<double> maps(sequence.loop, sequence.ratio);
    Maps singles;
    DenseVector additions(static_cast<Eigen::Index>(5 * sequence.itinerary.size()));
    for (std::size_t j = 0; j < sequence.itinerary.size(); ++j) {
      const bool engaged = sequence.itinerary[j] != 0;
      singles.push_back(maps.map(engaged));
      additions.segment<5>(static_cast<Eigen::Index>(5 * j)) =
          maps.step(Vector<double, 5>::Zero(), engaged, j % 10).cast<long double>();
    }
    const Vector<double, 5> expected = first_of_cycle(singles, additions);
    const Vector<double, 5> found = solve_sequence<double>(sequence).value().states.front();
    const Vector<double, 5> precise =
        solve_sequence<long double>(sequence).value().states.front().cast<double>();
    EXPECT_LE((found - expected).norm(), 1e-11 * expected.norm()) << trial;
    EXPECT_LE((precise - expected).norm(), 1e-11 * expected.norm()) << trial;
  }
}

TEST(PeriodicSolution, ThereIsNoneWhereOneIsAMultiplier) {
  test::Random random(818);
  const ContactSequence sequence = random_sequence(random);
  const ItineraryMaps<double> maps(sequence.loop, sequence.ratio);
  for (int trial = 0; trial < 20; ++trial) {
    // A similarity X diag(1, …) Xᵀ over two maps.
    const Matrix<double, 5> basis = test::orthogonal_factor_of(random.matrix<Matrix<double, 5>>());
    Matrix<double, 5> values = Matrix<double, 5>::Zero();
    values.diagonal() << 1.0, 0.5, -0.7, 0.2, 0.0;
    const Maps closed{values * basis.transpose(), basis};
    EXPECT_FALSE(periodic_solution(maps, sequence.itinerary, closed)) << trial;
  }
}

TEST(ItineraryMaps, StepTheMotionItself) {
  for (const double fraction : {0.0, 0.4, 1.0}) {
    const IdealLoop<double> loop = test::kollar_loop(0.003, 0.002, fraction);
    const Rational ratio = forcing_ratio(loop).value();
    const ItineraryMaps<double> maps(loop, ratio);
    ASSERT_EQ(maps.samples_of_forcing(), 100U);
    auto motion = periodically_forced_motion(loop, ratio, Vector<double, 4>::Zero().eval());
    int inside = 0;
    for (std::size_t j = 0; j < 400; ++j) {
      const auto memory = motion.memory();
      Vector<double, 5> state;
      state << memory.state, memory.previous_force;
      const auto sample = motion.sense();
      motion.advance();
      const Vector<double, 5> next = maps.step(state, sample.engaged, j % 100);
      ASSERT_LE((next.head<4>() - motion.state()).cwiseAbs().maxCoeff(), 1e-14);
      ASSERT_NEAR(next[4], sample.control_force, 1e-12);
      inside += sample.engaged ? 0 : 1;
    }
    EXPECT_GT(inside, 10);
  }
}

TEST(MapsOfBlocks, TogetherAreTheWholeSequence) {
  test::Random random(810);
  for (const double period : {0.001, 0.01, 0.05}) {
    const IdealLoop<double> loop = test::kollar_loop(period, 0.002, 0.3);
    const ItineraryMaps<double> maps(loop, forcing_ratio(loop).value());
    Itinerary itinerary;
    for (int j = 0; j < 300; ++j) itinerary.push_back(random.unit() < 0.5 ? 1 : 0);
    Vector<double, 5> by_samples = random.matrix<Vector<double, 5>>();
    Vector<double, 5> by_blocks = by_samples.cwiseQuotient(maps.units());
    const auto blocks = maps_of_blocks(maps, itinerary);
    for (const auto& block : blocks) by_blocks = block * by_blocks;
    for (const std::uint8_t contact : itinerary) by_samples = maps.map(contact != 0) * by_samples;
    by_blocks = by_blocks.cwiseProduct(maps.units());
    EXPECT_LE((by_blocks - by_samples).norm(), 1e-11 * by_samples.norm()) << period;
    EXPECT_LE(blocks.size(), itinerary.size()) << period;
    if (period == 0.001) {
      EXPECT_LT(2 * blocks.size(), itinerary.size()) << "they are what saves the work";
    }
  }
}

TEST(MapsOfBlocks, OfAGrowingLoopStayShort) {
  IdealLoop<double> loop = test::kollar_loop(0.05, 0.002, 0.0);
  loop.gains = {-5000.0, -200.0};
  const ItineraryMaps<double> maps(loop, forcing_ratio(loop).value());
  const Itinerary itinerary(64, 1);
  const double one = maps_of_blocks(maps, {1}).front().cwiseAbs().maxCoeff();
  for (const auto& block : maps_of_blocks(maps, itinerary))
    EXPECT_LE(block.cwiseAbs().maxCoeff(), 5.0 * one * 1e3);
}

}  // namespace
}  // namespace holdfast
