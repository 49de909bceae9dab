#include "holdfast/stability/chart/proved_chart.hpp"

#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/stability/boundary/stable_intervals.hpp"
#include "holdfast/stability/polynomial/loop_polynomial.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

const GainGrid paper_grid{{-1000.0, 200.0, 31}, {-40.0, 20.0, 31}};

/// The box that a point lies in; of those that share an edge one.
const ProvedBox& box_at(const ProvedChart& chart, double p, double d) {
  for (const ProvedBox& box : chart.boxes)
    if (box.gains.proportional_from <= p && p <= box.gains.proportional_to &&
        box.gains.differential_from <= d && d <= box.gains.differential_to)
      return box;
  throw std::logic_error("the chart has a hole");
}

const std::vector<Sampling<double>> samplings{
    {0.001, 0.0}, {0.002, 0.002}, {0.005, 0.0031}, {0.011, 0.011}, {0.1, 0.0}};

TEST(ProvedChart, LeavesLittleUndecided) {
  for (const Sampling<double>& sampling : samplings) {
    const auto proof = gain_box_proof(kollar2022_plant(), sampling);
    const ProvedChart chart = proved_chart(proof, paper_grid, 1e-3);
    EXPECT_LE(chart.share(ProvedStability::undecided), 1e-3) << sampling.period;
    EXPECT_GT(chart.share(ProvedStability::unstable), 0.1) << sampling.period;
    EXPECT_LT(proved_chart(proof, paper_grid, 1e-4).share(ProvedStability::undecided), 1e-4);
  }
}

TEST(ProvedChart, HasNeitherHolesNorOverlaps) {
  const ProvedChart chart =
      proved_chart(gain_box_proof(kollar2022_plant(), {0.005, 0.0}), paper_grid);
  EXPECT_NEAR(chart.area(), 1200.0 * 60.0, 1e-6);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> p(-1000.0, 200.0), d(-40.0, 20.0);
  for (int trial = 0; trial < 300; ++trial) EXPECT_NO_THROW(box_at(chart, p(random), d(random)));
}

/// 10⁵ random loops by their roots, in extended precision.
TEST(ProvedChart, NoRootContradictsIt) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (const Sampling<double>& sampling : samplings) {
    const ProvedChart chart =
        proved_chart(gain_box_proof(kollar2022_plant(), sampling), paper_grid);
    const auto polynomial = loop_polynomial(
        sampled_loop(converted<long double>(kollar2022_plant()),
                     Sampling<long double>{sampling.period, sampling.processing_delay}));
    for (int trial = 0; trial < 20000; ++trial) {
      const auto& [box, stability] = chart.boxes[random() % chart.boxes.size()];
      const double p =
          box.proportional_from + share(random) * (box.proportional_to - box.proportional_from);
      const double d =
          box.differential_from + share(random) * (box.differential_to - box.differential_from);
      if (stability == ProvedStability::undecided) continue;
      const long double excess = polynomial.excess({p, d});
      EXPECT_EQ(excess < 0.0L, stability == ProvedStability::stable)
          << p << " " << d << " " << static_cast<double>(excess);
    }
  }
}

/// Ends of the stable intervals, which another way finds, are in no box that is decided.
TEST(ProvedChart, TheBoundaryIsUndecided) {
  const Sampling<double> sampling{0.002, 0.0};
  const auto proof = gain_box_proof(kollar2022_plant(), sampling);
  const auto polynomial = characteristic_polynomial(sampled_loop(kollar2022_plant(), sampling));
  int ends = 0;
  for (double p = -900.0; p < 60.0; p += 7.3)
    for (const Interval<double>& interval : stable_differential_gains(polynomial, p))
      for (const double d : {interval.lower, interval.upper}) {
        if (!std::isfinite(d)) continue;
        ++ends;
        for (const double size : {1e-13, 1e-6, 1.0})
          EXPECT_EQ(proof({p - size, p + size, d - size, d + size}), ProvedStability::undecided)
              << p << " " << d << " " << size;
        const ProvedStability outside = proof({p - 1e-9, p + 1e-9, d + 1e-6, d + 1.001e-6});
        const ProvedStability inside = proof({p - 1e-9, p + 1e-9, d - 1.001e-6, d - 1e-6});
        EXPECT_NE(outside, ProvedStability::undecided);
        EXPECT_NE(inside, ProvedStability::undecided);
        EXPECT_NE(inside, outside);
      }
  EXPECT_GT(ends, 100);
}

TEST(ProvedChart, OfTheContinuousLoopIsThatOfRouthAndHurwitz) {
  const ProvedChart chart = proved_chart(gain_box_proof(kollar2022_plant()), paper_grid);
  EXPECT_LE(chart.share(ProvedStability::undecided), 1e-3);
  const auto polynomial = characteristic_polynomial(converted<long double>(kollar2022_plant()));
  for (const auto& [box, stability] : chart.boxes) {
    if (stability == ProvedStability::undecided) continue;
    const long double p = 0.5L * (box.proportional_from + box.proportional_to);
    const long double d = 0.5L * (box.differential_from + box.differential_to);
    EXPECT_EQ(is_hurwitz<long double>(polynomial.at({p, d})), stability == ProvedStability::stable);
  }
}

/// Without damping and control every root lies on the imaginary axis: nothing is to be proved
/// there.
TEST(ProvedChart, WhatIsOnTheBoundaryItselfStaysUndecided) {
  TwoMass<double> undamped = kollar2022_plant();
  undamped.conductor_damping = undamped.absorber_damping = 0.0;
  const auto proof = gain_box_proof(undamped);
  EXPECT_EQ(proof({-1e-3, 1e-3, 0.0, 1e-9}), ProvedStability::undecided);
}

TEST(ProvedChart, RefusesWhatIsNotAdmissible) {
  const auto proof = gain_box_proof(kollar2022_plant(), {0.001, 0.0});
  EXPECT_THROW(proved_chart(proof, {{0.0, 1.0, 1}, {0.0, 1.0, 5}}), InvalidParameter);
  EXPECT_THROW(proved_chart(proof, {{1.0, 0.0, 5}, {0.0, 1.0, 5}}), InvalidParameter);
  EXPECT_THROW(proved_chart(proof, paper_grid, -0.1), InvalidParameter);
  EXPECT_THROW(gain_box_proof(kollar2022_plant(), {0.001, 0.002}), InvalidParameter);
  EXPECT_THROW(gain_box_proof({}), InvalidParameter);
  EXPECT_GT(proved_chart(proof, paper_grid, 0.0, 2000).share(ProvedStability::undecided), 1e-3);
}

}  // namespace
}  // namespace holdfast
