#include "holdfast/orbit/proof/orbit_range.hpp"

#include "holdfast/orbit/orbit_continuation.hpp"
#include "orbit/proof/proved_orbits.hpp"

namespace holdfast {
namespace {

using Setter = void (*)(IdealLoop<double>&, double);

struct Along {
  const char* name;
  Setter set;
  double at, from, to;
};

const std::vector<Along> keys{
    {"D", [](auto& loop, double x) { loop.gains.differential = x; }, -13.0, -13.5, -12.5},
    {"P", [](auto& loop, double x) { loop.gains.proportional = x; }, -557.0, -580.0, -540.0},
    {"F", [](auto& loop, double x) { loop.excitation.amplitude = x; }, 0.5, 0.45, 0.55},
    {"r0", [](auto& loop, double x) { loop.backlash_width = x; }, 0.0005, 0.0004, 0.0006}};

/// D ↦ the same loop with this D.
auto along_differential_gain(const IdealLoop<double>& loop) {
  return [loop](double gain) {
    IdealLoop<double> other = loop;
    other.gains.differential = gain;
    return other;
  };
}

/// What is proved ends where the continuation, which solves the orbit anew at each value, ends.
TEST(OrbitRange, IsThatOfTheContinuation) {
  const IdealLoop<double> loop = test::proved_loop(0.001, 0.0005);
  const PeriodicOrbit orbit = test::orbit_to_prove(loop);
  for (const Along& key : keys) {
    const auto family = [&](double value) {
      IdealLoop<double> other = loop;
      key.set(other, value);
      return other;
    };
    const double least = continue_orbit(family, orbit, key.at, key.from).parameter;
    const double most = continue_orbit(family, orbit, key.at, key.to).parameter;
    const auto ranges = prove_orbit_along(family, orbit, key.from, key.to, 2e-3);
    double before = key.from, proved = 0.0;
    for (const ProvedOrbitRange& range : ranges) {
      EXPECT_EQ(range.from, before) << key.name;
      before = range.to;
      if (range.proof.outcome != OrbitProofOutcome::proved) continue;
      EXPECT_GE(range.from, least) << key.name;
      EXPECT_LE(range.to, most) << key.name;
      proved += range.to - range.from;
    }
    EXPECT_EQ(before, key.to) << key.name;
    EXPECT_GE(proved, most - least - 2e-2 * (key.to - key.from)) << key.name;
  }
}

/// Between two values the states bend away from the proposed line by no more than is proved.
TEST(OrbitRange, BoundsHowTheStatesBend) {
  const IdealLoop<double> loop = test::proved_loop(0.001, 0.0005);
  const PeriodicOrbit orbit = test::orbit_to_prove(loop);
  const auto family = along_differential_gain(loop);
  const auto states_at = [&](double gain) {
    const ItineraryMaps<double> maps(family(gain), orbit.ratio);
    return periodic_solution(maps, orbit.itinerary, maps_of_blocks(maps, orbit.itinerary))->states;
  };
  const double from = -13.003, to = -12.997;
  const OrbitProof proof = detail::proof_between(family, orbit, from, to);
  EXPECT_EQ(proof.outcome, OrbitProofOutcome::proved);
  const auto first = states_at(from), last = states_at(to);
  double most = 0.0;
  for (const double share : {0.1, 0.5, 0.7}) {
    const auto states = states_at(from + share * (to - from));
    for (std::size_t j = 0; j < states.size(); ++j) {
      const Vector<double, 5> bend = states[j] - (first[j] + share * (last[j] - first[j]));
      most = std::max({most, std::abs(bend[0]), std::abs(bend[2])});
      EXPECT_LE(std::abs(bend[1]), proof.velocity_error);
    }
  }
  EXPECT_GT(most, 1e-12);
  EXPECT_LE(most, proof.displacement_error);
}

/// A tangent to the states at the middle leaves them at the ends by no more than is proved.
TEST(OrbitRange, BoundsHowTheStatesLeaveATangent) {
  const IdealLoop<double> loop = test::proved_loop(0.001, 0.0005);
  const PeriodicOrbit orbit = test::orbit_to_prove(loop);
  const auto family = along_differential_gain(loop);
  const double from = -13.003, to = -12.997, narrow = 0.1;  // of which the chord is a tangent
  const auto states_at = [&](double gain) {
    const ItineraryMaps<double> maps(family(gain), orbit.ratio);
    return periodic_solution(maps, orbit.itinerary, maps_of_blocks(maps, orbit.itinerary))->states;
  };
  const double centre = 0.5 * (from + to), reach = 0.5 * narrow * (to - from);
  const auto middle = states_at(centre), last = states_at(to);
  const auto lower = states_at(centre - reach), upper = states_at(centre + reach);
  auto before = middle, after = middle;
  for (std::size_t j = 0; j < middle.size(); ++j) {
    const Vector<double, 5> way = 0.5 / narrow * (upper[j] - lower[j]);
    before[j] -= way;
    after[j] += way;
  }
  const detail::SegmentOfLoops loops(enclosed(family(from)), enclosed(family(to)), orbit.ratio);
  const OrbitProof proof = detail::OrbitProver(loops, orbit, before, after).prove(HUGE_VAL);
  EXPECT_EQ(proof.outcome, OrbitProofOutcome::proved);
  double most = 0.0;
  for (std::size_t j = 0; j < middle.size(); ++j)
    for (const Eigen::Index i : {0, 2}) most = std::max(most, std::abs(last[j][i] - after[j][i]));
  EXPECT_GT(most, 1e-12);
  EXPECT_LE(most, proof.displacement_error);
}

/// What is said of a range holds in all of its parts: the largest bound of the multipliers.
TEST(OrbitRange, BoundsTheMultipliersOfAllItsLoops) {
  const IdealLoop<double> loop = test::proved_loop(0.001, 0.0);
  const PeriodicOrbit orbit = test::orbit_to_prove(loop);
  const auto family = along_differential_gain(loop);
  const auto multiplier = [&](double gain) {
    const auto at = family(gain);
    return orbit_of_itinerary(at, orbit.ratio, ItineraryMaps<double>(at, orbit.ratio),
                              orbit.itinerary, Backlash<double>(0.0))
        .orbit->largest_multiplier();
  };
  for (const ProvedOrbitRange& range : prove_orbit_along(family, orbit, -24.0, -4.0, 1e-2)) {
    if (range.proof.outcome != OrbitProofOutcome::proved) continue;
    for (int k = 0; k <= 40; ++k) {
      const double gain = range.from + (range.to - range.from) * k / 40.0;
      EXPECT_LE(multiplier(gain), range.proof.multiplier_bound) << gain;
    }
  }
}

TEST(OrbitRange, RefusesOtherFamilies) {
  const IdealLoop<double> loop = test::proved_loop(0.01, 0.002);
  const PeriodicOrbit orbit = test::orbit_to_prove(loop);
  const auto heavier = [&](double mass) {
    IdealLoop<double> other = loop;
    other.plant.absorber_mass = mass;
    return other;
  };
  EXPECT_THROW(prove_orbit_along(heavier, orbit, 0.15, 0.17), InvalidParameter);
  const auto wider = [&](double width) {
    IdealLoop<double> other = loop;
    other.backlash_width = width;
    return other;
  };
  EXPECT_THROW(prove_orbit_along(wider, orbit, 0.002, 0.002), InvalidParameter);
  EXPECT_THROW(prove_orbit_along(wider, orbit, 0.002, 0.001), InvalidParameter);
  EXPECT_THROW(prove_orbit_along(wider, orbit, 0.001, HUGE_VAL), InvalidParameter);
  EXPECT_THROW(prove_orbit_along(wider, orbit, 0.001, 0.002, 0.0), InvalidParameter);
}

}  // namespace
}  // namespace holdfast
