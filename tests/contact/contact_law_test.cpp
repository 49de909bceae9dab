#include "holdfast/contact/contact_law.hpp"

#include "support/kollar_case.hpp"
#include "support/random.hpp"

namespace holdfast {
namespace {

struct ContactSample {
  double displacement, velocity;
};

/// The rules once more, slowly and with one branch at a time.
class SlowContact {
 public:
  SlowContact(ContactLaw law, double width) : law_(law), width_(width) {}

  bool step(double displacement, double velocity) {
    const bool transmits = decide(displacement, velocity);
    before_ = velocity;
    began_ = true;
    return transmits || width_ == 0.0;
  }

 private:
  bool decide(double displacement, double velocity) {
    switch (law_) {
      case ContactLaw::kollar:
      case ContactLaw::immediate:
        return reversal_rule(displacement, velocity);
      case ContactLaw::play:
        return drag(displacement, velocity);
      case ContactLaw::dead_zone:
        return displacement > width_ / 2.0 || -displacement > width_ / 2.0;
      case ContactLaw::none:
        break;
    }
    return true;
  }

  bool reversal_rule(double displacement, double velocity) {
    if (inside_) {
      if (displacement >= lower_ && displacement <= upper_) return false;
      inside_ = false;
      if (law_ == ContactLaw::kollar) return true;
    }
    const bool reverses = (before_ > 0.0 && velocity <= 0.0) || (before_ < 0.0 && velocity >= 0.0);
    if (!began_ || !reverses) return true;
    inside_ = true;
    lower_ = before_ > 0.0 ? displacement - width_ : displacement;
    upper_ = before_ > 0.0 ? displacement : displacement + width_;
    return false;
  }

  /// The gap as an interval that the displacement takes along at the end that it passes.
  bool drag(double displacement, double velocity) {
    if (!placed_) {
      placed_ = velocity != 0.0;
      lower_ = velocity > 0.0 ? displacement - width_ : displacement;
      upper_ = lower_ + width_;
      return true;
    }
    if (displacement >= lower_ && displacement <= upper_) return false;
    lower_ = displacement > upper_ ? displacement - width_ : displacement;
    upper_ = lower_ + width_;
    return true;
  }

