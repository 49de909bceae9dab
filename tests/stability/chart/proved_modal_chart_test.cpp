// Proved charts of many modes against the eigenvalues of the loop's map, and of one mode against
// the proof by Hurwitz's conditions.

#include "holdfast/stability/chart/proved_modal_chart.hpp"
#include "holdfast/control/loop_map.hpp"
#include "holdfast/stability/boundary/unit_circle_crossings.hpp"

#include "support/dense_routes.hpp"
#include "support/random.hpp"
#include "support/string_loop.hpp"

namespace holdfast::test {
namespace {

std::vector<StringLoop> charted_loops() {
  return {{string_with_absorber(40, 0.02), {0.001, 0.0}},
          {string_with_absorber(12, 0.02), {0.003, 0.003}},
          {string_with_absorber(10, 1e-3), {0.004, 0.0107}},
          {string_with_absorber(6, 0.02, {80.0, 60.0, 0.7}), {0.003, 0.002}}};
}

const GainGrid grid{{-1000.0, 200.0, 13}, {-40.0, 20.0, 13}};

constexpr auto unwatched = [] {};

ProvedChart chart_of(const StringLoop& setting, double undecided = 2e-3) {
  return proved_chart(setting.enclosed(), grid, undecided, unwatched);
}

PdGains<double> random_gains_in(const GainBox& box, Random& random) {
  // Corners too, where the decisions are nearest to the boundary.
  const auto between = [&](double from, double to) {
    const double share =
        random.index(2) == 0 ? random.unit() : static_cast<double>(random.index(2));
    return std::clamp(from + share * (to - from), from, to);
  };
  return {between(box.proportional_from, box.proportional_to),
          between(box.differential_from, box.differential_to)};
}

TEST(ProvedModalChart, LeavesLittleUndecidedAndNothingOut) {
  for (const StringLoop& setting : charted_loops()) {
    const ProvedChart chart = chart_of(setting);
    EXPECT_NEAR(chart.area(), 1200.0 * 60.0, 1e-6);
    EXPECT_LE(chart.share(ProvedStability::undecided), 2e-3);
    EXPECT_GT(chart.share(ProvedStability::stable), 0.02);
    EXPECT_GT(chart.share(ProvedStability::unstable), 0.02);
    for (std::size_t k = 1; k < chart.boxes.size(); ++k) {
      const GainBox &before = chart.boxes[k - 1].gains, &box = chart.boxes[k].gains;
      EXPECT_LT(std::pair(before.proportional_from, before.differential_from),
                std::pair(box.proportional_from, box.differential_from));
    }
  }
}

TEST(ProvedModalChart, NoEigenvalueContradictsIt) {
  Random random(1);
  for (const StringLoop& setting : charted_loops()) {
    const ProvedChart chart = chart_of(setting);
    const LoopMap<double> map = setting.map();
    const UnitCircleCrossings<double> circle(setting.doubles());
    std::array<int, 3> asked{};
    for (int trial = 0; trial < 20000; ++trial) {
      const auto& [box, stability] = chart.boxes[random.index(chart.boxes.size())];
      if (stability == ProvedStability::undecided) continue;
      const PdGains<double> gains = random_gains_in(box, random);
      const bool is_stable = stability == ProvedStability::stable;
      ++asked.at(static_cast<std::size_t>(stability));
      // By winding in doubles, and each twentieth by eigenvalues.
      const int outside = circle.roots_outside(gains);
      if (outside >= 0) {
        EXPECT_EQ(outside == 0, is_stable) << gains.proportional << " " << gains.differential;
      }
      if (trial % 20 != 0 || map.size() > 40) continue;
      const double radius = moduli_of(map.closed_map(gains))[0];
      if (is_stable)
        EXPECT_LT(radius, 1.0 + 1e-11) << gains.proportional << " " << gains.differential;
      else
        EXPECT_GT(radius, 1.0 - 1e-11) << gains.proportional << " " << gains.differential;
    }
    EXPECT_GT(asked[0], 500);
    EXPECT_GT(asked[1], 500);
  }
}

/// No cell that is proved holds gains at which a root is on the circle.
TEST(ProvedModalChart, StableCellsHoldNoBoundary) {
  for (const StringLoop& setting : charted_loops()) {
    const ProvedChart chart = chart_of(setting);
    const UnitCircleCrossings<double> circle(setting.doubles());
    int seen = 0;
    for (double p = -990.0; p < 200.0; p += 61.7)
      for (const auto& interval : circle.stable_gains(FreeGain::differential, {p, 0.0}))
        for (const double d : {interval.lower, interval.upper})
          for (const auto& [box, stability] : chart.boxes)
            if (box.proportional_from < p && p < box.proportional_to &&
                box.differential_from + 1e-6 < d && d < box.differential_to - 1e-6) {
              EXPECT_EQ(stability, ProvedStability::undecided) << p << " " << d;
              ++seen;
            }
    EXPECT_GT(seen, 5);
  }
}

/// Of one mode and no clamp the two masses: two proofs of one chart.
TEST(ProvedModalChart, OfOneModeIsThatOfHurwitz) {
  const TwoMass<double> masses = kollar2022_plant();
  const double omega = std::sqrt(masses.conductor_stiffness / masses.conductor_mass);
  ConductorWithAbsorber conductor{
      {{omega, masses.conductor_damping / (2.0 * omega * masses.conductor_mass), 1.0,
        masses.conductor_mass}},
      {masses.absorber_mass, masses.absorber_stiffness, masses.absorber_damping},
      {}};
  conductor.poles = plant_poles(conductor.modes, conductor.absorber);
  for (const Sampling<double>& sampling :
       {Sampling<double>{0.001, 0.0}, {0.003, 0.003}, {0.011, 0.004}}) {
    const ProvedChart ours = chart_of({conductor, sampling}, 1e-3);
    const ProvedChart theirs = proved_chart(gain_box_proof(masses, sampling), grid, 1e-3);
    for (const auto stability : {ProvedStability::stable, ProvedStability::unstable})
      EXPECT_NEAR(ours.share(stability), theirs.share(stability), 1e-3);
    const auto proof = gain_box_proof(masses, sampling);
    for (const auto& [box, stability] : ours.boxes) {
      if (stability == ProvedStability::undecided) continue;
      const ProvedStability other = proof(box);
      EXPECT_TRUE(other == stability || other == ProvedStability::undecided);
    }
  }
}

/// A root may lie on the circle at all gains.
TEST(ProvedModalChart, IsUndecidedWhereAMotionIsNotDamped) {
  ConductorWithAbsorber conductor = string_with_absorber(4, 0.0);
  conductor.modes[2].shape = 0.0;  // so that the absorber does not damp it
  conductor.poles = plant_poles(conductor.modes, conductor.absorber);
  const ProvedChart chart = chart_of({conductor, {0.01, 0.0}});
  EXPECT_EQ(chart.share(ProvedStability::undecided), 1.0);
  EXPECT_EQ(chart.boxes.size(), 144U);
}

TEST(ProvedModalChart, EndsWhereItIsTold) {
  const EnclosedResponse response =
      StringLoop{string_with_absorber(4, 0.02), {0.01, 0.0}}.enclosed();
  const ProvedChart chart = proved_chart(response, grid, 0.0, unwatched, 2000);
  EXPECT_LE(chart.boxes.size(), 2000U);
  EXPECT_GT(chart.share(ProvedStability::undecided), 1e-4);
  struct Enough {};
  EXPECT_THROW(proved_chart(response, grid, 1e-3, [] { throw Enough(); }), Enough);
  EXPECT_THROW(proved_chart(response, {{0.0, 1.0, 1}, {0.0, 1.0, 5}}, 1e-3, unwatched),
               InvalidParameter);
  EXPECT_THROW(proved_chart(response, grid, -0.1, unwatched), InvalidParameter);
}

/// Whether two boxes share a side's piece of some length.
bool share_a_side(const GainBox& a, const GainBox& b) {
  const double p = std::min(a.proportional_to, b.proportional_to) -
                   std::max(a.proportional_from, b.proportional_from);
  const double d = std::min(a.differential_to, b.differential_to) -
                   std::max(a.differential_from, b.differential_from);
  return (p == 0.0 && d > 0.0) || (d == 0.0 && p > 0.0);
}

/// Of each box the least number of its region, by going through all pairs until nothing changes.
std::vector<std::size_t> regions_by_pairs(const std::vector<GainBox>& boxes) {
  std::vector<std::size_t> least(boxes.size());
  std::iota(least.begin(), least.end(), std::size_t{0});
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t k = 0; k < boxes.size(); ++k)
      for (std::size_t j = 0; j < k; ++j)
        if (least[k] != least[j] && share_a_side(boxes[k], boxes[j])) {
          least[k] = least[j] = std::min(least[k], least[j]);
          changed = true;
        }
  }
  return least;
}

