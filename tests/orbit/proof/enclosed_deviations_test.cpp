#include "holdfast/orbit/proof/enclosed_deviations.hpp"

#include "holdfast/orbit/proof/segment_of_loops.hpp"
#include "holdfast/orbit/region_of_attraction.hpp"
#include "orbit/proof/proved_orbits.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

using Wide = Eigen::Matrix<long double, 5, 6>;

/// An orbit of 30 samples and what its deviations are followed by.
struct FollowedOrbit {
  IdealLoop<double> loop = test::proved_loop(0.01, 0.002);
  PeriodicOrbit orbit = test::orbit_to_prove(loop);
  Vector<double, 6> weights = deviation_weights(loop);
  detail::SegmentOfLoops<Enclosure> loops{enclosed(loop), orbit.ratio};
  ContractingNorms<5> norms =
      ContractingNorms<5>::of(loops.ends(), orbit.itinerary, orbit.multipliers.front().log_modulus)
          .value();
  SwitchingPattern pattern =
      switching_pattern(orbit.states, Backlash<double>(loop.backlash_width, orbit.memory));

  detail::EnclosedDeviations<Enclosure> deviations() const {
    return {norms, weights, loops.units()};
  }

  void advance(detail::EnclosedDeviations<Enclosure>& deviations, std::size_t j) const {
    deviations.advance(j, (j + 1) % orbit.states.size(), pattern.decisions[j],
                       loops.ends().front().at(orbit.itinerary[j]));
  }
};

/// Deviations of extended precision lie as near to the doubles as is claimed, over many periods.
TEST(EnclosedDeviations, HoldThoseOfExtendedPrecision) {
  const FollowedOrbit followed;
  const IdealLoop<double>& loop = followed.loop;
  const PeriodicOrbit& orbit = followed.orbit;
  const ItineraryMaps<long double> maps(converted<long double>(loop), orbit.ratio);
  auto ours = followed.deviations();
  Wide exact = Wide::Zero();
  for (int i = 0; i < 5; ++i)
    exact(i, i) = 1.0L / (static_cast<long double>(followed.weights[i]) * maps.units()[i]);
  const auto expect_near = [](const detail::RowWithError& row, const auto& wide) {
    const long double apart = (row.row.cast<long double>() - wide).norm();
    EXPECT_LE(apart, row.error.upper() * (1.0 + 1e-9) + 1e-18);
    EXPECT_LT(row.error.upper(), 1e-9);
  };
  const std::size_t samples = orbit.states.size();
  Eigen::Matrix<long double, 1, 6> gap = Eigen::Matrix<long double, 1, 6>::Unit(5);
  for (std::size_t k = 0; k < 10 * samples; ++k) {
    const std::size_t j = k % samples;
    expect_near(ours.relative(j, false), exact.row(2) - exact.row(0));
    expect_near(ours.relative(j, true), exact.row(3) - exact.row(1));
    expect_near(ours.gap(), gap);
    const ContactDecision& decision = followed.pattern.decisions[j];
    if (decision.engaged) gap.setZero();
    if (!decision.engaged && !decision.was_inside) gap = exact.row(2) - exact.row(0);
    exact = (maps.map_in_units(orbit.itinerary[j] != 0) * exact).eval();
    followed.advance(ours, j);
  }
}

/// √Σ of the weighted entries is below one when they say so, and they do say so in the end.
TEST(EnclosedDeviations, ContractAsTheMultipliersSay) {
  const FollowedOrbit followed;
  const IdealLoop<double>& loop = followed.loop;
  const PeriodicOrbit& orbit = followed.orbit;
  auto ours = followed.deviations();
  EXPECT_FALSE(ours.have_contracted(true));
  detail::DeviationFlow<detail::SampledDeviations<double>> flow(
      detail::SampledDeviations<double>(loop, ItineraryMaps<double>(loop, orbit.ratio)),
      loop.backlash_width, orbit);
  Matrix<double, 6> all = Matrix<double, 6>::Identity();
  const Matrix<double, 6> period = flow.over(orbit.period_samples());
  bool have = false;
  for (int turn = 0; turn < 60; ++turn) {
    for (std::size_t j = 0; j < orbit.states.size(); ++j) followed.advance(ours, j);
    all = period * all;
    have = ours.have_contracted(true);
    if (std::abs(all.norm() - 1.0) > 1e-3) {
      EXPECT_EQ(have, all.norm() < 1.0) << turn;
    }
  }
  EXPECT_TRUE(have);
}

TEST(EnclosedDeviations, ARowKnowsWhatItsSubtractionRounds) {
  const detail::RowWithError third{RowVector<double, 6>::Constant(1.0 / 3.0), Enclosure(1e-20)};
  const detail::RowWithError one{RowVector<double, 6>::Constant(1.0), Enclosure(2e-20)};
  const detail::RowWithError apart = one - third;
  EXPECT_GE(apart.error.upper(), 3e-20);
  EXPECT_GE(apart.error.upper(),
            6.0 * 0.5 * (2.0 / 3.0) * std::numeric_limits<double>::epsilon() / 2.0);
  EXPECT_LT(apart.error.upper(), 1e-14);
  EXPECT_GE(apart.length().upper(), 2.0 / 3.0 * std::sqrt(6.0));
}

}  // namespace
}  // namespace holdfast
