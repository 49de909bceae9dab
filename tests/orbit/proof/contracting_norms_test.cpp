#include "holdfast/orbit/proof/contracting_norms.hpp"
#include "holdfast/math/linalg/multipliers.hpp"
#include "holdfast/orbit/proof/enclosed_deviations.hpp"
#include "holdfast/orbit/proof/segment_of_loops.hpp"
#include "holdfast/orbit/region_of_attraction.hpp"

#include "orbit/proof/proved_orbits.hpp"
#include "support/random.hpp"

namespace holdfast {
namespace {

using NormMaps = std::array<Matrix<double, 3>, 2>;

NormMaps norm_maps(test::Random& random) {
  NormMaps maps;
  for (auto& map : maps)
    for (double& entry : map.reshaped()) entry = random.normal();
  return maps;
}

std::vector<std::uint8_t> norm_sequence(test::Random& random) {
  std::vector<std::uint8_t> sequence(1 + random.index(40));
  for (auto& which : sequence) which = static_cast<std::uint8_t>(random.index(2));
  return sequence;
}

std::optional<ContractingNorms<3>> norms_of(const NormMaps& maps,
                                            const std::vector<std::uint8_t>& sequence,
                                            double log_modulus) {
  return ContractingNorms<3>::of({{maps[0].cast<Enclosure>(), maps[1].cast<Enclosure>()}}, sequence,
                                 log_modulus);
}

/// Scales the maps so that the largest multiplier of the sequence is as given.
double scale_norm_maps(NormMaps& maps, const std::vector<std::uint8_t>& sequence, double modulus) {
  std::vector<Matrix<double, 3>> all;
  for (const auto which : sequence) all.push_back(maps.at(which));
  const double log_modulus = multipliers_of_product<double, 3>(all).front().log_modulus;
  const double by = std::exp((std::log(modulus) - log_modulus) / static_cast<double>(all.size()));
  for (auto& map : maps) map *= by;
  return std::log(modulus);
}

TEST(ContractingNorms, ShrinkWhatTheMapsMove) {
  test::Random random(41);
  int found = 0;
  for (int trial = 0; trial < 200; ++trial) {
    NormMaps maps = norm_maps(random);
    const auto sequence = norm_sequence(random);
    const double modulus = random.uniform(0.01, 0.99);
    const auto norms = norms_of(maps, sequence, scale_norm_maps(maps, sequence, modulus));
    if (!norms) continue;
    ++found;
    EXPECT_LT(norms->contraction(), 1.0);
    EXPECT_GE(norms->contraction(), modulus * (1.0 - 1e-9));
    Vector<double, 3> vector(random.normal(), random.normal(), random.normal());
    for (std::size_t j = 0; j < sequence.size(); ++j) {
      const std::size_t next = j + 1 == sequence.size() ? 0 : j + 1;
      const Vector<double, 3> image = maps.at(sequence[j]) * vector;
      const double before = norms->size(j, vector.cast<Enclosure>()).upper();
      const double after = norms->size(next, image.cast<Enclosure>()).lower();
      EXPECT_LE(after, norms->factor(j) * before * (1.0 + 1e-12));
      const RowVector<double, 3> row =
          RowVector<double, 3>::Unit(2) - RowVector<double, 3>::Unit(0);
      EXPECT_LE(std::abs(row.dot(vector)), norms->reading(j, row) * before * (1.0 + 1e-12));
      vector = image.normalized();
    }
  }
  EXPECT_GT(found, 190);
}

/// Of a norm's reading some vector makes use: it is no larger than it has to be.
TEST(ContractingNorms, ReadNoMoreThanSomeVectorShows) {
  test::Random random(42);
  NormMaps maps = norm_maps(random);
  const auto sequence = norm_sequence(random);
  const auto norms = norms_of(maps, sequence, scale_norm_maps(maps, sequence, 0.5));
  ASSERT_TRUE(norms.has_value());
  const RowVector<double, 3> row(1.0, -2.0, 0.5);
  double most = 0.0;
  for (int trial = 0; trial < 20000; ++trial) {
    const Vector<double, 3> vector(random.normal(), random.normal(), random.normal());
    most = std::max(most,
                    std::abs(row.dot(vector)) / norms->size(0, vector.cast<Enclosure>()).upper());
  }
  EXPECT_LE(most, norms->reading(0, row));
  EXPECT_GE(most, 0.9 * norms->reading(0, row));
}

TEST(ContractingNorms, AreNotFoundWhereTheSequenceDoesNotContract) {
  test::Random random(43);
  for (int trial = 0; trial < 200; ++trial) {
    NormMaps maps = norm_maps(random);
    const auto sequence = norm_sequence(random);
    scale_norm_maps(maps, sequence, 1.000001);
    EXPECT_FALSE(norms_of(maps, sequence, std::log(1.000001)).has_value());
    EXPECT_FALSE(norms_of(maps, sequence, std::log(0.9)).has_value()) << "whatever is claimed";
  }
}

TEST(ContractingNorms, AreOfEveryMapInside) {
  using Corner = ContractingNorms<3>::Maps;
  const Matrix<Enclosure, 3> identity = Matrix<Enclosure, 3>::Identity();
  const double log_modulus = 2.0 * std::log(0.96);
  const auto found = [&](const std::vector<Corner>& corners) {
    return ContractingNorms<3>::of(corners, {0, 0}, log_modulus).has_value();
  };
  const auto maps = [&](const Enclosure& factor) { return Corner{identity * factor, identity}; };
  EXPECT_TRUE(found({maps(Enclosure(0.85, 0.95))}));
  EXPECT_FALSE(found({maps(Enclosure(0.8, 1.0))}));
  EXPECT_TRUE(found({maps(0.95), maps(-0.95)}));
  EXPECT_FALSE(found({maps(0.5), maps(1.0)}));
  EXPECT_FALSE(found({maps(1.0), maps(0.5)}));
}

/// What is proved at the corners holds between them.
TEST(ContractingNorms, HoldBetweenTheCorners) {
  test::Random random(44);
  int found = 0;
  for (int trial = 0; trial < 60; ++trial) {
    NormMaps first = norm_maps(random);
    const auto sequence = norm_sequence(random);
    const double log_modulus = scale_norm_maps(first, sequence, 0.7);
    NormMaps last = first;
    for (auto& map : last)
      for (double& entry : map.reshaped()) entry += 1e-3 * random.normal();
    const auto enclosed_maps = [](const NormMaps& maps) {
      return ContractingNorms<3>::Maps{maps[0].cast<Enclosure>(), maps[1].cast<Enclosure>()};
    };
    const auto norms =
        ContractingNorms<3>::of({enclosed_maps(first), enclosed_maps(last)}, sequence, log_modulus);
    if (!norms) continue;
    ++found;
    for (std::size_t j = 0; j < sequence.size(); ++j) {
      const std::size_t next = j + 1 == sequence.size() ? 0 : j + 1;
      const double share = random.unit();
      const Matrix<double, 3> map =
          (1.0 - share) * first.at(sequence[j]) + share * last.at(sequence[j]);
      const Vector<double, 3> vector(random.normal(), random.normal(), random.normal());
      const Vector<double, 3> image = map * vector;
      EXPECT_LE(norms->size(next, image.cast<Enclosure>()).lower(),
                norms->factor(j) * norms->size(j, vector.cast<Enclosure>()).upper());
    }
  }
  EXPECT_GT(found, 20);
}

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
