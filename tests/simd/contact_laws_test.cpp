// The backlash laws on packs: every lane moves as it would alone.

#include "holdfast/contact/contact_law.hpp"
#include "holdfast/simd/pack.hpp"
#include "support/random.hpp"

namespace holdfast {
namespace {

using LawPack = simd::Pack<double>;
constexpr std::size_t law_lanes = Lanes<LawPack>::count;

struct LawLanes {
  double values[law_lanes];
  LawPack pack() const { return Lanes<LawPack>::load(values); }
};

/// A multiple of 1/8, with many ties and zeros.
LawLanes lattice_lanes(test::Random& random) {
  LawLanes lanes{};
  for (double& value : lanes.values) value = (static_cast<double>(random.index(9)) - 4.0) / 8.0;
  return lanes;
}

/// Steps a law on packs, of widths 0, 1/8, 2/8, … one a lane, beside one law a lane.
/// @param make  (width) → law, of a scalar or of a pack
template <class Make>
void expect_lanes_as_alone(const Make& make) {
  LawLanes widths{};
  for (std::size_t lane = 0; lane < law_lanes; ++lane)
    widths.values[lane] = static_cast<double>(lane) / 8.0;
  auto together = make(widths.pack());
  std::vector<decltype(make(0.0))> alone;
  for (const double width : widths.values) alone.push_back(make(width));
  test::Random random(891);
  int differing = 0;
  for (int sample = 0; sample < 20000; ++sample) {
    const LawLanes displacement = lattice_lanes(random), velocity = lattice_lanes(random);
    std::uint8_t transmits[law_lanes], inside[law_lanes];
    Lanes<LawPack>::store_flags(together.step(displacement.pack(), velocity.pack()), transmits);
    Lanes<LawPack>::store_flags(together.inside(), inside);
    for (std::size_t lane = 0; lane < law_lanes; ++lane) {
      const bool expected = alone[lane].step(displacement.values[lane], velocity.values[lane]);
      ASSERT_EQ(transmits[lane] != 0, expected) << "lane " << lane << ", sample " << sample;
      ASSERT_EQ(inside[lane] != 0, alone[lane].inside());
    }
    differing += transmits[0] != transmits[law_lanes - 1] ? 1 : 0;
  }
  EXPECT_GT(differing, law_lanes > 1 ? 1000 : -1);
}

TEST(PackedContactLaws, EveryLaneDecidesAsItWouldAlone) {
  expect_lanes_as_alone([](const auto& width) { return Backlash(width); });
  expect_lanes_as_alone(
      [](const auto& width) { return ImmediateBacklash<std::decay_t<decltype(width)>>(width); });
  expect_lanes_as_alone([](const auto& width) { return PlayBacklash(width); });
  expect_lanes_as_alone([](const auto& width) { return DeadZone(width); });
}

TEST(PackedContactLaws, NoBacklashTransmitsInEveryLane) {
  NoBacklash<LawPack> law;
  EXPECT_TRUE(all(law.step(LawPack(0.0), LawPack(0.0))));
  EXPECT_FALSE(any(law.inside()));
}

TEST(PackedContactLaws, TheTouchedStopIsThatOfEveryLaneAlone) {
  test::Random random(892);
  for (const double width : {0.0, 0.5}) {
    const DeadZone<LawPack> together{LawPack(width)};
    const DeadZone<double> alone(width);
    for (int sample = 0; sample < 2000; ++sample) {
      const LawLanes displacement = lattice_lanes(random);
      LawLanes side{};
      Lanes<LawPack>::store(together.side(displacement.pack()), side.values);
      for (std::size_t lane = 0; lane < law_lanes; ++lane)
        ASSERT_EQ(side.values[lane], alone.side(displacement.values[lane]));
    }
  }
}

}  // namespace
}  // namespace holdfast
