// Periodic orbits of a plant of another order than that of the two masses.

#include "holdfast/math/linalg/eigenvalues.hpp"
#include "holdfast/orbit/event/event_orbit_search.hpp"
#include "support/lagging_loop.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

template <class Plant>
auto orbit_from_rest(const ImplementedLoopOf<Plant>& loop) {
  const Eigen::Index order = loop.plant.state_matrix().rows();
  return find_event_orbit(event_motion(loop, StateOf<Plant>(StateOf<Plant>::Zero(order))));
}

void expect_same_multipliers(const std::vector<Multiplier>& first,
                             const std::vector<Multiplier>& second) {
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    if (std::isinf(first[i].log_modulus)) {
      EXPECT_EQ(first[i].log_modulus, second[i].log_modulus) << i;
    } else if (first[i].log_modulus > std::log(1e-6)) {
      EXPECT_NEAR(first[i].log_modulus, second[i].log_modulus, 1e-9) << i;
    }
  }
}

TEST(OrbitOfAnyOrder, OfFourThroughPortsIsThatOfTheTwoMasses) {
  for (const Switching switching : {Switching::sampled, Switching::exact}) {
    for (const double delay : {0.0, 0.001}) {
      const TwoMass<double> plant = kollar2022_plant();
      const auto masses = orbit_from_rest(test::lagging_loop(plant, switching, delay));
      const auto ported =
          orbit_from_rest(test::lagging_loop(test::through_ports(plant), switching, delay));
      ASSERT_EQ(masses.outcome, OrbitOutcome::certified);
      ASSERT_EQ(ported.outcome, OrbitOutcome::certified);
      ASSERT_EQ(ported.orbit->period_samples(), masses.orbit->period_samples());
      EXPECT_EQ(ported.orbit->modes, masses.orbit->modes);
      ASSERT_EQ(ported.orbit->switches.size(), masses.orbit->switches.size());
      const double size = masses.orbit->extent.displacement;
      EXPECT_LE((ported.orbit->states.front() - masses.orbit->states.front()).norm(), 1e-9 * size);
      EXPECT_NEAR(ported.orbit->amplitude(), masses.orbit->amplitude(), 1e-9 * size);
      EXPECT_NEAR(ported.orbit->largest_displacement, masses.orbit->largest_displacement,
                  1e-9 * size);
      if (switching == Switching::exact) {
        EXPECT_NEAR(ported.orbit->border_share(), masses.orbit->border_share(), 1e-9);
      }
      expect_same_multipliers(masses.orbit->multipliers, ported.orbit->multipliers);
    }
  }
}

/// The motion some samples after a point of it.
template <class Contact>
StroboscopicState<Contact> after_samples(const RepeatingMotion<Contact>& any,
                                         const StroboscopicState<Contact>& from,
                                         std::int64_t samples) {
  RepeatingMotion<Contact> motion = any;
  motion.go_to(from);
  for (std::int64_t j = 0; j < samples; ++j) {
    motion.sense();
    motion.advance();
  }
  return motion.point();
}

/// The largest |λ| of the map of [x; u_{j−1}] over a period, by central differences of motions from
/// a point at which the drive is engaged.
template <class Contact>
double largest_multiplier_by_differences(const RepeatingMotion<Contact>& motion,
                                         const StroboscopicState<Contact>& point,
                                         std::int64_t period,
                                         const Vector<double, Eigen::Dynamic>& sizes) {
  const Eigen::Index order = point.state.size();
  Eigen::MatrixXd map(order + 1, order + 1);
  for (Eigen::Index k = 0; k <= order; ++k) {
    Vector<double, Eigen::Dynamic> ends[2];
    const double step = 1e-5 * sizes[k];
    for (const int side : {0, 1}) {
      StroboscopicState<Contact> from = point;
      const double by = side == 0 ? step : -step;
      (k < order ? from.state[k] : from.previous_command) += by;
      const StroboscopicState<Contact> to = after_samples(motion, from, period);
      ends[side].resize(order + 1);
      ends[side] << to.state, to.previous_command;
    }
    map.col(k) = ((ends[0] - ends[1]) / (2.0 * step)).cwiseQuotient(sizes) * sizes[k];
  }
  double largest = 0.0;
  for (const std::complex<double>& value : eigenvalues(map))
    largest = std::max(largest, std::abs(value));
  return largest;
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

  Vector<double, Eigen::Dynamic> sizes = Vector<double, Eigen::Dynamic>::Zero(order + 1);
  for (const auto& state : orbit.states)
    sizes.head(order) = sizes.head(order).cwiseMax(state.cwiseAbs());
  for (const double force : orbit.forces) sizes[order] = std::max(sizes[order], std::abs(force));

  // Another motion, from another time on: sampling and forcing go on as they are.
  auto motion = event_motion(loop, found.point->state);
  motion.restore(0, found.point->state, found.point->previous_command, found.point->contact);
  for (std::int64_t j = 0; j < period; ++j) {
    motion.sense();
    motion.advance();
  }
  const double residual =
      (motion.state() - found.point->state).cwiseAbs().cwiseQuotient(sizes.head(order)).maxCoeff();
  EXPECT_LE(residual, 1e-9);

  const RepeatingMotion<DriveContact<Plant>> repeating(motion, 20);
  std::size_t engaged = 0;
  while (orbit.modes[engaged] != ContactMode::engaged ||
         orbit.modes[engaged + 1] != ContactMode::engaged)
    ++engaged;
  const auto point = after_samples(repeating, *found.point, static_cast<std::int64_t>(engaged) + 1);
  const double expected = largest_multiplier_by_differences(repeating, point, period, sizes);
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
