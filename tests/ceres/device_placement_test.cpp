#include "holdfast/ceres/device_placement.hpp"

#include "holdfast/cable/taut_string.hpp"
#include "holdfast/span/end_response.hpp"
#include "holdfast/span/span_roots.hpp"
#include "support/testing.hpp"

namespace holdfast::placement {
namespace {

TautString<double> drake() { return {28020.0, 1.628, 300.0, 0.0}; }

SpanDevice dashpot_at(double position, double damping) {
  return {position, LumpedDevice{{{damping}}, 0.0}};
}

double ratio_of(const SpanDevice& device, double frequency) {
  const SpanEnd end{{device.position}, {&device}};
  return end_response(drake(), end, 2.0 * pi<double> * frequency).inverse_standing_wave_ratio();
}

/// 1/S over a band.
std::vector<double> ratio_levels(const SpanDevice& device, double lowest, double highest) {
  std::vector<double> levels;
  for (int k = 0; k <= 40; ++k)
    levels.push_back(1.0 / ratio_of(device, lowest + (highest - lowest) * k / 40.0));
  return levels;
}

MovableValue strength(double lower, double upper) {
  MovableValue value{lower, upper};
  value.by_ratio = true;
  return value;
}

TEST(BestPlacement, ADashpotMatchesTheWaveOfOneFrequency) {
  const double wave_impedance = drake().wave_impedance(), speed = drake().wave_speed();
  for (const double frequency : {5.0, 20.0, 37.0}) {
    const double phase = 2.0 * pi<double> * frequency * 1.1 / speed;
    const Placement best = best_placement({strength(1.0, 1e5)}, [&](const auto& values) {
      return std::vector<double>{1.0 / ratio_of(dashpot_at(1.1, values[0]), frequency)};
    });
    ASSERT_EQ(best.values.size(), 1U);
    const double matched = wave_impedance / std::abs(std::sin(phase));
    EXPECT_NEAR(best.values[0], matched, 1e-3 * matched);
    const double half = 0.5 * (phase <= 0.5 * pi<double> ? phase : pi<double> - phase);
    EXPECT_NEAR(1.0 / best.worst, std::tan(half), 1e-6 * std::tan(half));
    EXPECT_EQ(best.bounds[0], PlacementBound::none);
  }
}

// Krenk: ζ = 0.5 a/L with c = Z_c/(nπa/L), to first order in a/L; the farther out, the better.
TEST(BestPlacement, OfOneModeIsKrenksAtTheFarthestPlace) {
  const TautString<double> stay{3.5e6, 60.0, 300.0, 0.0};
  const Placement best =
      best_placement({MovableValue{1.0, 6.0}, strength(1e3, 1e7)}, [&](const auto& values) {
        const auto roots = span_roots(stay, {dashpot_at(values[0], values[1])}, 3);
        return std::vector<double>{1.0 / roots[2].damping()};
      });
  ASSERT_EQ(best.values.size(), 2U);
  EXPECT_EQ(best.bounds[0], PlacementBound::upper);
  EXPECT_NEAR(best.values[0], 6.0, 1e-3);
  const double krenk = stay.wave_impedance() / (3.0 * pi<double> * 0.02);
  EXPECT_NEAR(best.values[1], krenk, 0.02 * krenk);
  EXPECT_NEAR(1.0 / best.worst, 0.5 * 0.02, 0.03 * 0.5 * 0.02);
}

TEST(BestPlacement, OfAStockbridgeIsThatOfAFineGrid) {
  const LumpedDevice damper = stockbridge({4.5, {9.0, 28.0}, {0.2, 0.25}, 0.6, 0.5});
  for (const double lowest : {6.0, 12.0, 25.0}) {
    const auto levels = [&](const std::vector<double>& values) {
      return ratio_levels({values[0], damper}, lowest, 45.0);
    };
    MovableValue place{0.2, 5.0};
    place.places = 27;
    const Placement best = best_placement({place}, levels);
    double least = std::numeric_limits<double>::infinity(), at = 0.0;
    for (int k = 0; k <= 4800; ++k) {
      const double a = 0.2 + 0.001 * k;
      const auto there = levels({a});
      const double worst = *std::max_element(there.begin(), there.end());
      if (!(worst < least)) continue;
      least = worst;
      at = a;
    }
    EXPECT_LE(best.worst, least * (1.0 + 1e-9));
    EXPECT_NEAR(best.worst, least, 2e-3 * least);
    EXPECT_NEAR(best.values[0], at, 2e-3);
    EXPECT_LT(best.questions, 1000);
  }
}

/// Two levels that meet in a kink along x + y = 1.2, beyond which nothing is admissible.
TEST(BestPlacement, EndsAtTheEdgeOfWhatIsAdmissible) {
  const auto levels = [](const std::vector<double>& values) {
    const double x = values[0], y = values[1];
    if (x + y > 1.2) return std::vector<double>();
    return std::vector<double>{1.0 + (1.0 - x) * (1.0 - x), 1.0 + 2.0 * (1.0 - y) * (1.0 - y)};
  };
  const Placement best = best_placement({MovableValue{0.0, 2.0}, MovableValue{-1.0, 1.5}}, levels);
  ASSERT_EQ(best.values.size(), 2U);
  EXPECT_LE(best.values[0] + best.values[1], 1.2);
  // (1 − x) = √2 (1 − y) and x + y = 1.2.
  const double y = 1.0 - 0.8 / (1.0 + std::sqrt(2.0));
  EXPECT_NEAR(best.values[1], y, 2e-3);
  EXPECT_NEAR(best.worst, 1.0 + 2.0 * (1.0 - y) * (1.0 - y), 1e-3);
}

TEST(BestPlacement, IsNeverWorseThanWhereItStands) {
  // A minimum that no grid meets.
  MovableValue value{0.0, 1.0, 0.123456};
  const Placement best = best_placement({value}, [](const auto& values) {
    return std::vector<double>{std::abs(values[0] - 0.123456) < 1e-7 ? 0.5 : 1.0};
  });
  EXPECT_EQ(best.worst, 0.5);
  EXPECT_NEAR(best.values[0], 0.123456, 1e-9);
}

TEST(BestPlacement, OfNothingAdmissibleIsNone) {
  const Placement best =
      best_placement({MovableValue{0.0, 1.0}}, [](const auto&) { return std::vector<double>(); });
  EXPECT_TRUE(best.values.empty());
  EXPECT_GT(best.questions, 0);
}

TEST(BestPlacement, WhatTheLevelsThrowEndsTheSearch) {
  int asked = 0;
  const auto levels = [&](const std::vector<double>& values) {
    if (++asked > 20) throw std::runtime_error("enough");
    return std::vector<double>{1.0 + values[0] * values[0]};
  };
  EXPECT_THROW(best_placement({MovableValue{-1.0, 2.0}}, levels), std::runtime_error);
  EXPECT_EQ(asked, 21);
  PlacementOptions options;
  options.watch = [] { throw std::domain_error("stop"); };
  EXPECT_THROW(best_placement({MovableValue{-1.0, 2.0}}, levels, options), std::domain_error);
}

TEST(BestPlacement, RefusesWhatIsNoQuestion) {
  const auto levels = [](const std::vector<double>&) { return std::vector<double>{1.0}; };
  EXPECT_THROW(best_placement({}, levels), InvalidParameter);
  EXPECT_THROW(best_placement({MovableValue{1.0, 1.0}}, levels), InvalidParameter);
  EXPECT_THROW(best_placement({strength(0.0, 1.0)}, levels), InvalidParameter);
  EXPECT_THROW(best_placement({MovableValue{0.0, 1.0, 2.0}}, levels), InvalidParameter);
  PlacementOptions options;
  options.norms = {1.0};
  EXPECT_THROW(best_placement({MovableValue{0.0, 1.0}}, levels, options), InvalidParameter);
  options = {};
  options.runs = 0;
  EXPECT_THROW(best_placement({MovableValue{0.0, 1.0}}, levels, options), InvalidParameter);
}

}  // namespace
}  // namespace holdfast::placement
