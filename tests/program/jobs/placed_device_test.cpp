#include "jobs/span/placement/placed_device.hpp"

#include "case/model/linear_loop.hpp"
#include "case/model/modal/conductor_modes.hpp"
#include "case/model/plant_of_case.hpp"
#include "case/model/span/span_loop.hpp"
#include "case/model/span/span_of_case.hpp"
#include "holdfast/span/end_response.hpp"
#include "jobs/span/aeolian_amplitudes.hpp"
#include "jobs/span/placement/absorber_demands.hpp"
#include "jobs/span/placement/stable_gains.hpp"
#include "program/case/case_text.hpp"
#include "support/drake_case.hpp"

#ifdef HOLDFAST_HAS_CERES

namespace holdfast::program {
namespace {

Case active_drake() { return tests::from_text(tests::drake_line + tests::drake_absorber); }

PlacementQuestion gains_for(const Axis& frequencies) {
  PlacementQuestion question;
  question.frequencies = frequencies;
  return question;
}

Case with_gains(Case the_case, double p, double d) {
  the_case.control.proportional_gain = p;
  the_case.control.differential_gain = d;
  return the_case;
}

TEST(PlacedAbsorber, IsStableAndNoPairOfAGridWithItsMarginIsBetter) {
  const Case before = active_drake();
  const PlacementQuestion question = gains_for({5.0, 60.0, 12});
  const PlacedDevice placed = placed_device(before, question);
  EXPECT_TRUE(placed.is_better);
  EXPECT_LT(placed.after, placed.before);
  const PdGains<double> found = gains_of(placed.the_case);
  EXPECT_TRUE(is_stable_span(placed.the_case));
  // By the roots themselves, where the search went by the unit circle.
  Case on_string = placed.the_case;
  on_string.plant.model = "string";
  EXPECT_LT(LinearLoop(on_string).radius(found), 1.0);

  const StableGains stable(before, question.margin);
  EXPECT_TRUE(stable.admits(found));
  const PlacementLevels levels(before, question);
  const GainWindow around = stable.around({1e9, 1e6});
  constexpr int count = 41;
  int admitted = 0;
  for (int i = 0; i < count; ++i)
    for (int k = 0; k < count; ++k) {
      const auto at = [](const Interval<double>& range, int n) {
        return range.lower + (range.upper - range.lower) * n / (count - 1.0);
      };
      const PdGains<double> gains{at(around.proportional, i), at(around.differential, k)};
      if (!stable.admits(gains)) continue;
      ++admitted;
      const auto there = levels.of(with_gains(before, gains.proportional, gains.differential));
      EXPECT_GT(*std::max_element(there.begin(), there.end()), 0.999 * placed.after)
          << gains.proportional << " " << gains.differential;
    }
  EXPECT_GT(admitted, 300);
}

TEST(PlacedAbsorber, OfAnUnstableCaseBeginsWithoutControl) {
  const Case unstable = with_gains(active_drake(), 3000.0, -900.0);
  ASSERT_FALSE(is_stable_span(unstable));
  const PlacementQuestion question = gains_for({10.0, 30.0, 5});
  const PlacedDevice placed = placed_device(unstable, question);
  EXPECT_TRUE(std::isnan(placed.before));
  EXPECT_TRUE(is_stable_span(placed.the_case));
  EXPECT_NE(placement_warnings(placed, question).front().find("unstable"), std::string::npos);
}

TEST(StableGains, AreThoseOfTheRoots) {
  Case the_case = active_drake();
  the_case.plant.model = "string";
  const StableGains stable(the_case, 0.0);
  const LinearLoop loop(the_case);
  int inside = 0;
  for (const double p : {-40000.0, -10000.0, 0.0, 5000.0})
    // At P = 5000 D ends near -40, where the number of modes that are looked at decides.
    for (const double d : {-200.0, -30.0, 30.0, 90.0}) {
      const bool is_stable = loop.radius({p, d}) < 1.0;
      inside += is_stable ? 1 : 0;
      EXPECT_EQ(stable.is_stable({p, d}), is_stable) << p << " " << d;
    }
  EXPECT_GT(inside, 2);
  EXPECT_LT(inside, 14);
}

TEST(StableGains, AlongALineEndWhereTheMarginDoes) {
  const StableGains stable(active_drake(), 0.5);
  for (const double p : {-6000.0, 0.0, 4000.0}) {
    const auto intervals = stable.along(FreeGain::differential, {p, 0.0});
    ASSERT_EQ(intervals.size(), 1U);
    const auto [lower, upper] = intervals.front();
    EXPECT_TRUE(stable.admits({p, lower + 1e-6}) && stable.admits({p, upper - 1e-6}));
    EXPECT_FALSE(stable.admits({p, lower - 1e-6}) || stable.admits({p, upper + 1e-6}));
    const auto back = stable.along(FreeGain::proportional, {0.0, 0.5 * (lower + upper)});
    EXPECT_TRUE(
        std::any_of(back.begin(), back.end(), [&](const auto& one) { return one.contains(p); }));
  }
}

/// What the conductor gives and the drive gives goes into the absorber's damper.
TEST(AbsorberDemands, PowersBalance) {
  const Case the_case = with_gains(active_drake(), -9000.0, 60.0);
  const AeolianBalance balance(the_case, true);
  const auto devices = span_devices_of(the_case);
  for (const double frequency : {8.0, 20.0, 45.0}) {
    const double omega = 2.0 * pi<double> * frequency;
    const SpanEnd end = span_ends(devices, 300.0)[0];
    const EndResponse response = end_response(string_of(the_case), end, omega);
    const double speed =
        omega * response.motions[0] * balance.largest(frequency).amplitude.amplitude;
    const double of_conductor = 0.5 * devices[0].impedance({0.0, omega}).real() * speed * speed;
    const AbsorberDemands demands = absorber_demands(the_case, {frequency}, frequency);
    const double slip = omega * demands.largest_stroke;
    const double damped = 0.5 * the_case.plant.absorber_damping * slip * slip;
    EXPECT_NEAR(of_conductor + demands.drive_power, damped, 1e-9 * damped) << frequency;
    const double command =
        std::abs(std::complex<double>(60.0, 9000.0 / omega)) * speed;  // |D + P/(iω)| |v|
    EXPECT_NEAR(demands.largest_force, command, 1e-9 * command);
  }
}

TEST(AeolianBalance, LargestIsTheLargestOfItsRows) {
  const Case the_case = with_gains(active_drake(), -9000.0, 60.0);
  const AeolianBalance balance(the_case, true);
  const auto devices = span_devices_of(the_case);
  const TautString<double> string = string_of(the_case);
  for (const double frequency : {6.0, 18.0, 50.0}) {
    double amplitude = 0.0, strain = 0.0;
    for (const AeolianRow& row : balance.rows(frequency)) {
      amplitude = std::max(amplitude, row.damped.amplitude.amplitude);
      strain = std::max(strain, row.damped.strain);
    }
    EXPECT_EQ(balance.largest(frequency).amplitude.amplitude, amplitude);
    EXPECT_EQ(balance.largest(frequency).strain, strain);
    const auto ends = span_ends(devices, 300.0);
    const double omega = 2.0 * pi<double> * frequency;
    const Vibration known =
        LargestVibration(the_case, {1.0, frequency})
            .at(1, {end_response(string, ends[0], omega), end_response(string, ends[1], omega)});
    EXPECT_NEAR(known.strain, strain, 1e-11 * strain);
  }
}

}  // namespace
}  // namespace holdfast::program

#endif
