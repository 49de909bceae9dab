// The slowest computer that still serves is as slow in other units.

#include "holdfast/stability/design/max_delay.hpp"
#include "property/units_case.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

using test::UnitsCase;

MaxDelayOptions options_of(const test::LoopCase& drawn, double unit_of_time) {
  MaxDelayOptions options{drawn.excitation.frequency, drawn.gains.proportional};
  options.criterion = drawn.exact_hold != 0 ? DelayCriterion::stable : DelayCriterion::attenuates;
  options.delay_fraction = drawn.delay_share;
  options.shortest_period = 1e-4 * unit_of_time;
  options.longest_period = 0.5 * unit_of_time;
  options.search_ratio = 1.01;
  return options;
}

/// The share of the amplitude that the best stabilising D takes off at a period.
double attenuation(const test::LoopCase& drawn, double period) {
  const MaxDelayOptions options = options_of(drawn, 1.0);
  const auto offer = detail::delay_offer(drawn.plant, options, period);
  if (!offer.response) return std::numeric_limits<double>::infinity();
  const double p = options.proportional_gain;
  return 1.0 - offer.response->best_differential_gain(p, offer.stable).ratio_to_uncontrolled;
}

/// The search steps by what it sees, which rounding moves; its answers are one to a part in 10⁹, or
/// where attenuation ends so slowly that rounding decides, control takes off as little at both.
test::PropertyOutcome largest_period_scales(const UnitsCase& units) {
  const test::LoopCase rewritten = units.rewritten();
  const MaxDelay first = max_sampling_period(units.loop.plant, options_of(units.loop, 1.0));
  const MaxDelay other =
      max_sampling_period(rewritten.plant, options_of(rewritten, units.of_time()));
  const double found = other.sampling_period / units.of_time();
  if (other.outcome != first.outcome)
    return test::fails(test::differs("another outcome, period", found, first.sampling_period));
  if (first.outcome != MaxDelayOutcome::found || found == first.sampling_period)
    return test::holds();
  const double apart = std::abs(found / first.sampling_period - 1.0);
  if (!(apart <= 1e-9)) {
    const double most = std::max(std::abs(attenuation(units.loop, first.sampling_period)),
                                 std::abs(attenuation(units.loop, found)));
    if (most <= 1e-9) return test::holds();
    return test::fails(test::differs("period", found, first.sampling_period));
  }
  if (other.limit != first.limit) return test::fails("another limit");
  return test::holds();
}

TEST(UnitsOfSearch, LargestSamplingPeriodScales) {
  test::expect_property(121, 100, test::case_in_other_units, largest_period_scales);
}

}  // namespace
}  // namespace holdfast
