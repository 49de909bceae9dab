// Enclosed transfer functions against those of doubles, which come by another formula, and their
// expansions against themselves at other points.

#include "holdfast/stability/response/enclosed_response.hpp"

#include "holdfast/stability/response/modal_response.hpp"
#include "support/string_loop.hpp"

namespace holdfast::test {
namespace {

using Complex = std::complex<double>;

std::vector<StringLoop> enclosed_loops() {
  return {{string_with_absorber(40, 0.02), {0.001, 0.0}},
          {string_with_absorber(40, 0.02), {0.003, 0.003}},
          {string_with_absorber(10, 1e-4), {0.011, 0.0047}},
          {string_with_absorber(10, 0.02), {0.002, 0.0111}},
          {string_with_absorber(5, 0.02, {80.0, 60.0}), {0.002, 0.0013}},
          {string_with_absorber(5, 0.02, {80.0, 60.0, 0.4}), {0.002, 0.02}}};
}

/// As far as doubles go.
TEST(EnclosedResponse, IsThatOfDoubles) {
  Random random(1);
  for (const StringLoop& setting : enclosed_loops()) {
    const auto doubles = setting.doubles();
    const EnclosedResponse enclosed = setting.enclosed();
    EXPECT_EQ(enclosed.held_commands(), doubles.held_commands());
    for (int trial = 0; trial < 100; ++trial) {
      const Complex lambda = std::polar(random.uniform(0.995, 1.2), random.uniform(0.0, 3.14));
      const auto g = doubles.at_distance_from_one(lambda - 1.0);
      const Complex power = std::pow(lambda, doubles.held_commands());
      const auto f = enclosed.about(ComplexEnclosure(lambda, 0.0), 0.0);
      for (const auto& [ours, theirs] : {std::pair(f.displacement, power * g.displacement),
                                         std::pair(f.velocity, power * g.velocity)}) {
        EXPECT_LE(std::abs(ours.value.middle() - theirs),
                  ours.value.radius() + 1e-7 * std::abs(theirs))
            << lambda;
        EXPECT_LT(ours.value.radius(), 1e-4 * std::abs(theirs)) << lambda;
        EXPECT_LT(ours.rest, 1e-260);
      }
      const auto own = enclosed.power_about(ComplexEnclosure(lambda, 0.0), 0.0);
      EXPECT_LE(std::abs(own.value.middle() - power), own.value.radius() + 1e-13 * std::abs(power));
    }
  }
}

/// Whether f(λ + w) may be what an expansion says, and how much of its rest is used.
double share_of_rest(const EnclosedExpansion& expansion, const EnclosedExpansion& there,
                     const Complex& step) {
  const ComplexEnclosure said = expansion.value + expansion.slope * ComplexEnclosure(step, 0.0);
  const double away = (there.value - said).least_modulus();
  EXPECT_LE(away, expansion.rest);
  return away / expansion.rest;
}

TEST(EnclosedResponse, ExpansionsHoldWhatIsNear) {
  Random random(2);
  for (const StringLoop& setting : enclosed_loops()) {
    const EnclosedResponse response = setting.enclosed();
    double used = 0.0;
    for (int trial = 0; trial < 600; ++trial) {
      const Complex lambda = std::polar(random.uniform(1.0, 1.05), random.uniform(0.0, 3.14));
      const double radius = random.log_uniform(1e-5, 0.03);
      const auto about = response.about(ComplexEnclosure(lambda, 0.0), radius);
      const auto power_about = response.power_about(ComplexEnclosure(lambda, 0.0), radius);
      if (!std::isfinite(about.displacement.rest)) continue;
      const Complex step = std::polar(radius * (1.0 - 1e-12), random.uniform(0.0, 6.28));
      const ComplexEnclosure there(lambda + step, 0.0);
      const auto f = response.about(there, 0.0);
      used = std::max({used, share_of_rest(about.displacement, f.displacement, step),
                       share_of_rest(about.velocity, f.velocity, step)});
      if (response.held_commands() > 1) {
        const double share = share_of_rest(power_about, response.power_about(there, 0.0), step);
        EXPECT_GT(share, 0.2);
      }
    }
    // The bound is not far above what it bounds: beside one pole it is sharp.
    EXPECT_GT(used, 0.5);
    EXPECT_LE(used, 1.0);
  }
}

/// Of one pole, or one pair, the rest is bounded by what it is at its worst.
TEST(EnclosedResponse, ExpansionsOfOnePoleAreSharp) {
  Random random(3);
  const EnclosedPole pair{{{-3.0, 30.0}, 0.0}, {{0.002, -0.01}, 0.0}, true};
  // Of which either pole is as near.
  const EnclosedPole slow{{{-30.0, 1.0}, 0.0}, {{0.002, -0.01}, 0.0}, true};
  const EnclosedPole single{-30.0, 0.01, false};
  for (const EnclosedPole& pole : {pair, slow, single}) {
    const EnclosedResponse response({pole}, {0.01, 0.0});
    const Complex at = std::exp(0.01 * pole.s.middle());
    double used = 0.0;
    for (int trial = 0; trial < 20000; ++trial) {
      const Complex lambda = at + std::polar(0.1, random.uniform(0.0, 6.28));
      const double radius = 0.1 * random.uniform(0.1, 0.9);
      const auto about = response.about(ComplexEnclosure(lambda, 0.0), radius);
      const Complex step = std::polar(radius * (1.0 - 1e-12), random.uniform(0.0, 6.28));
      const auto there = response.about(ComplexEnclosure(lambda + step, 0.0), 0.0);
      used = std::max({used, share_of_rest(about.displacement, there.displacement, step),
                       share_of_rest(about.velocity, there.velocity, step)});
    }
    EXPECT_GT(used, 0.95);
  }
}

TEST(EnclosedResponse, KnowsNothingBesideAPole) {
  const StringLoop setting{string_with_absorber(3, 0.02), {0.01, 0.0}};
  const EnclosedResponse response = setting.enclosed();
  const auto doubles = setting.doubles();
  for (const Complex& increment : doubles.pole_increments()) {
    const Complex pole = 1.0 + increment;
    for (const double away : {0.0, 0.5e-3, 0.999e-3})
      EXPECT_EQ(response.about(ComplexEnclosure(pole + away, 0.0), 1e-3).displacement.rest,
                std::numeric_limits<double>::infinity());
    EXPECT_TRUE(std::isfinite(
        response.about(ComplexEnclosure(pole + 1.001e-3, 0.0), 1e-3).displacement.rest));
  }
}

/// The same of one real pole alone, as of a filter or of an overdamped absorber.
TEST(EnclosedResponse, KnowsNothingBesideARealPole) {
  const EnclosedResponse response({EnclosedPole{-3.0, 0.01, false}}, {0.01, 0.0});
  const double pole = std::exp(-0.03);
  for (const double radius : {0.01, 0.05, 0.5, 1.9}) {
    for (const double share : {-0.99, 0.0, 0.3, 0.99}) {
      const auto about = response.about(ComplexEnclosure(pole + share * radius, 0.0), radius);
      EXPECT_EQ(about.displacement.rest, std::numeric_limits<double>::infinity());
      EXPECT_EQ(about.velocity.rest, std::numeric_limits<double>::infinity());
    }
    const auto beside = response.about(ComplexEnclosure(pole + 1.01 * radius, 0.0), radius);
    EXPECT_GE(beside.displacement.rest, 0.0);
    EXPECT_TRUE(std::isfinite(beside.displacement.rest));
  }
}

TEST(EnclosedResponse, CountsThePolesOutside) {
  const StringLoop setting{string_with_absorber(5, 0.02), {0.01, 0.0}};
  const EnclosedResponse response = setting.enclosed();
  const auto doubles = setting.doubles();
  EXPECT_EQ(response.poles_outside(1.0), 0);
  for (const double radius : {0.3, 0.9, 0.97, 0.99, 0.999}) {
    int count = 0;
    for (const Complex& increment : doubles.pole_increments())
      count += std::abs(1.0 + increment) > radius ? 1 : 0;
    EXPECT_EQ(response.poles_outside(radius), count) << radius;
  }
  // What nothing damps may lie on the circle.
  ConductorWithAbsorber undamped = string_with_absorber(5, 0.0);
  undamped.absorber.damping = 0.0;
  undamped.poles = plant_poles(undamped.modes, undamped.absorber);
  const StringLoop by_none{undamped, {0.01, 0.0}};
  EXPECT_EQ(by_none.enclosed().poles_outside(1.0), std::nullopt);
  const StringLoop by_absorber{string_with_absorber(5, 0.0), {0.01, 0.0}};
  EXPECT_EQ(by_absorber.enclosed().poles_outside(1.0), 0);
}

/// A delay that is a whole number of samples but for round-off keeps as many commands.
TEST(EnclosedResponse, TakesWholeSamplesAsTheyAre) {
  const auto poles = enclosed_poles(string_with_absorber(4, 0.02));
  const ComplexEnclosure lambda({0.6, 0.8}, 0.0);
  const auto at = [&](double delay) {
    const EnclosedResponse response(poles, {0.001, delay});
    EXPECT_EQ(response.held_commands(), 3);
    return response.about(lambda, 0.0).velocity.value;
  };
  const ComplexEnclosure exact = at(0.003), beyond = at(0.003 * (1.0 + 5e-13));
  EXPECT_LE(std::abs(exact.middle() - beyond.middle()), exact.radius() + beyond.radius());
  EXPECT_LT(beyond.radius(), 1e-9);
}

TEST(EnclosedResponse, RefusesWhatIsNotAdmissible) {
  const auto poles = enclosed_poles(string_with_absorber(4, 0.02));
  EXPECT_THROW(EnclosedResponse(poles, {0.0, 0.0}), InvalidParameter);
  EXPECT_THROW(EnclosedResponse(poles, {0.001, -1e-9}), InvalidParameter);
  EXPECT_THROW(EnclosedResponse(poles, {0.001, 1.1}), InvalidParameter);
}

}  // namespace
}  // namespace holdfast::test