  ContactLaw law_;
  double width_, lower_ = 0.0, upper_ = 0.0, before_ = 0.0;
  bool inside_ = false, began_ = false, placed_ = false;
};

constexpr std::array<ContactLaw, 5> every_law = {ContactLaw::kollar, ContactLaw::immediate,
                                                 ContactLaw::play, ContactLaw::dead_zone,
                                                 ContactLaw::none};

/// A wandering motion in steps of 1/8, with many ties, rests and velocities of zero.
ContactSample next_of_lattice(test::Random& random, const ContactSample& before) {
  const double step = static_cast<double>(random.index(7)) - 3.0;
  const bool follows = random.unit() < 0.7;
  const double velocity = follows ? step : static_cast<double>(random.index(3)) - 1.0;
  return {std::clamp(before.displacement + step / 8.0, -1.0, 1.0), velocity};
}

TEST(SampledContact, DecidesAsTheRulesWrittenOutOneBranchAtATime) {
  test::Random random(731);
  std::array<int, every_law.size()> idle{};
  for (int sequence = 0; sequence < 100000; ++sequence) {
    const double width = 0.125 * static_cast<double>(random.index(6));
    std::vector<ContactSample> samples{{0.125 * static_cast<double>(random.index(9)) - 0.5, 0.0}};
    for (int j = 0; j < 20; ++j) samples.push_back(next_of_lattice(random, samples.back()));
    for (std::size_t k = 0; k < every_law.size(); ++k) {
      SampledContact contact({every_law[k], width});
      SlowContact slow(every_law[k], width);
      for (const auto& sample : samples) {
        const bool transmits = contact.step(sample.displacement, sample.velocity);
        ASSERT_EQ(transmits, slow.step(sample.displacement, sample.velocity))
            << "law " << k << ", sequence " << sequence;
        ASSERT_EQ(contact.inside(), !transmits);
        idle[k] += transmits ? 0 : 1;
      }
    }
  }
  for (std::size_t k = 0; k + 1 < idle.size(); ++k) EXPECT_GT(idle[k], 100000) << "law " << k;
  EXPECT_EQ(idle.back(), 0);
}

TEST(SampledContact, DecidesAsTheClassOfItsLaw) {
  test::Random random(732);
  const double width = 0.3;
  Backlash<double> kollar(width);
  ImmediateBacklash<double> immediate(width);
  PlayBacklash<double> play(width);
  DeadZone<double> zone(width);
  std::vector<SampledContact> contacts;
  for (const ContactLaw law : every_law)
    contacts.emplace_back(BacklashParameters{law, width, 100.0, 1.0});
  for (int sample = 0; sample < 20000; ++sample) {
    const double displacement = random.uniform(-0.4, 0.4), velocity = random.uniform(-1, 1);
    const std::array<bool, 5> expected = {
        kollar.step(displacement, velocity), immediate.step(displacement, velocity),
        play.step(displacement, velocity), zone.step(displacement, velocity), true};
    for (std::size_t k = 0; k < contacts.size(); ++k)
      ASSERT_EQ(contacts[k].step(displacement, velocity), expected[k]) << k;
    ASSERT_EQ(contacts[3].side(), zone.side(displacement));
    for (const std::size_t k : {0U, 1U, 2U, 4U}) ASSERT_EQ(contacts[k].side(), 0) << k;
  }
}

TEST(SampledContact, FromRestEveryLawButTheDeadZoneTransmitsAtTheFirstSample) {
  for (const ContactLaw law : every_law) {
    SampledContact contact({law, 0.002});
    EXPECT_FALSE(contact.inside()) << "before the first sample";
    EXPECT_EQ(contact.side(), 0);
    EXPECT_EQ(contact.step(0.0, 0.0), law != ContactLaw::dead_zone);
  }
}

TEST(SampledContact, WithoutWidthEveryLawAlwaysTransmits) {
  test::Random random(733);
  for (const ContactLaw law : every_law) {
    SampledContact contact({law, 0.0});
    ContactSample sample{0.0, 0.0};
    for (int j = 0; j < 2000; ++j) {
      ASSERT_TRUE(contact.step(sample.displacement, sample.velocity)) << static_cast<int>(law);
      sample = next_of_lattice(random, sample);
    }
  }
}

TEST(ImmediateBacklash, FromTheSameMemoryDiffersWhereALeavingSampleReversesAndNowhereElse) {
  test::Random random(734);
  ImmediateBacklash<double> law(0.25);
  ContactSample sample{0.0, 0.0};
  int differing = 0, leaving = 0;
  for (int j = 0; j < 100000; ++j) {
    const double before = sample.velocity;
    sample = next_of_lattice(random, sample);
    const auto memory = law.memory();
    Backlash<double> paper(law.width(), memory);
    const bool transmits = law.step(sample.displacement, sample.velocity);
    const bool transmits_in_paper = paper.step(sample.displacement, sample.velocity);
    const bool leaves =
        memory.inside && (sample.displacement < memory.lower || sample.displacement > memory.upper);
    const bool reverses = before != 0.0 && before * sample.velocity <= 0.0;
    ASSERT_EQ(transmits != transmits_in_paper, leaves && reverses) << j;
    leaving += leaves ? 1 : 0;
    differing += transmits != transmits_in_paper ? 1 : 0;
    if (!leaves || !reverses) continue;
    ASSERT_EQ(before > 0.0 ? law.upper() : law.lower(), sample.displacement);
    ASSERT_EQ(law.upper() - law.lower(), 0.25);
  }
  EXPECT_GT(differing, 1000);
  EXPECT_GT(leaving - differing, 1000);
}

TEST(ImmediateBacklash, FromRestIsAnotherMotionThanThatOfFigure8) {
  const auto paper = test::record(test::KollarCase{}, 9.1);
  const auto immediate = test::record<ImmediateBacklash<double>>(test::KollarCase{}, 9.1);
  const auto engaged = [](const auto& samples, std::size_t ms) { return samples[ms].engaged; };
  // The paper's drive is in at 9.065 s; this one is in at 9.064 s and out at 9.086 s.
  EXPECT_TRUE(engaged(paper, 9064));
  EXPECT_TRUE(engaged(immediate, 9063));
  for (std::size_t ms = 9064; ms < 9086; ++ms) EXPECT_FALSE(engaged(immediate, ms)) << ms;
  EXPECT_TRUE(engaged(immediate, 9086));
}

/// Δz and Δż of a smooth motion with large and small loops.
ContactSample smooth_motion(double time) {
  return {std::sin(time) + 0.4 * std::sin(2.7 * time + 0.3),
          std::cos(time) + 1.08 * std::cos(2.7 * time + 0.3)};
}

/// Samples of 60 s at which the two laws decide differently.
int disagreements(ContactLaw one, ContactLaw other, double width, double period) {
  SampledContact first({one, width}), second({other, width});
  int count = 0;
  for (int j = 0; j * period < 60.0; ++j) {
    const auto sample = smooth_motion(j * period);
    const bool transmits = first.step(sample.displacement, sample.velocity);
    count += transmits != second.step(sample.displacement, sample.velocity) ? 1 : 0;
  }
  return count;
}

TEST(ContactLaw, FastSampledKollarImmediateAndPlayAreOneLaw) {
  // A sample or two at each entry and each exit, however many samples lie between: in 60 s the
  // motion reverses less than 60 times.
  for (const double width : {0.1, 0.5, 1.5}) {
    for (const double period : {0.01, 0.001, 0.0001}) {
      for (const ContactLaw other : {ContactLaw::immediate, ContactLaw::play}) {
        EXPECT_LE(disagreements(ContactLaw::kollar, other, width, period), 2 * 60) << period;
      }
      EXPECT_GT(disagreements(ContactLaw::kollar, ContactLaw::dead_zone, width, period), 1 / period)
          << "the dead zone is another law";
    }
  }
}

TEST(SampledContact, ServesTheSampledMotionAsItsLawDoes) {
  const test::KollarCase which;
  const auto loop = which.loop();
  SampledMotion<double, SampledContact> any(
      loop, which.gains, held_harmonic(loop), which.excitation,
      SampledContact({ContactLaw::play, which.width}), which.initial_state);
  auto play = which.motion<PlayBacklash<double>>();
  int idle = 0;
  for (int j = 0; j < 3000; ++j) {
    const auto found = any.sense(), expected = play.sense();
    ASSERT_EQ(found.state, expected.state);
    ASSERT_EQ(found.engaged, expected.engaged);
    idle += found.engaged ? 0 : 1;
    any.advance();
    play.advance();
  }
  EXPECT_GT(idle, 500);
  EXPECT_LT(idle, 2500);
}

TEST(BacklashParameters, WhatIsOutOfRangeIsRefusedByNameWhateverTheLaw) {
  const auto refused = [](const BacklashParameters& backlash) -> std::string {
    try {
      const SampledContact contact(backlash);
      return "";
    } catch (const InvalidParameter& error) {
      return error.name();
    }
  };
  for (const ContactLaw law : every_law) {
    for (const double bad : {-1e-9, std::numeric_limits<double>::quiet_NaN(),
                             std::numeric_limits<double>::infinity()}) {
      EXPECT_EQ(refused({law, bad, 0.0, 0.0}), "backlash width r0");
      EXPECT_EQ(refused({law, 0.0, bad, 0.0}), "contact stiffness kc");
      EXPECT_EQ(refused({law, 0.0, 0.0, bad}), "contact damping cc");
    }
    EXPECT_EQ(refused({law, 0.002, 1e4, 3.0}), "");
  }
}

}  // namespace
}  // namespace holdfast
