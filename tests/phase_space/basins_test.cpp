#include "holdfast/phase_space/basins.hpp"

#include "holdfast/control/controlled_plant.hpp"
#include "holdfast/phase_space/event_basins.hpp"
#include "holdfast/phase_space/modal_basins.hpp"
#include "support/kollar_case.hpp"
#include "support/random_states.hpp"

namespace holdfast {
namespace {

const OrbitLimits basin_limits{20000, 0};

constexpr auto one_after_the_other = [](std::size_t count, std::size_t tile, const auto& job) {
  for (std::size_t first = 0; first < count; first += tile)
    job(first, std::min(tile, count - first));
};

std::vector<Vector<double, 4>> basin_states(std::size_t count) {
  return test::random_states(871, count);
}

template <class Orbit>
struct AloneFound {
  OrbitOutcome outcome;
  std::optional<Orbit> orbit;
};

/// The sampled map.
struct PaperModel {
  using Orbit = PeriodicOrbit;
  static IdealLoop<double> loop(double period, double width, double delay_fraction = 0.0) {
    return test::kollar_loop(period, width, delay_fraction);
  }
  template <class Tiles>
  static BasinMap basins(const IdealLoop<double>& loop,
                         const std::vector<Vector<double, 4>>& states, const OrbitLimits& limits,
                         const Tiles& tiles) {
    return find_basins<double>(loop, states, limits, tiles);
  }
  static AloneFound<Orbit> alone(const IdealLoop<double>& loop, const Vector<double, 4>& state) {
    OrbitResult found = find_periodic_orbit(loop, state, basin_limits);
    return {found.outcome, std::move(found.orbit)};
  }
  static HarmonicExcitation<double>& harmonic(IdealLoop<double>& loop) { return loop.excitation; }
  static constexpr double widest_growing = 0.002;
};

/// The event-driven flow.
template <Switching switching>
struct EventModel {
  using Orbit = EventOrbit;
  static ImplementedLoop loop(double period, double width, double delay_fraction = 0.0) {
    ImplementedLoop loop = implemented_loop(test::kollar_loop(period, width, delay_fraction));
    loop.switching = switching;
    return loop;
  }
  template <class Tiles>
  static BasinsOf<EventOrbit> basins(const ImplementedLoop& loop,
                                     const std::vector<Vector<double, 4>>& states,
                                     const OrbitLimits& limits, const Tiles& tiles) {
    return find_basins(loop, states, limits, tiles);
  }
  static AloneFound<Orbit> alone(const ImplementedLoop& loop, const Vector<double, 4>& state) {
    auto found = find_event_orbit(event_motion(loop, state), basin_limits);
    return {found.outcome, std::move(found.orbit)};
  }
  static Harmonic& harmonic(ImplementedLoop& loop) { return loop.digital.force.harmonics.front(); }
  // With exact switching the stick phases of any backlash would hold the motion.
  static constexpr double widest_growing = switching == Switching::sampled ? 0.002 : 0.0;
};

/// That of exact switching in lanes.
struct EventLanesModel : EventModel<Switching::exact> {
  template <class Tiles>
  static BasinsOf<EventOrbit> basins(const ImplementedLoop& loop,
                                     const std::vector<Vector<double, 4>>& states,
                                     const OrbitLimits& limits, const Tiles& tiles) {
    return find_basins_by(run_on_lanes<double>, loop, states, limits, tiles);
  }
};

/// The same of a plant under a controller of its own, its order known at run time alone.
struct ControlledModel {
  using Loop = ImplementedLoopOf<ControlledPlant>;
  using Orbit = EventOrbitOf<Eigen::Dynamic>;
  static Loop loop(double period, double width, double delay_fraction = 0.0) {
    const ImplementedLoop of = implemented_loop(test::kollar_loop(period, width, delay_fraction));
    Loop own{with_controller(of.plant, of.digital.gains), of.digital, of.backlash, of.switching};
    own.digital.gains = {0.0, 0.0};
    return own;
  }
  static Vector<double, Eigen::Dynamic> state_of(const Vector<double, 4>& state) { return state; }
  template <class Tiles>
  static BasinsOf<Orbit> basins(const Loop& loop, const std::vector<Vector<double, 4>>& states,
                                const OrbitLimits& limits, const Tiles& tiles) {
    return find_basins(loop, states, limits, tiles, state_of);
  }
  static AloneFound<Orbit> alone(const Loop& loop, const Vector<double, 4>& state) {
    auto found = find_event_orbit(event_motion(loop, state_of(state)), basin_limits);
    return {found.outcome, std::move(found.orbit)};
  }
  static Harmonic& harmonic(Loop& loop) { return loop.digital.force.harmonics.front(); }
  static constexpr double widest_growing = 0.002;
};

/// The two masses as a conductor of one mode.
struct ModalModel {
  using Orbit = PeriodicOrbit;
  static ModalLoop loop(double period, double width, double delay_fraction = 0.0) {
    const IdealLoop<double> of = test::kollar_loop(period, width, delay_fraction);
    const TwoMass<double>& plant = of.plant;
    const double omega = std::sqrt(plant.conductor_stiffness / plant.conductor_mass);
    return {{{omega, plant.conductor_damping / (2.0 * omega * plant.conductor_mass), 1.0,
              plant.conductor_mass}},
            {plant.absorber_mass, plant.absorber_stiffness, plant.absorber_damping, 0.0},
            of.sampling,
            of.gains,
            of.excitation,
            of.backlash_width,
            of.hold};
  }
  template <class Tiles>
  static BasinMap basins(const ModalLoop& loop, const std::vector<Vector<double, 4>>& states,
                         const OrbitLimits& limits, const Tiles& tiles) {
    return find_basins(loop, states, limits, tiles);
  }
  static AloneFound<Orbit> alone(const ModalLoop& loop, const Vector<double, 4>& state) {
    OrbitResult found = find_periodic_orbit(loop, modal_state(loop.modes, state), basin_limits);
    return {found.outcome, std::move(found.orbit)};
  }
  static HarmonicExcitation<double>& harmonic(ModalLoop& loop) { return loop.excitation; }
  static constexpr double widest_growing = 0.002;
};

template <class Model>
class Basins : public testing::Test {
 protected:
  template <class Loop>
  static auto basins(const Loop& loop, const std::vector<Vector<double, 4>>& states,
                     const OrbitLimits& limits = basin_limits) {
    return Model::basins(loop, states, limits, one_after_the_other);
  }
};

using BasinModels = testing::Types<PaperModel, ModalModel, EventModel<Switching::sampled>,
                                   EventModel<Switching::exact>, EventLanesModel, ControlledModel>;
TYPED_TEST_SUITE(Basins, BasinModels, );

TYPED_TEST(Basins, EveryStateHasTheLabelThatItHasAlone) {
  auto loops = std::vector{TypeParam::loop(0.003, 0.002), TypeParam::loop(0.01, 0.002)};
  if (std::is_same_v<TypeParam, PaperModel>) {
    loops.push_back(TypeParam::loop(0.01, 0.002, 0.5));
    loops.push_back(TypeParam::loop(0.011, 0.002));
  }
  for (std::size_t which = 0; which < loops.size(); ++which) {
    const auto states = basin_states(40);
    const auto map = this->basins(loops[which], states);
    ASSERT_EQ(map.labels.size(), states.size());
    for (std::size_t k = 0; k < states.size(); ++k) {
      const auto alone = TypeParam::alone(loops[which], states[k]);
      ASSERT_EQ(map.labels[k].outcome, alone.outcome) << which << ' ' << k;
      if (alone.outcome != OrbitOutcome::certified) continue;
      const auto number = static_cast<std::size_t>(map.labels[k].attractor);
      EXPECT_TRUE(is_phase_shifted_copy(map.attractors.at(number).orbit, *alone.orbit))
          << which << ' ' << k;
    }
  }
}

TYPED_TEST(Basins, DoNotDependOnTheOrderOfTheTilesOrOnThreads) {
  const auto loop = TypeParam::loop(0.003, 0.002);
  const auto states = basin_states(150);
  const auto backwards = [](std::size_t count, std::size_t tile, const auto& job) {
    const std::size_t tiles = (count + tile - 1) / tile;
    for (std::size_t k = tiles; k-- > 0;) job(k * tile, std::min(tile, count - k * tile));
  };
  const auto threaded = [](std::size_t count, std::size_t tile, const auto& job) {
    std::atomic<std::size_t> next{0};
    std::vector<std::thread> threads;
    for (int k = 0; k < 3; ++k)
      threads.emplace_back([&] {
        for (std::size_t first = tile * next++; first < count; first = tile * next++)
          job(first, std::min(tile, count - first));
      });
    for (std::thread& thread : threads) thread.join();
  };
  const auto map = this->basins(loop, states);
  for (const auto& other : {TypeParam::basins(loop, states, basin_limits, backwards),
                            TypeParam::basins(loop, states, basin_limits, threaded)}) {
    ASSERT_EQ(map.attractors.size(), other.attractors.size());
    for (std::size_t k = 0; k < states.size(); ++k) {
      EXPECT_EQ(map.labels[k].outcome, other.labels[k].outcome);
      EXPECT_EQ(map.labels[k].attractor, other.labels[k].attractor);
    }
    for (std::size_t k = 0; k < map.attractors.size(); ++k)
      EXPECT_EQ(map.attractors[k].orbit.states, other.attractors[k].orbit.states);
  }
}

TYPED_TEST(Basins, OfAGrowingLoopAreEmpty) {
  for (const double width : {0.0, TypeParam::widest_growing}) {
    const auto map = this->basins(TypeParam::loop(0.011, width, 1.0), basin_states(30));
    EXPECT_TRUE(map.attractors.empty());
    for (const BasinLabel& label : map.labels) EXPECT_EQ(label.outcome, OrbitOutcome::diverges);
  }
}

TYPED_TEST(Basins, WithoutACommonPeriodThereAreNone) {
  auto loops = std::vector{TypeParam::loop(0.01, 0.002)};
  TypeParam::harmonic(loops[0]).frequency = 10.0 * std::sqrt(0.5);
  if constexpr (std::is_same_v<typename TypeParam::Orbit, EventOrbit>) {
    loops.push_back(TypeParam::loop(0.01, 0.002));
    loops[1].digital.jitter = {1e-4, 3};
  }
  for (const auto& loop : loops) {
    const auto map = this->basins(loop, basin_states(5));
    EXPECT_TRUE(map.attractors.empty());
    ASSERT_EQ(map.labels.size(), 5U);
    for (const BasinLabel& label : map.labels)
      EXPECT_EQ(label.outcome, OrbitOutcome::incommensurate);
  }
}

TYPED_TEST(Basins, WithoutBacklashOneOrbitTakesAll) {
  const auto map = this->basins(TypeParam::loop(0.01, 0.0), basin_states(100));
  ASSERT_EQ(map.attractors.size(), 1U);
  EXPECT_EQ(map.attractors[0].states, 100U);
  EXPECT_EQ(map.attractors[0].fraction, 1.0);
  EXPECT_GT(map.attractors[0].standard_error, 0.0);
  EXPECT_FALSE(map.attractors[0].mirror_image.has_value());
}

TYPED_TEST(Basins, OfACommonPeriodBeyondTheLargestAreNotFound) {
  const auto map = this->basins(TypeParam::loop(0.011, 0.002), basin_states(3), {99, 0});
  ASSERT_EQ(map.labels.size(), 3U);
  for (const BasinLabel& label : map.labels) EXPECT_EQ(label.outcome, OrbitOutcome::none_found);
}

TYPED_TEST(Basins, OfNoStatesAreEmpty) {
  const auto map = this->basins(TypeParam::loop(0.01, 0.002), {});
  EXPECT_TRUE(map.labels.empty());
  EXPECT_TRUE(map.attractors.empty());
}

TYPED_TEST(Basins, MayBeEndedByTheWatch) {
  OrbitLimits limits = basin_limits;
  limits.watch = [] { throw std::runtime_error("enough"); };
  EXPECT_THROW(this->basins(TypeParam::loop(0.01, 0.002), basin_states(3), limits),
               std::runtime_error);
}

TYPED_TEST(Basins, WhatIsOutOfRangeIsRefused) {
  auto states = basin_states(3);
  EXPECT_THROW(this->basins(TypeParam::loop(0.01, -0.002), states), InvalidParameter);
  EXPECT_THROW(this->basins(TypeParam::loop(0.01, 0.002), states, {0, 0}), InvalidParameter);
  states[1][3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(this->basins(TypeParam::loop(0.01, 0.002), states), InvalidParameter);
}

BasinMap paper_basins(const IdealLoop<double>& loop, const std::vector<Vector<double, 4>>& states,
                      const OrbitLimits& limits = basin_limits) {
  return PaperModel::basins(loop, states, limits, one_after_the_other);
}

TEST(BasinMap, FractionsAndErrorsAreThoseOfTheCounts) {
  const auto states = basin_states(200);
  const BasinMap map = paper_basins(test::kollar_loop(0.003, 0.002), states);
  EXPECT_GE(map.attractors.size(), 2U);
  std::size_t counted = 0;
  int highest = -1;
  for (const BasinLabel& label : map.labels) {
    EXPECT_EQ(label.outcome, OrbitOutcome::certified);
    EXPECT_LE(label.attractor, highest + 1) << "numbered as they are met";
    highest = std::max(highest, label.attractor);
  }
  EXPECT_EQ(highest + 1, static_cast<int>(map.attractors.size()));
  double fractions = 0.0;
  for (std::size_t number = 0; number < map.attractors.size(); ++number) {
    const auto& attractor = map.attractors[number];
    const auto members = std::count_if(
        map.labels.begin(), map.labels.end(),
        [&](const BasinLabel& label) { return label.attractor == static_cast<int>(number); });
    EXPECT_EQ(attractor.states, static_cast<std::size_t>(members));
    EXPECT_DOUBLE_EQ(attractor.fraction, static_cast<double>(members) / 200.0);
    const double variance = attractor.fraction * (1.0 - attractor.fraction) / 200.0;
    EXPECT_NEAR(attractor.standard_error, std::sqrt(variance), 0.02 * std::sqrt(variance) + 3e-3);
    counted += attractor.states;
    fractions += attractor.fraction;
    for (std::size_t earlier = 0; earlier < number; ++earlier)
      EXPECT_FALSE(is_phase_shifted_copy(attractor.orbit, map.attractors[earlier].orbit));
    if (attractor.mirror_image) {
      const auto image = static_cast<std::size_t>(*attractor.mirror_image);
      ASSERT_LT(image, number);
      EXPECT_TRUE(is_mirror_image(attractor.orbit, map.attractors[image].orbit));
    }
  }
  EXPECT_EQ(counted, 200U);
  EXPECT_NEAR(fractions, 1.0, 1e-12);
}

/// The same basins by another model of the same loop.
template <class Model>
void expect_the_basins_of_the_paper(double tolerance) {
  const auto states = basin_states(60);
  const BasinMap paper = paper_basins(test::kollar_loop(0.003, 0.002), states);
  const auto map =
      Model::basins(Model::loop(0.003, 0.002), states, basin_limits, one_after_the_other);
  ASSERT_GE(paper.attractors.size(), 2U);
  ASSERT_EQ(map.attractors.size(), paper.attractors.size());
  for (std::size_t k = 0; k < states.size(); ++k) {
    EXPECT_EQ(map.labels[k].outcome, paper.labels[k].outcome) << k;
    EXPECT_EQ(map.labels[k].attractor, paper.labels[k].attractor) << k;
  }
  for (std::size_t k = 0; k < map.attractors.size(); ++k) {
    const auto& found = map.attractors[k];
    const auto& expected = paper.attractors[k];
    EXPECT_EQ(found.orbit.period_samples(), expected.orbit.period_samples());
    EXPECT_NEAR(found.orbit.amplitude(), expected.orbit.amplitude(), tolerance);
    EXPECT_EQ(found.fraction, expected.fraction);
    EXPECT_EQ(found.standard_error, expected.standard_error);
    EXPECT_EQ(found.mirror_image, expected.mirror_image);
  }
}

TEST(BasinMap, OfSampledSwitchingIsThatOfTheModelOfThePaper) {
  expect_the_basins_of_the_paper<EventModel<Switching::sampled>>(1e-12);
  expect_the_basins_of_the_paper<ControlledModel>(1e-12);
}

TEST(BasinMap, OfOneModeIsThatOfItsTwoMasses) { expect_the_basins_of_the_paper<ModalModel>(1e-9); }

TEST(BasinMap, SaysWhatIsNotFoundInTime) {
  // One common period is no time for motions of 2100 samples.
  const BasinMap map = paper_basins(test::kollar_loop(0.011, 0.002), basin_states(40), {100, 100});
  int none_found = 0;
  for (const BasinLabel& label : map.labels) {
    if (label.outcome == OrbitOutcome::none_found) {
      EXPECT_EQ(label.attractor, -1);
      ++none_found;
      continue;
    }
    ASSERT_EQ(label.outcome, OrbitOutcome::certified);
    const auto number = static_cast<std::size_t>(label.attractor);
    EXPECT_EQ(map.attractors.at(number).orbit.period_samples(), 100);
  }
  EXPECT_GE(none_found, 8) << "those that are searched first";
  const auto built = implemented_loop(test::kollar_loop(0.011, 0.002));
  for (const BasinLabel& label :
       find_basins(built, basin_states(12), {100, 200}, one_after_the_other).labels) {
    EXPECT_NE(label.outcome, OrbitOutcome::certified) << "200 samples are too few to come anywhere";
    EXPECT_EQ(label.attractor, -1);
  }
}

}  // namespace
}  // namespace holdfast
