// Arcs on which roots may lie, and proved root counts, against the eigenvalues of the loop's map
// and the closed form of the boundary.

#include "holdfast/stability/chart/circle_arcs.hpp"

#include "holdfast/control/loop_map.hpp"
#include "holdfast/stability/boundary/unit_circle_crossings.hpp"
#include "support/dense_routes.hpp"
#include "support/lagging_plant.hpp"
#include "support/string_loop.hpp"

namespace holdfast::test {
namespace {

std::vector<StringLoop> arc_loops() {
  return {{string_with_absorber(1, 0.02), {0.001, 0.0}},
          {string_with_absorber(10, 0.02), {0.003, 0.003}},
          {string_with_absorber(10, 1e-4), {0.011, 0.0047}},
          {string_with_absorber(8, 0.02), {0.004, 0.013}},
          {string_with_absorber(6, 0.02, {80.0, 60.0, 0.7}, 0.3), {0.003, 0.002}},
          {string_with_absorber(30, 0.02), {0.001, 0.0}}};
}

PdGains<double> gains_of(Random& random) {
  return {random.uniform(-1200.0, 400.0), random.uniform(-45.0, 25.0)};
}

/// Roots with a modulus above that of the circle, by eigenvalues; −1 where one is too near.
int roots_by_eigenvalues(const LoopMap<double>& map, const PdGains<double>& gains, double radius) {
  int outside = 0;
  for (const auto& root : eigenvalues_of(map.closed_map(gains))) {
    const double modulus = std::abs(root);
    if (std::abs(modulus - radius) < 1e-9) return -1;
    outside += modulus > radius ? 1 : 0;
  }
  return outside;
}

TEST(CircleArcs, CountRootsAsEigenvaluesDo) {
  Random random(1);
  for (const StringLoop& setting : arc_loops()) {
    const LoopMap<double> map = setting.map();
    int most = 0, compared = 0;
    for (const double radius : {1.0, 1.0003, 1.02, 1.3}) {
      CircleArcs circle(setting.enclosed(), radius);
      for (int trial = 0; trial < 40; ++trial) {
        const PdGains<double> gains = gains_of(random);
        const int expected = roots_by_eigenvalues(map, gains, radius);
        if (expected < 0) continue;
        const auto counted = circle.roots_outside(gains);
        ASSERT_TRUE(counted) << gains.proportional << " " << gains.differential;
        EXPECT_EQ(*counted, expected) << gains.proportional << " " << gains.differential;
        most = std::max(most, expected);
        ++compared;
      }
    }
    EXPECT_GT(compared, 150);
    EXPECT_GE(most, 2);
  }
}

/// Real poles, of overdamped absorbers and slow filters, and samples as long as the plant's own
/// periods.
TEST(CircleArcs, CountRootsBesideRealPoles) {
  Random random(9);
  int compared = 0, real = 0;
  for (int trial = 0; trial < 150; ++trial) {
    const TwoMass<double> plant{1.0,
                                39.5,
                                random.uniform(0.0, 1.0),
                                random.log_uniform(0.03, 1.0),
                                random.log_uniform(1.0, 150.0),
                                random.log_uniform(0.5, 20.0)};
    LoopHardware hardware;
    if (trial % 2 == 0) hardware.measurement_filter = random.log_uniform(0.2, 3.0);
    const double period = random.uniform(0.05, 0.6);
    const Sampling<double> sampling{period, random.uniform(0.0, 2.0) * period};
    const auto poles = enclosed_poles(plant, hardware);
    if (poles.empty()) continue;
    for (const EnclosedPole& pole : poles) real += pole.is_pair ? 0 : 1;
    CircleArcs circle(EnclosedResponse(poles, sampling));
    const LoopMap<double> map = loop_map(with_hardware(through_ports(plant), hardware), sampling);
    for (int k = 0; k < 30; ++k) {
      const PdGains<double> gains{random.uniform(-400.0, 200.0), random.uniform(-60.0, 60.0)};
      const int expected = roots_by_eigenvalues(map, gains, 1.0);
      const auto counted = circle.roots_outside(gains);
      if (expected < 0 || !counted) continue;
      EXPECT_EQ(*counted, expected)
          << trial << ": " << gains.proportional << " " << gains.differential;
      ++compared;
    }
  }
  EXPECT_GT(compared, 3500);
  EXPECT_GT(real, 100);
}

/// Within the circle of some of the plant's own poles too.
TEST(CircleArcs, CountThePlantsOwnRoots) {
  const StringLoop setting{string_with_absorber(5, 0.02), {0.01, 0.0}};
  for (const double radius : {0.9, 0.97, 0.99}) {
    CircleArcs circle(setting.enclosed(), radius);
    const int open = *setting.enclosed().poles_outside(radius);
    EXPECT_GT(open, 0);
    EXPECT_EQ(circle.roots_outside({0.0, 0.0}), open);
    EXPECT_EQ(circle.roots_outside({-300.0, -3.0}),
              roots_by_eigenvalues(setting.map(), {-300.0, -3.0}, radius));
  }
}

/// The gains at which e^{iθ} is a root: two real linear equations.
PdGains<double> gains_at(const CommandResponse<double>& g) {
  const double area = (std::conj(g.displacement) * g.velocity).imag();
  return {g.velocity.imag() / area, -g.displacement.imag() / area};
}

/// Whether some arc that may have a root goes over an angle: told by an angle's own small circle of
/// gains, to which the same arcs are put.
TEST(CircleArcs, MeetEveryRootOnTheCircle) {
  Random random(2);
  for (const StringLoop& setting : arc_loops()) {
    const auto doubles = setting.doubles();
    CircleArcs circle(setting.enclosed());
    for (int trial = 0; trial < 200; ++trial) {
      const double angle = random.log_uniform(0.003, 3.14);
      const PdGains<double> gains = gains_at(doubles.at_angle(angle));
      if (!(std::abs(gains.proportional) < 1e5 && std::abs(gains.differential) < 1e4)) continue;
      // A box with those gains at its corner, side, or inside, after boxes around it.
      CircleArcs::Arcs arcs = circle.all();
      for (const double size : {1e3, 10.0, 0.1, 1e-3, 1e-5}) {
        const double p = size * std::abs(gains.proportional) * 1e-2;
        const double d = size * std::abs(gains.differential) * 1e-2;
        const double left = random.index(3) == 0 ? 1e-9 : random.unit();
        const double low = random.index(3) == 0 ? 1e-9 : random.unit();
        const GainBox box{gains.proportional - left * p, gains.proportional + (1.0 - left) * p,
                          gains.differential - low * d, gains.differential + (1.0 - low) * d};
        if (size == 1e3) {
          arcs = circle.meeting(box, arcs);
        } else {
          EXPECT_FALSE(circle.meeting(box, arcs).empty()) << angle << " " << size;
          EXPECT_FALSE(circle.meeting(box, circle.all()).empty()) << angle << " " << size;
        }
      }
      EXPECT_EQ(circle.roots_outside(gains).has_value(), false) << angle;
    }
  }
}

/// Roots at λ = 1 and λ = −1, the ends of the half circle, too.
TEST(CircleArcs, MeetTheRealRoots) {
  for (const StringLoop& setting : arc_loops()) {
    const auto doubles = setting.doubles();
    CircleArcs circle(setting.enclosed());
    const auto g = doubles.at_angle(pi<double>);
    for (const double p : {-500.0, 0.0, 100.0}) {
      const double d = ((1.0 - p * g.displacement) / g.velocity).real();
      const GainBox at{p - 1e-6, p + 1e-6, d - 1e-6, d + 1e-6};
      EXPECT_FALSE(circle.meeting(at, circle.all()).empty());
      const auto above = circle.roots_outside({p, d + 1e-3});
      const auto below = circle.roots_outside({p, d - 1e-3});
      ASSERT_TRUE(above && below);
      EXPECT_EQ(std::abs(*above - *below), 1);
    }
  }
}

/// A box that ends halfway to the next passage is free.
TEST(CircleArcs, LeaveWhatIsFree) {
  Random random(3);
  for (const StringLoop& setting : arc_loops()) {
    const UnitCircleCrossings<double> doubles(setting.doubles());
    CircleArcs circle(setting.enclosed());
    int boxes = 0, crossed = 0;
    for (int trial = 0; trial < 300; ++trial) {
      const PdGains<double> gains = gains_of(random);
      const auto passages = doubles.passages(FreeGain::differential, gains);
      double nearest = 1e300;
      for (const auto& passage : passages)
        nearest = std::min(nearest, std::abs(passage.gain - gains.differential));
      if (nearest < 0.01) continue;
      const GainBox box{gains.proportional - 1e-7, gains.proportional + 1e-7,
                        gains.differential - 0.5 * nearest, gains.differential + 0.5 * nearest};
      crossed += circle.meeting(box, circle.all()).empty() ? 0 : 1;
      ++boxes;
    }
    EXPECT_GT(boxes, 100);
    EXPECT_LE(crossed, boxes / 20);
  }
}

TEST(CircleArcs, DecideNothingOfGainsThatAreNone) {
  CircleArcs circle(StringLoop{string_with_absorber(3, 0.02), {0.01, 0.0}}.enclosed());
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(circle.roots_outside({infinity, 0.0}), std::nullopt);
  EXPECT_EQ(circle.roots_outside({0.0, std::nan("")}), std::nullopt);
  EXPECT_EQ(circle.roots_outside({-557.0, -3.0}, 2), std::nullopt);
  EXPECT_FALSE(circle.meeting({-infinity, infinity, 0.0, 1.0}, circle.all()).empty());
}

/// What nothing damps has a pole on the circle: nothing is counted.
TEST(CircleArcs, DecideNothingBesideAPoleOnTheCircle) {
  StringLoop setting{string_with_absorber(3, 0.0), {0.01, 0.0}};
  setting.conductor.absorber.damping = 0.0;
  setting.conductor.poles = plant_poles(setting.conductor.modes, setting.conductor.absorber);
  CircleArcs circle(setting.enclosed());
  EXPECT_EQ(circle.roots_outside({-10.0, -1.0}), std::nullopt);
}

}  // namespace
}  // namespace holdfast::test
