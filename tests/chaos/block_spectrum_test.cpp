#include "holdfast/chaos/block_spectrum.hpp"

#include "support/dense_routes.hpp"
#include "support/kollar_case.hpp"
#include "support/random.hpp"

namespace holdfast {
namespace {

using TangentMap = Matrix<double, 5>;
using PreciseSpectrum = LyapunovSpectrum<long double, 5>;

/// Two maps and the contacts that order them.
struct TangentSequence {
  TangentMap engaged;
  TangentMap backlash;
  std::vector<bool> itinerary;

  BlockSpectrum<double> spectrum(LyapunovScope scope = LyapunovScope::all) const {
    return BlockSpectrum<double>(std::make_shared<const ItineraryBlocks>(engaged, backlash), scope);
  }

  /// Pushes the contacts of [first, last). @return the incomplete block at the end
  ItineraryBlock push(BlockSpectrum<double>& into, std::size_t first, std::size_t last) const {
    ItineraryBlock open = empty_block;
    for (std::size_t k = first; k < last; ++k) {
      open = followed_by(open, itinerary[k]);
      if (!is_whole(open)) continue;
      into.push(open);
      open = empty_block;
    }
    return open;
  }

  /// QR at every sample, in extended precision.
  PreciseSpectrum precise(std::size_t last) const {
    const int engaged_rank = LyapunovSpectrum<double, 5>::rank_of(engaged);
    const int backlash_rank = LyapunovSpectrum<double, 5>::rank_of(backlash);
    const Matrix<long double, 5> s = engaged.cast<long double>(),
                                 s_star = backlash.cast<long double>();
    PreciseSpectrum result;
    for (std::size_t k = 0; k < last; ++k)
      result.push(itinerary[k] ? s : s_star, itinerary[k] ? engaged_rank : backlash_rank);
    return result;
  }
};

void expect_same_exponents(const Vector<double, 5>& found, const Vector<double, 5>& expected,
                           double tolerance) {
  for (int i = 0; i < 5; ++i) {
    if (std::isfinite(expected[i])) {
      EXPECT_NEAR(found[i], expected[i], tolerance) << "exponent " << i;
    } else {
      EXPECT_EQ(found[i], expected[i]) << "exponent " << i;
    }
  }
}

void expect_every_step_qr(const TangentSequence& sequence, double tolerance = 1e-10) {
  auto spectrum = sequence.spectrum();
  const std::size_t samples = sequence.itinerary.size();
  const auto open = sequence.push(spectrum, 0, samples);
  expect_same_exponents(spectrum.spectrum(open).exponents(),
                        sequence.precise(samples).exponents().cast<double>(), tolerance);
}

TangentSequence tangents_along(const test::KollarCase& which, const SampledLoop<double>& tangent,
                               std::int64_t samples) {
  TangentSequence result{tangent.engaged_map(which.gains), tangent.backlash_map(), {}};
  auto motion = which.motion();
  run_trajectory(motion, samples, std::nullopt, [&](const MotionSample<double>& sample) {
    result.itinerary.push_back(sample.engaged);
  });
  return result;
}

test::KollarCase wide_gap(double period, double delay) {
  test::KollarCase which;
  which.sampling_period = period;
  which.processing_delay = delay;
  which.width = 0.002;
  return which;
}

/// Random maps of about unit size; 0 full, 1 with the backlash's zero row, 2 without delay as well,
/// 3 of rank three.
TangentSequence random_tangents(test::Random& random, int kind, std::size_t samples) {
  TangentSequence result{random.matrix<TangentMap>(), random.matrix<TangentMap>(), {}};
  if (kind >= 1) result.backlash.row(4).setZero();
  if (kind == 2) result.backlash.col(4).setZero();
  if (kind == 2) result.engaged.col(4).setZero();
  if (kind == 3) result.backlash.row(2) = result.backlash.row(1);
  const double share = random.unit();
  for (std::size_t k = 0; k < samples; ++k) result.itinerary.push_back(random.unit() < share);
  return result;
}

TEST(ItineraryBlock, IsItsSamplesOneAfterTheOther) {
  const std::vector<bool> engaged{true, false, false, true, true, false};
  ItineraryBlock block = 1;
  for (const bool sample : engaged) {
    EXPECT_FALSE(is_whole(block));
    block = followed_by(block, sample);
  }
  EXPECT_TRUE(is_whole(block));
  EXPECT_EQ(samples_of(block), 6);
  for (int k = 0; k < 6; ++k)
    EXPECT_EQ(sample_of(block, k), followed_by(1, engaged[static_cast<std::size_t>(k)]));
}

TEST(ItineraryBlocks, MapsAreTheProductsOfTheSamplesMapsInBalancedCoordinates) {
  test::Random random(501);
  const TangentSequence maps = random_tangents(random, 1, 0);
  const ItineraryBlocks blocks(maps.engaged, maps.backlash);
  for (unsigned block = 1; block < 128; ++block) {
    const auto code = static_cast<ItineraryBlock>(block);
    TangentMap product = TangentMap::Identity();
    int rank = 5;
    for (int k = samples_of(code) - 1; k >= 0; --k) {
      const bool engaged = ((block >> k) & 1U) != 0;
      product = (engaged ? maps.engaged : maps.backlash) * product;
      if (!engaged) rank = 4;
    }
    const TangentMap found =
        blocks.scale().asDiagonal() * blocks.map(code) * blocks.scale().cwiseInverse().asDiagonal();
    EXPECT_LE((found - product).norm(), 1e-13 * product.norm()) << block;
    EXPECT_EQ(blocks.rank(code), rank);
  }
  EXPECT_EQ(blocks.reach(), 5);
  EXPECT_EQ(ItineraryBlocks(wide_gap(0.01, 0.0).loop(), {-557.0, -13.0}).reach(), 4);
}

TEST(Orthonormalise, FactorsTheColumns) {
  test::Random random(502);
  for (int draw = 0; draw < 200; ++draw) {
    const auto columns = random.matrix<Matrix<double, 5, 4>>();
    TangentBasis<double, 4> basis = columns;
    Alive alive{true, true, true, true, true};
    const auto stretches = orthonormalise<double, 4>(basis, alive);
    const Matrix<double, 4> r = basis.transpose() * columns;
    EXPECT_LE((basis.transpose() * basis - Matrix<double, 4>::Identity()).norm(), 1e-12);
    EXPECT_LE((basis * r - columns).norm(), 1e-12);
    EXPECT_LE(r.triangularView<Eigen::StrictlyLower>().toDenseMatrix().norm(), 1e-12);
    EXPECT_LE((stretches.squares.cwiseSqrt() - r.diagonal()).norm(), 1e-12);
    EXPECT_NEAR(stretches.inverse / r.inverse().squaredNorm(), 1.0, 1e-9);
  }
}

TEST(Orthonormalise, LeavesOutWhatIsNotAliveAndMarksWhatVanishes) {
  test::Random random(503);
  TangentBasis<double, 4> basis = random.matrix<Matrix<double, 5, 4>>();
  basis.col(2).setZero();
  Alive alive{true, true, true, true, true};
  auto stretches = orthonormalise<double, 4>(basis, alive);
  EXPECT_TRUE(alive[0] && alive[1]);
  EXPECT_FALSE(alive[2] || alive[3]);
  EXPECT_EQ(stretches.squares[2], 0.0);
  EXPECT_EQ(basis.col(3).norm(), 0.0);
  stretches = orthonormalise<double, 4>(basis, alive);
  EXPECT_EQ(stretches.squares[2], 1.0);
  EXPECT_NEAR(stretches.inverse, 2.0, 1e-12);
}

TEST(BlockSpectrum, IsThatOfQrAtEverySampleOnThePapersMotions) {
  for (const double period : {0.001, 0.011}) {
    for (const double fraction : {0.0, 0.5, 1.0}) {
      const auto which = wide_gap(period, 0.0);
      const auto tangent = wide_gap(period, fraction * period).loop();
      for (const std::int64_t samples : {1, 2, 5, 6, 7, 36, 37, 101, 1000, 9999}) {
        SCOPED_TRACE(samples);
        expect_every_step_qr(tangents_along(which, tangent, samples));
      }
    }
  }
}

TEST(BlockSpectrum, IsThatOfQrAtEverySampleForRandomMaps) {
  test::Random random(504);
  for (int draw = 0; draw < 400; ++draw) {
    SCOPED_TRACE(draw);
    const std::size_t samples = 1 + random.index(draw % 40 == 0 ? 5000 : 300);
    expect_every_step_qr(random_tangents(random, draw % 4, samples));
  }
}

TEST(BlockSpectrum, NeitherOverflowsNorUnderflows) {
  test::Random random(505);
  for (const double size : {1e-4, 1e4}) {
    TangentSequence sequence = random_tangents(random, 1, 3000);
    sequence.engaged *= size;
    sequence.backlash *= size;
    expect_every_step_qr(sequence);
  }
}

TEST(BlockSpectrum, DoesABlockAgainThatTurnsOutTooLong) {
  test::Random random(506);
  const TangentMap turn = test::orthogonal_factor_of(random.matrix<TangentMap>());
  // Long blocks while the maps only turn, then each sample contracts by up to a thousand.
  const Vector<double, 5> contraction(1.0, 0.3, 0.1, 0.03, 0.001);
  TangentSequence sequence{turn, turn * contraction.asDiagonal(), {}};
  for (int k = 0; k < 6000; ++k) sequence.itinerary.push_back(k % 2000 < 1900);
  expect_every_step_qr(sequence);
}

TEST(BlockSpectrum, SplitsAWordWhoseSamplesAreHardlyRegular) {
  test::Random random(507);
  const TangentMap turn = test::orthogonal_factor_of(random.matrix<TangentMap>());
  const Vector<double, 5> contraction(1.0, 0.1, 1e-2, 1e-4, 1e-5);
  TangentSequence sequence{contraction.asDiagonal() * turn, turn, {}};
  for (int k = 0; k < 300; ++k) sequence.itinerary.push_back(random.unit() < 0.8);
  expect_every_step_qr(sequence);
}

TEST(BlockSpectrum, AVanishingColumnIsMinusInfinity) {
  // Rank 2 as a product of maps of rank 4 and 3, which no rank of a single map tells.
  TangentMap first = TangentMap::Identity(), second = TangentMap::Identity();
  first.diagonal() << 1, 1, 1, 1, 0;
  second.diagonal() << 1, 1, 0, 0, 1;
  TangentSequence sequence{first, second, {true, false, true, true, false, false, true}};
  auto spectrum = sequence.spectrum();
  const auto open = sequence.push(spectrum, 0, 7);
  const Vector<double, 5> exponents = spectrum.spectrum(open).exponents();
  EXPECT_EQ(exponents[0], 0.0);
  EXPECT_EQ(exponents[1], 0.0);
  for (int i = 2; i < 5; ++i) EXPECT_EQ(exponents[i], -std::numeric_limits<double>::infinity());
}

TEST(BlockSpectrum, AfterARestartItCountsOnlyWhatFollows) {
  for (const double delay : {0.0, 0.011}) {
    const auto sequence = tangents_along(wide_gap(0.011, 0.0), wide_gap(0.011, delay).loop(), 3007);
    for (const std::size_t discarded : {1U, 6U, 250U, 1003U}) {
      auto spectrum = sequence.spectrum();
      spectrum.restart(sequence.push(spectrum, 0, discarded));
      const auto open = sequence.push(spectrum, discarded, 3007);
      const Vector<long double, 5> before = sequence.precise(discarded).exponents();
      const Vector<long double, 5> all = sequence.precise(3007).exponents();
      const double whole = 3007, left_out = static_cast<double>(discarded);
      EXPECT_EQ(spectrum.spectrum(open).steps(), 3007 - static_cast<std::int64_t>(discarded));
      for (int i = 0; i < 4; ++i) {
        const auto expected = (whole * all[i] - left_out * before[i]) / (whole - left_out);
        EXPECT_NEAR(spectrum.spectrum(open).exponents()[i], static_cast<double>(expected), 1e-10);
      }
    }
  }
}

TEST(BlockSpectrum, TheLargestAloneIsTheFirstOfAll) {
  test::Random random(508);
  for (int draw = 0; draw < 40; ++draw) {
    const auto sequence = random_tangents(random, draw % 4, 1 + random.index(3000));
    auto all = sequence.spectrum(), largest = sequence.spectrum(LyapunovScope::largest);
    const auto open = sequence.push(all, 0, sequence.itinerary.size());
    sequence.push(largest, 0, sequence.itinerary.size());
    EXPECT_NEAR(largest.spectrum(open).exponents()[0], all.spectrum(open).exponents()[0], 1e-10);
  }
}

}  // namespace
}  // namespace holdfast
