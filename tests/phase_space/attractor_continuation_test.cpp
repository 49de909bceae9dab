#include "holdfast/phase_space/attractor_continuation.hpp"

#include <numeric>

#include "support/kollar_case.hpp"
#include "support/random_states.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

constexpr auto in_turn = [](std::size_t count, std::size_t tile, const auto& job) {
  for (std::size_t first = 0; first < count; first += tile)
    job(first, std::min(tile, count - first));
};

IdealLoop<double> followed_loop(double width) {
  return {kollar2022_plant(), {0.003, 0.0}, {-557.0, -13.0}, {0.5, 10.0}, width};
}

std::vector<Vector<double, 4>> some_states(std::size_t count) {
  return test::random_states(17, count);
}

BasinMap basins_at(double width, const std::vector<Vector<double, 4>>& states) {
  return find_basins<double>(followed_loop(width), states, {20000, 0}, in_turn);
}

TEST(OrbitDistance, IsZeroOfShiftedCopiesAndGrowsWithTheLoopsApart) {
  const auto basins = basins_at(0.002, some_states(20));
  ASSERT_GE(basins.attractors.size(), 2U) << "motions coexist at 3 ms, 2 mm";
  const PeriodicOrbit &one = basins.attractors[0].orbit, &other = basins.attractors[1].orbit;
  EXPECT_EQ(orbit_distance(one, one), 0.0);
  EXPECT_GT(orbit_distance(one, other), 1e-3);
  EXPECT_EQ(orbit_distance(one, other), orbit_distance(other, one));
  PeriodicOrbit shifted = one;
  std::rotate(shifted.states.begin(), shifted.states.begin() + one.ratio.denominator,
              shifted.states.end());
  EXPECT_EQ(orbit_distance(one, shifted), 0.0);
}

TEST(AttractorMatching, KeepsTheNumbersOfTheNearest) {
  const auto basins = basins_at(0.002, some_states(20));
  std::vector<PeriodicOrbit> orbits;
  for (const auto& attractor : basins.attractors) orbits.push_back(attractor.orbit);
  AttractorMatching<PeriodicOrbit> matching(0.1);
  const std::vector<int> first = matching.match(orbits);
  std::vector<int> expected(orbits.size());
  std::iota(expected.begin(), expected.end(), 0);
  EXPECT_EQ(first, expected);
  // However far they may lie apart, the nearest goes first.
  AttractorMatching<PeriodicOrbit> loose(10.0);
  loose.match(orbits);
  std::reverse(orbits.begin(), orbits.end());
  std::reverse(expected.begin(), expected.end());
  EXPECT_EQ(matching.match(orbits), expected);
  EXPECT_EQ(loose.match(orbits), expected);
  // One is gone, and comes back as another.
  orbits.pop_back();
  expected.pop_back();
  EXPECT_EQ(matching.match(orbits), expected);
  EXPECT_EQ(matching.match({basins.attractors[0].orbit}).front(), static_cast<int>(first.size()));
}

TEST(AttractorContinuation, FractionsAreThoseOfTheStatesAlone) {
  const auto states = some_states(40);
  AttractorContinuation<PeriodicOrbit> continuation(states, 0.2);
  for (const double width : {0.00200, 0.00201, 0.00202}) {
    const auto followed =
        continuation.next([&](const auto& starts) { return basins_at(width, starts); });
    const auto alone = basins_at(width, states);
    std::size_t counted = followed.diverging + followed.unknown;
    for (const auto& attractor : followed.attractors) {
      counted += attractor.states;
      EXPECT_NEAR(attractor.fraction, static_cast<double>(attractor.states) / 40.0, 1e-15);
      EXPECT_NEAR(attractor.standard_error,
                  std::sqrt(attractor.fraction * (1.0 - attractor.fraction) / 40.0), 0.02);
      EXPECT_GT(attractor.standard_error, 0.0);
      if (attractor.states == 0) continue;
      EXPECT_TRUE(
          std::any_of(alone.attractors.begin(), alone.attractors.end(), [&](const auto& other) {
            return other.states == attractor.states &&
                   is_phase_shifted_copy(other.orbit, attractor.orbit);
          }));
    }
    EXPECT_EQ(counted, states.size());
  }
}

TEST(AttractorContinuation, ASeedKeepsAnAttractorThatNoStateComesTo) {
  const auto states = some_states(40);
  AttractorContinuation<PeriodicOrbit> continuation(states, 0.2);
  const auto first =
      continuation.next([&](const auto& starts) { return basins_at(0.002, starts); });
  ASSERT_GE(first.attractors.size(), 2U);
  // The same loop again, seen from the seeds alone.
  const auto second = continuation.next([&](const auto& starts) {
    std::vector<Vector<double, 4>> none(states.size(), starts.back());
    none.insert(none.end(), starts.begin() + static_cast<std::ptrdiff_t>(states.size()),
                starts.end());
    return basins_at(0.002, none);
  });
  // A seed is a state without its gap, so that it may come to another one too.
  EXPECT_TRUE(
      std::any_of(second.attractors.begin(), second.attractors.end(), [&](const auto& attractor) {
        return attractor.number < static_cast<int>(first.attractors.size());
      }));
}

}  // namespace
}  // namespace holdfast
