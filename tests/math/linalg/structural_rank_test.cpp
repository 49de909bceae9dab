#include "holdfast/math/linalg/structural_rank.hpp"

#include "holdfast/contact/contact_mode.hpp"
#include "holdfast/core/types.hpp"
#include "support/dense_routes.hpp"
#include "support/random.hpp"

namespace holdfast {
namespace {

constexpr unsigned carried_in_force = static_cast<unsigned>(Carried::in_force);
constexpr unsigned carried_anchor = static_cast<unsigned>(Carried::anchor);
constexpr unsigned carried_reading = static_cast<unsigned>(Carried::reading);

/// A sample of an engaged drive whose command waits for a delay or does not.
void take_engaged_sample(StructuralRank& rank, bool delayed) {
  rank.pass(4);
  rank.begin(Carried::pending);
  if (delayed) rank.act(Carried::in_force);
  rank.pass(4);
  rank.end(Carried::in_force);
  rank.become(Carried::pending, Carried::in_force);
  rank.act(Carried::in_force);
  rank.pass(4);
}

TEST(StructuralRank, WithoutDelayTheCommandBeforeIsForgotten) {
  StructuralRank prompt(carried_in_force), late(carried_in_force);
  for (int sample = 0; sample < 3; ++sample) {
    take_engaged_sample(prompt, false);
    take_engaged_sample(late, true);
    EXPECT_EQ(prompt.rank(), 4);
    EXPECT_EQ(late.rank(), 5);
  }
}

TEST(StructuralRank, AStickPhaseCostsOneUnlessACommandComesPastIt) {
  for (const bool acts_later : {false, true}) {
    StructuralRank rank(0);
    rank.pass(4);
    rank.begin(Carried::pending);
    rank.pass(3);
    rank.become(Carried::pending, Carried::in_force);
    EXPECT_EQ(rank.rank(), 4);  // as long as the command may yet act
    if (acts_later) rank.act(Carried::in_force);
    rank.pass(4);
    rank.end(Carried::in_force);
    EXPECT_EQ(rank.rank(), acts_later ? 4 : 3);
  }
}

TEST(StructuralRank, WhatNeverActsIsLost) {
  StructuralRank rank(carried_in_force | carried_anchor | carried_reading);
  rank.pass(4);
  EXPECT_EQ(rank.rank(), 7);
  rank.end(Carried::anchor);
  EXPECT_EQ(rank.rank(), 6);
  rank.end(Carried::in_force);
  EXPECT_EQ(rank.rank(), 5);
  rank.become(Carried::reading, Carried::pending);
  EXPECT_EQ(rank.rank(), 5);
  rank.end(Carried::pending);
  EXPECT_EQ(rank.rank(), 4);
}

/// Loops whose matrices are random but for their zeros: rows z, command in force, command pending,
/// place of the gap, reading.
class LoopOfRandomEntries {
 public:
  LoopOfRandomEntries(test::Random& random, unsigned carried)
      : random_(random),
        rank_(carried),
        rows_(Matrix<double, 8, 7>::Zero()),
        mode_((carried & carried_anchor) != 0 ? ContactMode::gap : ContactMode::engaged) {
    rows_.topLeftCorner<4, 4>().setIdentity();
    if ((carried & carried_in_force) != 0) rows_(4, 4) = 1.0;
    if ((carried & carried_anchor) != 0) rows_(6, 5) = 1.0;
    if ((carried & carried_reading) != 0) rows_(7, 6) = 1.0;
  }

  void sample(bool looks_at_state, bool looks_at_reading, bool reads) {
    rank_.pass(directions_);
    RowVector<double, 7> command = RowVector<double, 7>::Zero();
    if (looks_at_state) {
      command += row() * rows_.topRows<4>();
      rank_.begin(Carried::pending);
    }
    if (looks_at_reading) {
      command += random_.uniform(0.5, 1.0) * rows_.row(7);
      rank_.become(Carried::reading, Carried::pending);
    }
    rank_.end(Carried::reading);
    rows_.row(7).setZero();
    if (reads) {
      rows_.row(7) = row() * rows_.topRows<4>();
      rank_.begin(Carried::reading);
    }
    rows_.row(5) = command;
    rank_.pass(directions_);
  }

