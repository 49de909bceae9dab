#include "holdfast/excitation/multi_harmonic_force.hpp"

#include "holdfast/excitation/band_limited_noise.hpp"
#include "support/random.hpp"
#include "support/reference/sample_excitation.hpp"

namespace holdfast {
namespace {

/// A multiple of 2⁻¹⁶ in [lower, upper): sums of such times and lengths are exact.
double dyadic(test::Random& random, double lower, double upper) {
  return std::floor(random.uniform(lower, upper) * 65536.0) / 65536.0;
}

std::vector<Harmonic> three_harmonics(test::Random& random) {
  std::vector<Harmonic> harmonics(3);
  for (Harmonic& harmonic : harmonics) {
    harmonic = {random.uniform(0.0, 2.0), random.log_uniform(0.5, 50.0), random.uniform(-7, 7)};
  }
  return harmonics;
}

std::shared_ptr<const RecordedForce> rough_record(test::Random& random,
                                                  RecordInterpolation interpolation) {
  std::vector<double> times{-0.25}, forces{random.uniform(-1, 1)};
  while (times.size() < 60) {
    times.push_back(times.back() + dyadic(random, 0.001, 0.1));
    forces.push_back(random.uniform(-1, 1));
  }
  return std::make_shared<const RecordedForce>(times, forces, interpolation);
}

/// Σ F_i, and the largest force of the record.
double size_of(const MultiHarmonicForce& force) {
  double size = 0.0;
  if (force.record) {
    for (const double row : force.record->forces()) size = std::max(size, std::abs(row));
  }
  for (const Harmonic& harmonic : force.harmonics) size += harmonic.amplitude;
  return size;
}

/// Σ f_k xᵏ.
double series_at(const Eigen::VectorXd& coefficients, double x) {
  double sum = 0.0;
  for (Eigen::Index k = coefficients.size(); k-- > 0;) sum = sum * x + coefficients[k];
  return sum;
}

/// The largest error of the series against `at` within one piece, over the size of the force.
double worst_of_series(test::Random& random, const MultiHarmonicForce& force, double latest) {
  double worst = 0.0;
  Eigen::VectorXd coefficients(22);
  for (int trial = 0; trial < 3000; ++trial) {
    const double time = dyadic(random, -1.0, latest);
    // A piece of at most one radian of the fastest harmonic: 1/22! is far below round-off.
    const double longest = std::min(1.0 / 320.0, force.next_break(time) - time);
    const double length = std::ldexp(1.0, static_cast<int>(std::floor(std::log2(longest))));
    force.expand(time, length, coefficients);
    const double x = std::floor(random.unit() * 64.0) / 64.0;
    const double error = series_at(coefficients, x) - force.at(time + x * length);
    worst = std::max(worst, std::abs(error) / size_of(force));
  }
  return worst;
}

TEST(MultiHarmonicForce, ItsSeriesIsTheForceWithinAPiece) {
  test::Random random(711);
  for (const auto interpolation : {RecordInterpolation::linear, RecordInterpolation::held}) {
    const MultiHarmonicForce force{three_harmonics(random), rough_record(random, interpolation)};
    EXPECT_LT(worst_of_series(random, force, 4.0), 1e-14);
  }
  const MultiHarmonicForce record_alone{{}, rough_record(random, RecordInterpolation::linear)};
  EXPECT_LT(worst_of_series(random, record_alone, 4.0), 1e-14);
  const MultiHarmonicForce noise{band_limited_noise({0.5, 1.0, 50.0, 200, 4}), nullptr};
  EXPECT_LT(worst_of_series(random, noise, 100.0), 1e-14);
  const MultiHarmonicForce harmonic = multi_harmonic_force({0.5, 10.0});
  EXPECT_LT(worst_of_series(random, harmonic, 1e6), 1e-14);
}

TEST(MultiHarmonicForce, ABreakBelongsToThePieceAfterIt) {
  test::Random random(713);
  const MultiHarmonicForce force{three_harmonics(random),
                                 rough_record(random, RecordInterpolation::held)};
  for (std::size_t row = 1; row + 1 < 60; ++row) {
    const double time = force.record->times()[row];
    Vector<double, 6> before, at, after;
    force.expand(std::nextafter(time, -10.0), 0.001, before);
    force.expand(time, 0.001, at);
    force.expand(std::nextafter(time, 10.0), 0.001, after);
    const double jump = force.record->forces()[row] - force.record->forces()[row - 1];
    EXPECT_NEAR(at[0] - before[0], jump, 1e-12) << row;
    EXPECT_NEAR(after[0] - at[0], 0.0, 1e-12) << row;
  }
}

TEST(MultiHarmonicForce, ItsPartsAddUp) {
  test::Random random(714);
  const MultiHarmonicForce all{three_harmonics(random),
                               rough_record(random, RecordInterpolation::linear)};
  std::vector<MultiHarmonicForce> parts{{{}, all.record}};
  for (const Harmonic& harmonic : all.harmonics) parts.push_back({{harmonic}, nullptr});
  for (int trial = 0; trial < 500; ++trial) {
    const double time = random.uniform(-1.0, 4.0);
    Vector<double, 8> together, sum = Vector<double, 8>::Zero(), part_coefficients;
    all.expand(time, 0.002, together);
    double force = 0.0;
    for (const MultiHarmonicForce& part : parts) {
      part.expand(time, 0.002, part_coefficients);
      sum += part_coefficients;
      force += part.at(time);
    }
    ASSERT_LT((together - sum).cwiseAbs().maxCoeff(), 1e-14 * size_of(all));
    ASSERT_NEAR(all.at(time), force, 1e-14 * size_of(all));
  }
}

TEST(MultiHarmonicForce, ASeriesOfAnySizeStartsTheSame) {
  test::Random random(715);
  const MultiHarmonicForce force{three_harmonics(random),
                                 rough_record(random, RecordInterpolation::linear)};
  Vector<double, 12> longest;
  force.expand(0.7, 0.003, longest);
  for (Eigen::Index size = 0; size <= 12; ++size) {
    Eigen::VectorXd column = Eigen::VectorXd::Constant(size, 99.0);
    Eigen::RowVectorXd row = Eigen::RowVectorXd::Constant(size, -99.0);
    force.expand(0.7, 0.003, column);
    force.expand(0.7, 0.003, row);
    for (Eigen::Index k = 0; k < size; ++k) {
      EXPECT_NEAR(column[k], longest[k], 1e-15 * size_of(force)) << size;
      EXPECT_NEAR(row[k], longest[k], 1e-15 * size_of(force)) << size;
    }
  }
  force.expand(0.7, 0.0, longest);  // without length only the force is left
  EXPECT_NEAR(longest[0], force.at(0.7), 1e-15 * size_of(force));
  EXPECT_EQ(longest.tail(11).cwiseAbs().maxCoeff(), 0.0);
}

TEST(MultiHarmonicForce, WithoutPartsItIsZeroForEver) {
  const MultiHarmonicForce none;
  Vector<double, 4> coefficients = Vector<double, 4>::Constant(9.0);
  none.expand(3.0, 0.1, coefficients);
  EXPECT_EQ(coefficients, (Vector<double, 4>::Zero()));
  EXPECT_EQ(none.at(3.0), 0.0);
  EXPECT_EQ(none.next_break(3.0), std::numeric_limits<double>::infinity());
  EXPECT_EQ(none.highest_angular_frequency(), 0.0);
  EXPECT_NO_THROW(validate(none));
}

TEST(MultiHarmonicForce, KnowsItsFastestHarmonic) {
  const MultiHarmonicForce force{{{1.0, 2.0}, {0.1, 30.0}, {5.0, 0.5}}, nullptr};
  EXPECT_DOUBLE_EQ(force.highest_angular_frequency(), 60.0 * std::acos(-1.0));
}

TEST(MultiHarmonicForce, OneHarmonicIsTheExcitationAtItsSamples) {
  const HarmonicExcitation<double> excitation{0.5, 10.0};
  const MultiHarmonicForce force = multi_harmonic_force(excitation);
  for (int j = 0; j < 2000; ++j) {
    EXPECT_NEAR(force.at(0.003 * j), sample_excitation(excitation, 0.003, j).cosine, 1e-12) << j;
  }
}

/// The part of f t beyond whole cycles: exact for each binary digit of t, then summed.
double cycles_by_digits(double frequency, std::uint64_t time) {
  double cycles = 0.0;
  for (int digit = 0; digit < 52; ++digit) {
    if (((time >> digit) & 1U) == 0) continue;
    cycles = std::fmod(cycles + std::fmod(std::ldexp(frequency, digit), 1.0), 1.0);
  }
  return cycles;
}

TEST(MultiHarmonicForce, KeepsItsPhaseHoweverLate) {
  test::Random random(717);
  for (int trial = 0; trial < 2000; ++trial) {
    const Harmonic harmonic{1.0, random.log_uniform(0.1, 50.0), random.uniform(0.0, 6.0)};
    const auto time = static_cast<std::uint64_t>(random.log_uniform(1.0, 0x1.0p50));
    const double angle = 2.0 * pi<double> * cycles_by_digits(harmonic.frequency, time);
    const MultiHarmonicForce force{{harmonic}, nullptr};
    const double late = static_cast<double>(time);
    ASSERT_NEAR(force.at(late), std::cos(angle + harmonic.phase), 1e-13) << late;
    ASSERT_NEAR(harmonic.at(-late), std::cos(-angle + harmonic.phase), 1e-13) << late;
  }
}

TEST(MultiHarmonicForce, AHarmonicOutOfRangeIsRefused) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
  const auto with = [](const Harmonic& second) {
    return MultiHarmonicForce{{Harmonic{1.0, 2.0}, second}, nullptr};
  };
  EXPECT_NO_THROW(validate(with({0.0, 10.0, -3.0})));
  for (const double wrong : {-0.1, infinity, not_a_number}) {
    EXPECT_THROW(validate(with({wrong, 10.0})), InvalidParameter) << wrong;
  }
  for (const double wrong : {0.0, -1.0, infinity, not_a_number}) {
    EXPECT_THROW(validate(with({1.0, wrong})), InvalidParameter) << wrong;
  }
  for (const double wrong : {infinity, -infinity, not_a_number}) {
    EXPECT_THROW(validate(with({1.0, 10.0, wrong})), InvalidParameter) << wrong;
  }
}

}  // namespace
}  // namespace holdfast
