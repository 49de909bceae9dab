#include "holdfast/stability/chart/proved_string_family.hpp"

#include "holdfast/stability/response/modal_response.hpp"
#include "support/loop_family.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

using Parameters = StringFamily::Parameters<double>;

constexpr double span = 300.0, place = 1.5;

/// An absorber of 5 kg on a conductor of 1.6 kg/m under 28 kN, with its computer.
Parameters line(double differential_gain) {
  return {28e3, 1.628, 1e-3, 0.05, 5.0, 79e3, 126.0, 1e-3, 0.0, 0.0, differential_gain};
}

ConductorWithAbsorber conductor_of(const Parameters& x, int modes) {
  ConductorWithAbsorber conductor{
      string_modes(TautString<double>{x[0], x[1], span, x[2], 0.0}, place, modes),
      {x[4], x[5], x[6], x[3]},
      {},
      {},
      false};
  conductor.poles = plant_poles(conductor.modes, conductor.absorber);
  return conductor;
}

/// ρ − 1, from the largest root of sums over the poles in doubles.
double excess_of(const Parameters& x, int modes) {
  const auto response = modal_response<double>(conductor_of(x, modes), {x[7], x[8]});
  return std::abs(largest_loop_root(response, {x[9], x[10]})) - 1.0;
}

TEST(ProvedStringFamily, NoMemberContradictsIt) {
  test::Random random(44);
  constexpr int modes = 8;
  const StringFamily family(span, place, 0.0, modes);
  int stable = 0, unstable = 0;
  for (int draw = 0; draw < 16; ++draw) {
    Parameters middle = line(-random.log_uniform(5.0, 2000.0));
    middle[8] = draw % 2 == 0 ? 0.0 : random.uniform(0.0, 0.7) * middle[7];
    const StringFamily::Box box = test::box_about(middle, 0.01, 0.2, random);
    const auto proof = prove_family(family, box, {100}, [] {});
    if (proof.unstable_loop) {
      EXPECT_GT(excess_of(*proof.unstable_loop, modes), 0.0) << draw;
    }
    unstable += proof.verdict() == ProvedStability::unstable;
    if (proof.verdict() != ProvedStability::stable) continue;
    ++stable;
    for (int k = 0; k < 100; ++k)
      ASSERT_LT(excess_of(test::member_of(box, random), modes), 0.0) << "box " << draw;
  }
  EXPECT_GE(stable, 5);
  EXPECT_GE(stable + unstable, 14);
}

// From winter to summer a tension changes by half; six numbers are known to 5 per cent.
TEST(ProvedStringFamily, IsOfAYearAndSixUncertainNumbers) {
  const StringFamily family(span, place, 0.0, 20);
  StringFamily::Box box{line(-20.0), line(-20.0)};
  box.lowest[0] *= 0.8;
  box.highest[0] *= 1.2;
  for (const std::size_t k : {2U, 3U, 4U, 5U, 6U, 7U}) {
    box.lowest[k] *= 0.95;
    box.highest[k] *= 1.05;
  }
  EXPECT_EQ(prove_family(family, box, {8}, [] {}).verdict(), ProvedStability::stable);
}

/// Largest stable −D of a loop, by bisection of its largest root.
double edge_of(const Parameters& middle, int modes, double inside, double outside) {
  Parameters x = middle;
  for (int k = 0; k < 60; ++k) {
    x[10] = 0.5 * (inside + outside);
    (excess_of(x, modes) < 0.0 ? inside : outside) = x[10];
  }
  return inside;
}

TEST(ProvedStringFamily, ReachesTheEdgeAndNeverBeyond) {
  constexpr int modes = 12;
  const StringFamily family(span, place, 0.0, modes);
  const double edge = edge_of(line(0.0), modes, 0.0, -1e5);
  ASSERT_LT(edge, -10.0);
  StringFamily::Box box{line(0.99 * edge), line(0.0)};
  EXPECT_EQ(prove_family(family, box, {300}, [] {}).verdict(), ProvedStability::stable) << edge;
  box.lowest[10] = (1.0 + 1e-9) * edge;
  EXPECT_NE(prove_family(family, box, {100}, [] {}).verdict(), ProvedStability::stable);
}

TEST(ProvedStringFamily, SumsTheFrequenciesThatSamplesDoNotTellApart) {
  test::Random random(45);
  constexpr int modes = 6;
  const StringFamily family(span, place, 0.0, modes);
  for (int draw = 0; draw < 60; ++draw) {
    Parameters values = line(random.uniform(-500.0, 100.0));
    values[9] = random.uniform(-1e4, 1e4);
    // Slow samples: aliases among the modes, which the moments do not sum.
    if (draw % 3 == 0) values[7] = random.log_uniform(1e-3, 0.4);
    values[8] = draw % 2 == 0 ? 0.0 : random.uniform(0.0, 0.9) * values[7];
    test::expect_function_of(
        family, values, random.log_uniform(1e-3, pi<double>),
        loop_map(linear_plant(conductor_of(values, modes)), {values[7], values[8]}));
  }
}

TEST(ProvedStringFamily, RefusesBoxesThatHoldNoLoops) {
  EXPECT_THROW(StringFamily(300.0, 300.0, 0.0, 5), InvalidParameter);
  EXPECT_THROW(StringFamily(300.0, 1.5, 0.0, 0), InvalidParameter);
  StringFamily::Box box{line(-20.0), line(-20.0)};
  box.lowest[2] = 0.0;
  EXPECT_THROW(prove_family(StringFamily(span, place, 0.0, 3), box, {1}, [] {}), InvalidParameter);
}

}  // namespace
}  // namespace holdfast
