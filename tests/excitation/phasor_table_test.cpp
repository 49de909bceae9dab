#include "holdfast/excitation/phasor_table.hpp"

#include "support/kollar_case.hpp"
#include "support/random.hpp"
#include "support/reference/sample_excitation.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

TEST(UnitPhasor, IsTheCosineAndTheSine) {
  test::Random random(911);
  for (int k = 0; k < 100'000; ++k) {
    const double x = k < 100 ? k / 99.0 : random.unit();
    const auto turn = unit_phasor(x);
    const long double angle = 2.0L * pi<long double> * static_cast<long double>(x);
    ASSERT_NEAR(turn.cosine, static_cast<double>(std::cos(angle)), 3e-16) << x;
    ASSERT_NEAR(turn.sine, static_cast<double>(std::sin(angle)), 3e-16) << x;
  }
}

TEST(UnitPhasor, IsExactAtQuarters) {
  const double cosines[] = {1.0, 0.0, -1.0, 0.0, 1.0}, sines[] = {0.0, 1.0, 0.0, -1.0, 0.0};
  for (int quarter = 0; quarter <= 4; ++quarter) {
    const auto turn = unit_phasor(0.25 * quarter);
    EXPECT_EQ(turn.cosine, cosines[quarter]);
    EXPECT_EQ(turn.sine, sines[quarter]);
  }
}

TEST(PhasorTable, RoundsThePhaseOfALateSampleOnceOnly) {
  const test::KollarCase which;
  const auto input = held_harmonic(which.loop());
  const double frequency = 7.3, period = 0.0031;
  PhasorTable<double> table(input, {1.0, frequency}, period);
  for (const std::int64_t late : {16'000'000LL, 999'999'984LL, 999'999'990'000LL}) {
    const std::int64_t index = late / 16 * 16;
    table.turn_to(index);
    const auto expected = sample_excitation<double>({1.0, frequency}, period, index);
    EXPECT_NEAR(table.addition(0)[1] / input.cosine[1], expected.cosine, 2e-15) << index;
  }
}

}  // namespace
}  // namespace holdfast
