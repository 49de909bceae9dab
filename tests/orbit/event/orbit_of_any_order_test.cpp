// Periodic orbits of a plant of another order than that of the two masses.

#include "holdfast/orbit/event/event_orbit_search.hpp"
#include "orbit/event/return_differences.hpp"
#include "support/lagging_loop.hpp"

namespace holdfast {
namespace {

template <class Plant>
auto orbit_from_rest(const ImplementedLoopOf<Plant>& loop) {
  const Eigen::Index order = loop.plant.state_matrix().rows();
  return find_event_orbit(event_motion(loop, StateOf<Plant>(StateOf<Plant>::Zero(order))));
}

template <class Plant>
void expect_closes_with_multiplier(const ImplementedLoopOf<Plant>& loop) {
  const auto found = orbit_from_rest(loop);
  ASSERT_EQ(found.outcome, OrbitOutcome::certified);
  const auto& orbit = *found.orbit;
  const std::int64_t period = orbit.period_samples();
  const Eigen::Index order = orbit.states.front().size();
  ASSERT_EQ(period % 20, 0);
  EXPECT_GT(orbit.entries(ContactMode::gap), 0);
  EXPECT_GT(orbit.entries(ContactMode::engaged), 0);

  Vector<double, Eigen::Dynamic> sizes = Vector<double, Eigen::Dynamic>::Zero(order + 3);
  for (const auto& state : orbit.states)
    sizes.head(order) = sizes.head(order).cwiseMax(state.cwiseAbs());
  for (const double force : orbit.forces) sizes[order] = std::max(sizes[order], std::abs(force));
  sizes.tail(2).setConstant(orbit.extent.displacement);

  // Another motion, from another time on: sampling and forcing go on as they are.
  auto motion = event_motion(loop, found.point->state);
  motion.restore(0, found.point->state, found.point->previous_command, found.point->contact);
  test::move_samples(motion, period);
  const double residual =
      (motion.state() - found.point->state).cwiseAbs().cwiseQuotient(sizes.head(order)).maxCoeff();
  EXPECT_LE(residual, 1e-9);

  // From a point at which the drive is engaged.
  RepeatingMotion<DriveContact<Plant>> repeating(motion, 20);
  std::size_t engaged = 0;
  while (orbit.modes[engaged] != ContactMode::engaged ||
         orbit.modes[engaged + 1] != ContactMode::engaged)
    ++engaged;
  repeating.go_to(*found.point);
  test::move_samples(repeating, static_cast<std::int64_t>(engaged) + 1);
  const double expected =
      test::moduli_by_differences(repeating, repeating.point(), period, 1e-5 * sizes)[0];
  std::cout << "period " << period << ", residual " << residual << ", largest multiplier "
            << orbit.largest_multiplier() << ", by differences less "
            << expected - orbit.largest_multiplier() << "\n";
  EXPECT_NEAR(orbit.largest_multiplier(), expected, 1e-6 * expected);
  EXPECT_TRUE(orbit.is_attracting());
}

TEST(OrbitOfAnyOrder, OfSevenClosesAndHasTheMultiplierOfItsReturn) {
  for (const Switching switching : {Switching::sampled, Switching::exact})
    expect_closes_with_multiplier(test::lagging_loop(test::lagging_plant(), switching));
}

}  // namespace
}  // namespace holdfast