  void command() {
    rows_.row(4) = rows_.row(5);
    rows_.row(5).setZero();
    rank_.end(Carried::in_force);
    rank_.become(Carried::pending, Carried::in_force);
  }

  /// Leaves the present mode for one that may follow it, and stays there for some time.
  void change_contact() {
    switch (mode_) {
      case ContactMode::engaged:
        return random_.unit() < 0.5 ? stick() : cross_gap(true);
      case ContactMode::stick:
        return random_.unit() < 0.5 ? engage() : cross_gap(false);
      case ContactMode::gap:
        return engage();
    }
  }

  int structural_rank() const { return rank_.rank(); }

  int numerical_rank() const {
    const Eigen::VectorXd stretches = test::singular_values_of(rows_);
    return static_cast<int>((stretches.array() > 1e-9 * stretches[0]).count());
  }

 private:
  /// The gap is left at a place that depends on where it lies, which is forgotten then.
  void engage() {
    if (mode_ == ContactMode::gap) {
      mix();
      rows_.topRows<4>() += random_.matrix<Vector<double, 4>>() * rows_.row(6);
      rank_.act(Carried::anchor);
    }
    rows_.row(6).setZero();
    rank_.end(Carried::anchor);
    mode_ = ContactMode::engaged;
    directions_ = 4;
    mix();
    rows_.topRows<4>() += random_.matrix<Vector<double, 4>>() * rows_.row(4);
    rank_.act(Carried::in_force);
    rank_.pass(directions_);
    mix();
  }

  void cross_gap(bool reverses) {
    if (reverses) rows_.row(6) = row() * rows_.topRows<4>();
    mode_ = ContactMode::gap;
    directions_ = 4;
    mix();
    rank_.pass(directions_);
  }

  void stick() {
    const Vector<double, 4> lost = random_.matrix<Vector<double, 4>>().normalized();
    rows_.topRows<4>() -= lost * (lost.transpose() * rows_.topRows<4>()).eval();
    rows_.row(6) = row() * rows_.topRows<4>();
    mode_ = ContactMode::stick;
    directions_ = 3;
    rank_.pass(directions_);
  }

  RowVector<double, 4> row() { return random_.matrix<RowVector<double, 4>>(); }

  void mix() {
    const Matrix<double, 4> rotation =
        test::orthogonal_factor_of(random_.matrix<Matrix<double, 4>>());
    rows_.topRows<4>() = (rotation * rows_.topRows<4>()).eval();
  }

  test::Random& random_;
  StructuralRank rank_;
  Matrix<double, 8, 7> rows_;
  ContactMode mode_;
  int directions_ = 4;
};

TEST(StructuralRank, IsTheRankOfProductsOfRandomMapsWithTheSameZeros) {
  test::Random random(821);
  std::array<int, 8> seen{};
  for (int trial = 0; trial < 3000; ++trial) {
    const auto inputs = static_cast<unsigned>(random.index(16)) & ~2U;
    const bool delayed = random.unit() < 0.5, differs = random.unit() < 0.5;
    const bool looks = random.unit() < 0.8;
    LoopOfRandomEntries loop(random, inputs);
    const auto samples = 1 + random.index(4);
    for (std::size_t sample = 0; sample < samples; ++sample) {
      loop.sample(looks, looks && differs, differs);
      for (int part = 0; part < 2; ++part) {
        const bool passes = part == 1 || delayed;
        for (std::size_t changes = passes ? random.index(4) : 0; changes > 0; --changes)
          loop.change_contact();
        if (part == 0) loop.command();
      }
    }
    ASSERT_EQ(loop.structural_rank(), loop.numerical_rank()) << "trial " << trial;
    ++seen[static_cast<std::size_t>(loop.structural_rank())];
  }
  for (const std::size_t rank : {3U, 4U, 5U, 6U}) EXPECT_GT(seen[rank], 20) << rank;
}

}  // namespace
}  // namespace holdfast
