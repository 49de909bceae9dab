#include "holdfast/contact/contact_law.hpp"

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
