// Proved charts of many modes against the eigenvalues of the loop's map, and of one mode against
// the proof by Hurwitz's conditions.

#include "holdfast/stability/chart/proved_modal_chart.hpp"

#include "holdfast/control/loop_map.hpp"
#include "holdfast/stability/boundary/resolved_circle.hpp"
#include "support/dense_routes.hpp"
#include "support/random.hpp"
#include "support/string_loop.hpp"
#include "support/testing.hpp"

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
    const ResolvedCircle<double> circle(setting.doubles());
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
    const ResolvedCircle<double> circle(setting.doubles());
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

}  // namespace
}  // namespace holdfast::test
