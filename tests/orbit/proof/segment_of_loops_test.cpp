#include "holdfast/orbit/proof/segment_of_loops.hpp"

#include "orbit/proof/proved_orbits.hpp"
#include "support/random.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

bool holds(const Enclosure& enclosure, long double value) {
  return static_cast<long double>(enclosure.lower()) <= value &&
         value <= static_cast<long double>(enclosure.upper());
}

IdealLoop<double> between(const IdealLoop<double>& a, const IdealLoop<double>& b, double share) {
  IdealLoop<double> loop = a;
  const auto mixed = [share](double x, double y) { return x + share * (y - x); };
  loop.gains = {mixed(a.gains.proportional, b.gains.proportional),
                mixed(a.gains.differential, b.gains.differential)};
  loop.excitation.amplitude = mixed(a.excitation.amplitude, b.excitation.amplitude);
  loop.backlash_width = mixed(a.backlash_width, b.backlash_width);
  return loop;
}

/// The maps of extended precision of any loop between lie within those of the segment, and near
/// the ends of what they say of the loop's position.
TEST(SegmentOfLoops, HoldsEveryLoopBetween) {
  const IdealLoop<double> first = test::proved_loop(0.01, 0.001, 0.004);
  IdealLoop<double> last = first;
  last.gains = {-500.0, -11.0};
  last.excitation.amplitude = 0.7;
  last.backlash_width = 0.003;
  const Rational ratio{1, 10};
  const detail::SegmentOfLoops segment(enclosed(first), enclosed(last), ratio);
  for (const double share : {0.0, 0.3, 0.5, 1.0}) {
    const IdealLoop<double> loop = between(first, last, share);
    const ItineraryMaps<long double> maps(converted<long double>(loop), ratio);
    const Enclosure s = Enclosure(share - 0.5) + Enclosure(-1e-15, 1e-15);
    EXPECT_TRUE(holds(segment.width().centre + s * segment.width().slope, loop.backlash_width));
    EXPECT_TRUE(segment.position().contains(share - 0.5));
    for (const std::uint8_t engaged : {std::uint8_t{0}, std::uint8_t{1}}) {
      const Matrix<long double, 5> exact = maps.map_in_units(engaged != 0);
      const auto& map = segment.map(engaged);
      for (Eigen::Index k = 0; k < 25; ++k) {
        EXPECT_TRUE(holds(map.centre(k) + s * map.slope(k), exact(k))) << share << ' ' << k;
        if (share == 0.0 || share == 1.0) {
          const auto& end = share == 0.0 ? segment.ends().front() : segment.ends().back();
          EXPECT_TRUE(holds(end.at(engaged)(k), exact(k))) << k;
        }
      }
    }
    for (std::size_t j = 0; j < 20; ++j) {
      const auto addition = segment.addition(j);
      const Vector<long double, 4> exact =
          maps.additions()[j % 10].cwiseQuotient(maps.units().head<4>());
      for (Eigen::Index k = 0; k < 4; ++k)
        EXPECT_TRUE(holds(addition.centre[k] + s * addition.slope[k], exact[k])) << share;
    }
  }
}

TEST(SegmentOfLoops, OfOneLoopHasNoSlope) {
  IdealLoop<double> loop = test::proved_loop(0.001, 0.0);
  loop.hold = ForceHold::exact;
  const detail::SegmentOfLoops segment(enclosed(loop), Rational{1, 100});
  EXPECT_FALSE(segment.has_backlash());
  const ItineraryMaps<long double> maps(converted<long double>(loop), Rational{1, 100});
  for (std::size_t j = 0; j < 100; ++j) {
    const auto addition = segment.addition(j);
    const Vector<long double, 4> exact = maps.additions()[j].cwiseQuotient(maps.units().head<4>());
    for (Eigen::Index k = 0; k < 4; ++k) {
      EXPECT_TRUE(holds(addition.centre[k], exact[k]));
      EXPECT_EQ(addition.slope[k], Enclosure());
    }
  }
}

}  // namespace
}  // namespace holdfast
