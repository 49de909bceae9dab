#include "holdfast/excitation/recorded_force.hpp"

#include "support/message_of.hpp"
#include "support/random.hpp"

namespace holdfast {
namespace {

constexpr double recorded_infinity = std::numeric_limits<double>::infinity();
constexpr double recorded_nan = std::numeric_limits<double>::quiet_NaN();

/// Rows at uneven times that are multiples of 2⁻¹⁰ s, so that sums and differences of them are
/// exact.
std::vector<double> uneven_times(test::Random& random, std::size_t rows) {
  std::vector<double> times{-0.5};
  while (times.size() < rows) {
    times.push_back(times.back() + static_cast<double>(1 + random.index(200)) / 1024.0);
  }
  return times;
}

RecordedForce random_record(test::Random& random, std::size_t rows,
                            RecordInterpolation interpolation) {
  std::vector<double> forces(rows);
  for (double& force : forces) force = random.uniform(-2.0, 2.0);
  return RecordedForce(uneven_times(random, rows), forces, interpolation);
}

TEST(RecordedForce, GoesThroughItsRows) {
  test::Random random(702);
  for (const auto interpolation : {RecordInterpolation::linear, RecordInterpolation::held}) {
    const auto record = random_record(random, 100, interpolation);
    EXPECT_EQ(record.interpolation(), interpolation);
    for (std::size_t row = 0; row + 1 < 100; ++row) {
      ASSERT_EQ(record.at(record.times()[row]), record.forces()[row]) << row;
    }
  }
}

TEST(RecordedForce, TheLinesMeetAtTheRows) {
  test::Random random(703);
  const auto record = random_record(random, 100, RecordInterpolation::linear);
  for (std::size_t row = 0; row + 1 < 100; ++row) {
    const double start = record.times()[row], end = record.times()[row + 1];
    const LinearPiece piece = record.piece(start);
    ASSERT_NEAR(piece.value + piece.slope * (end - start), record.forces()[row + 1], 2e-15) << row;
    const double middle = 0.5 * (start + end);
    const double mean = 0.5 * (record.forces()[row] + record.forces()[row + 1]);
    ASSERT_NEAR(record.at(middle), mean, 2e-15) << row;
  }
}

TEST(RecordedForce, AHeldRowActsUpToTheNextOne) {
  test::Random random(704);
  const auto record = random_record(random, 100, RecordInterpolation::held);
  for (std::size_t row = 0; row + 1 < 100; ++row) {
    const double end = record.times()[row + 1];
    const LinearPiece piece = record.piece(std::nextafter(end, -1.0));
    ASSERT_EQ(piece.value, record.forces()[row]);
    ASSERT_EQ(piece.slope, 0.0);
  }
}

TEST(RecordedForce, IsZeroOutside) {
  test::Random random(705);
  for (const auto interpolation : {RecordInterpolation::linear, RecordInterpolation::held}) {
    const auto record = random_record(random, 10, interpolation);
    const double before = std::nextafter(record.first_time(), -recorded_infinity);
    for (const double outside : {-1e300, -2.0, before, record.last_time(), 100.0, 1e300}) {
      EXPECT_EQ(record.at(outside), 0.0) << outside;
      EXPECT_EQ(record.piece(outside).slope, 0.0) << outside;
    }
    EXPECT_NE(record.at(record.first_time()), 0.0);
    EXPECT_NE(record.at(std::nextafter(record.last_time(), 0.0)), 0.0);
  }
}

TEST(RecordedForce, ItsBreaksAreItsRowsInOrder) {
  test::Random random(706);
  for (const auto interpolation : {RecordInterpolation::linear, RecordInterpolation::held}) {
    const auto record = random_record(random, 100, interpolation);
    std::vector<double> found;
    double time = -recorded_infinity;
    while ((time = record.next_break(time)) < recorded_infinity) found.push_back(time);
    EXPECT_EQ(found, record.times());
  }
}

TEST(RecordedForce, ItsNextBreakIsTheFirstRowAfterTheTime) {
  test::Random random(707);
  const auto record = random_record(random, 50, RecordInterpolation::linear);
  for (int trial = 0; trial < 2000; ++trial) {
    const double time = random.uniform(record.first_time() - 1.0, record.last_time() + 1.0);
    double first = recorded_infinity;
    for (const double row : record.times()) {
      if (row > time) first = std::min(first, row);
    }
    ASSERT_EQ(record.next_break(time), first) << time;
  }
}

TEST(RecordedForce, BetweenTwoBreaksOnePolynomialIsInForce) {
  test::Random random(708);
  for (const auto interpolation : {RecordInterpolation::linear, RecordInterpolation::held}) {
    const auto record = random_record(random, 50, interpolation);
    for (int trial = 0; trial < 2000; ++trial) {
      const double time = random.uniform(record.first_time() - 0.1, record.last_time());
      const double later = random.uniform(time, record.next_break(time));
      const LinearPiece piece = record.piece(time);
      ASSERT_NEAR(record.at(later), piece.value + piece.slope * (later - time), 1e-14) << time;
      ASSERT_EQ(record.piece(later).slope, piece.slope) << time;
    }
  }
}

std::string refused_record(const std::vector<double>& times, const std::vector<double>& forces,
                           RecordInterpolation interpolation = RecordInterpolation::linear) {
  return tests::refused_name([&] { RecordedForce(times, forces, interpolation); });
}

TEST(RecordedForce, TooFewRowsAreRefused) {
  EXPECT_EQ(refused_record({}, {}), "rows of the recorded force");
  EXPECT_EQ(refused_record({0.0}, {1.0}), "rows of the recorded force");
  EXPECT_EQ(refused_record({0.0, 1.0}, {1.0, 2.0}), "");
}

TEST(RecordedForce, UnequalNumbersOfTimesAndForcesAreRefused) {
  EXPECT_EQ(refused_record({0.0, 1.0, 2.0}, {1.0, 2.0}), "number of recorded forces");
  EXPECT_EQ(refused_record({0.0, 1.0}, {1.0, 2.0, 3.0}), "number of recorded forces");
}

TEST(RecordedForce, TimesThatDoNotIncreaseAreRefused) {
  EXPECT_EQ(refused_record({0.0, 1.0, 1.0}, {1.0, 2.0, 3.0}), "time of the recorded force");
  EXPECT_EQ(refused_record({0.0, 1.0, 0.5}, {1.0, 2.0, 3.0}), "time of the recorded force");
}

TEST(RecordedForce, WhatIsNotFiniteIsRefused) {
  for (const double wrong : {recorded_nan, recorded_infinity, -recorded_infinity}) {
    for (std::size_t row = 0; row < 3; ++row) {
      std::vector<double> times{0.0, 1.0, 2.0}, forces{1.0, 2.0, 3.0};
      times[row] = wrong;
      EXPECT_EQ(refused_record(times, forces), "time of the recorded force") << wrong;
      times = {0.0, 1.0, 2.0};
      forces[row] = wrong;
      EXPECT_EQ(refused_record(times, forces), "recorded force") << wrong;
    }
  }
}

TEST(RecordedForce, RowsWhoseDifferenceOverflowsAreRefused) {
  EXPECT_EQ(refused_record({-1.5e308, 1.5e308}, {1.0, 2.0}), "duration of the recorded force");
  EXPECT_EQ(refused_record({0.0, 1e-300}, {0.0, 1e300}), "slope of the recorded force");
  EXPECT_EQ(refused_record({0.0, 1e-300}, {0.0, 1e300}, RecordInterpolation::held), "");
}

}  // namespace
}  // namespace holdfast