/// Boxes that are quartered at random, some left out.
void add_parts(const GainBox& box, double keep, int depth, Random& random,
               std::vector<GainBox>& boxes) {
  if (depth == 0 || random.unit() < 0.3) {
    if (random.unit() < keep) boxes.push_back(box);
    return;
  }
  for (const GainBox& quarter : detail::quarters_of(box))
    add_parts(quarter, keep, depth - 1, random, boxes);
}

TEST(JoinedBoxes, AreThoseWithAWayBetweenThem) {
  Random random(1);
  std::size_t most = 0, regions_seen = 0;
  for (int trial = 0; trial < 400; ++trial) {
    std::vector<GainBox> boxes;
    add_parts({-3.0, 0.0, 0.0, 1.0}, random.uniform(0.3, 0.9), 4, random, boxes);
    add_parts({0.0, 3.0, 0.0, 1.0}, random.uniform(0.3, 0.9), 3, random, boxes);
    add_parts({0.0, 3.0, 1.0, 2.0}, random.uniform(0.3, 0.9), 3, random, boxes);
    std::shuffle(boxes.begin(), boxes.end(), std::mt19937(static_cast<unsigned>(trial)));
    const auto regions = joined_boxes(boxes);
    const auto expected = regions_by_pairs(boxes);
    ASSERT_EQ(regions.size(), boxes.size());
    for (std::size_t k = 0; k < boxes.size(); ++k) {
      EXPECT_EQ(regions[regions[k]], regions[k]);
      for (std::size_t j = 0; j < k; ++j)
        EXPECT_EQ(regions[k] == regions[j], expected[k] == expected[j]) << trial;
    }
    most = std::max(most, boxes.size());
    regions_seen += std::set<std::size_t>(regions.begin(), regions.end()).size();
  }
  EXPECT_GT(most, 100U);
  EXPECT_GT(regions_seen, 2000U);
}

TEST(JoinedBoxes, ACornerIsNoWay) {
  const auto regions = joined_boxes({{0.0, 1.0, 0.0, 1.0}, {1.0, 2.0, 1.0, 2.0}});
  EXPECT_NE(regions[0], regions[1]);
  EXPECT_TRUE(joined_boxes({}).empty());
}

}  // namespace
}  // namespace holdfast::test
