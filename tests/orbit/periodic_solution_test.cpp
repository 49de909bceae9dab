#include "holdfast/orbit/periodic_orbit.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "support/dense_routes.hpp"
#include "support/kollar_case.hpp"
#include "support/random.hpp"

namespace holdfast {
namespace {

using AffineMaps = std::vector<AffineMap<double>>;
using DenseMatrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
using DenseVector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;

/// z̃₀ of the closed sequence from its whole block-cyclic system, in long double.
Vector<double, 5> first_of_cycle(const AffineMaps& maps) {
  const auto size = static_cast<Eigen::Index>(5 * maps.size());
  DenseMatrix system = DenseMatrix::Identity(size, size);
  DenseVector right(size);
  for (Eigen::Index k = 0; k < size; k += 5) {
    const AffineMap<double>& map = maps[static_cast<std::size_t>(k / 5)];
    const Eigen::Index next = (k + 5) % size;
    system.block<5, 5>(next, k) -= map.map.cast<long double>();
    right.segment<5>(next) = map.addition.cast<long double>();
  }
  return DenseVector(system.fullPivLu().solve(right)).head<5>().cast<double>();
}

Vector<double, 5> first_by_ends(const AffineMaps& maps) {
  return CyclicSystem<double>(maps).first_state();
}

AffineMaps random_affine_maps(test::Random& random, std::size_t count, double scale) {
  AffineMaps maps(count);
  for (auto& map : maps) {
    map.map = scale * random.matrix<Matrix<double, 5>>();
    map.addition = random.matrix<Vector<double, 5>>();
  }
  return maps;
}

TEST(CondensedBoundary, OfOneMapIsThatMap) {
  test::Random random(811);
  const AffineMaps maps = random_affine_maps(random, 1, 1.0);
  const CondensedBoundary<double> ends = condensed_boundary(maps);
  const Vector<double, 5> first = random.matrix<Vector<double, 5>>();
  const Vector<double, 5> last = maps[0].map * first + maps[0].addition;
  EXPECT_LE((ends.first * first + ends.last * last - ends.addition).norm(), 1e-14);
}

TEST(CondensedBoundary, HoldsForTheEndsOfEverySequence) {
  test::Random random(812);
  for (int trial = 0; trial < 100; ++trial) {
    const AffineMaps maps = random_affine_maps(random, 1 + random.index(40), 0.4);
    const CondensedBoundary<double> ends = condensed_boundary(maps);
    const Vector<double, 5> first = random.matrix<Vector<double, 5>>();
    Vector<double, 5> last = first;
    for (const auto& map : maps) last = map.map * last + map.addition;
    EXPECT_LE((ends.first * first + ends.last * last - ends.addition).norm(), 1e-12) << trial;
  }
}

TEST(CondensedBoundary, ClosesContractionsAndExpansionsAlike) {
  // Scales from contraction by a hundred a map to expansion by ten: the product spans 1e±60.
  test::Random random(813);
  for (const double scale : {0.01, 0.3, 0.6, 1.0, 10.0}) {
    for (int trial = 0; trial < 10; ++trial) {
      const AffineMaps maps = random_affine_maps(random, 2 + random.index(29), scale);
      const Vector<double, 5> expected = first_of_cycle(maps), found = first_by_ends(maps);
      EXPECT_LE((found - expected).norm(), 1e-10 * expected.norm()) << scale << ' ' << trial;
    }
  }
}

TEST(CondensedBoundary, ClosesSequencesThatGrowByAMillionOnTheirWay) {
  // Some maps expand by a hundred and others contract by more: no digit may be lost to the peak.
  test::Random random(814);
  for (int trial = 0; trial < 20; ++trial) {
    AffineMaps maps = random_affine_maps(random, 30, 0.3);
    for (std::size_t k = 10; k < 13; ++k) maps[k].map *= 300.0;
    for (std::size_t k = 20; k < 23; ++k) maps[k].map *= 1e-3;
    const Vector<double, 5> expected = first_of_cycle(maps), found = first_by_ends(maps);
    EXPECT_LE((found - expected).norm(), 1e-9 * expected.norm()) << trial;
  }
}

TEST(CondensedBoundary, ClosesGrowingAndDecayingDirectionsTogether) {
  // Products of 1e40 and 1e-40 at once: neither direction alone could be followed.
  test::Random random(815);
  Matrix<double, 5> saddle = Matrix<double, 5>::Zero();
  saddle.diagonal() << 25.0, 10.0, 0.5, 0.1, 0.04;
  for (int trial = 0; trial < 20; ++trial) {
    const Matrix<double, 5> turn = test::orthogonal_factor_of(random.matrix<Matrix<double, 5>>());
    AffineMaps maps = random_affine_maps(random, 30, 1.0);
    for (auto& map : maps) map.map = turn * saddle * turn.transpose();
    const Vector<double, 5> expected = first_of_cycle(maps), found = first_by_ends(maps);
    EXPECT_LE((found - expected).norm(), 1e-12 * expected.norm()) << trial;
  }
}

TEST(CyclicSystem, IsTheSameForAnOrderKnownAtRunTimeAlone) {
  test::Random random(819);
  for (int trial = 0; trial < 20; ++trial) {
    const AffineMaps maps = random_affine_maps(random, 1 + random.index(20), 0.6);
    std::vector<AffineMap<double, Eigen::Dynamic>> others;
    for (const auto& map : maps) others.push_back({map.map, map.addition});
    const CyclicSystem<double> system(maps);
    const CyclicSystem<double, Eigen::Dynamic> other(others);
    const Vector<double, 5> first = system.first_state();
    EXPECT_LE((other.first_state() - first).norm(), 1e-12 * first.norm()) << trial;
  }
}

TEST(CyclicSystem, CorrectsAMotionThatDoesNotClose) {
  test::Random random(820);
  for (int trial = 0; trial < 20; ++trial) {
    const AffineMaps maps = random_affine_maps(random, 1 + random.index(20), 0.3);
    const CyclicSystem<double> system(maps);
    const Vector<double, 5> first = random.matrix<Vector<double, 5>>();
    Vector<double, 5> last = first;
    for (const auto& map : maps) last = map.map * last + map.addition;
    const Vector<double, 5> corrected = first + system.correction(last - first);
    EXPECT_LE((corrected - system.first_state()).norm(), 1e-12 * first.norm()) << trial;
  }
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
std::optional<PeriodicSolution<Scalar>> solve_sequence(const ContactSequence& sequence) {
  const ItineraryMaps<Scalar> maps(converted<Scalar>(sequence.loop), sequence.ratio);
  return periodic_solution(maps, sequence.itinerary, affine_blocks(maps, sequence.itinerary));
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
    AffineMaps singles;
    for (std::size_t j = 0; j < sequence.itinerary.size(); ++j) {
      const bool engaged = sequence.itinerary[j] != 0;
      singles.push_back({maps.map(engaged), maps.step(Vector<double, 5>::Zero(), engaged, j % 10)});
    }
    const Vector<double, 5> expected = first_of_cycle(singles);
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
    // A similarity X diag(1, …) X⁻¹ over two maps.
    const Matrix<double, 5> basis =
        random.matrix<Matrix<double, 5>>() + 3.0 * Matrix<double, 5>::Identity();
    Matrix<double, 5> values = Matrix<double, 5>::Zero();
    values.diagonal() << 1.0, 0.5, -0.7, 0.2, 0.0;
    const AffineMaps closed{{values * basis.inverse(), random.matrix<Vector<double, 5>>()},
                            {basis, random.matrix<Vector<double, 5>>()}};
    EXPECT_FALSE(periodic_solution(maps, sequence.itinerary, closed)) << trial;
  }
}

TEST(PeriodicSolution, ThereIsOneJustBesideASingularSequence) {
  test::Random random(819);
  Matrix<double, 5> map = Matrix<double, 5>::Zero();
  map.diagonal() << 1.0 - 1e-9, 0.5, -0.7, 0.2, 0.0;
  const Vector<double, 5> addition = random.matrix<Vector<double, 5>>();
  const Vector<double, 5> found = first_by_ends({{map, addition}});
  for (int i = 0; i < 5; ++i)
    EXPECT_NEAR(found[i], addition[i] / (1.0 - map(i, i)), 1e-6 * std::abs(found[i]));
}

}  // namespace
}  // namespace holdfast
