#include "holdfast/phase_space/orbit_diagram.hpp"

#include "holdfast/cable/taut_string.hpp"
#include "holdfast/motion/ideal_loop.hpp"
#include "support/kollar_case.hpp"
#include "support/lagging_plant.hpp"
#include "support/message_of.hpp"
#include "support/reference/state_between_samples.hpp"
#include "support/string_case.hpp"

namespace holdfast {
namespace {

/// z₁ of the strobes of one value and way, rounded to a nanometre.
std::set<long> levels(const std::vector<StrobePoint>& points, std::size_t index, bool upward) {
  std::set<long> result;
  for (const StrobePoint& point : points)
    if (point.index == index && point.upward == upward)
      result.insert(std::lround(point.state[0] * 1e9));
  return result;
}

/// The diagram of one loop for each width.
template <class Change>
std::vector<StrobePoint> diagram_of(double period, const std::vector<double>& widths,
                                    const DiagramOptions& options, const Change& change) {
  std::vector<StrobePoint> points;
  const auto path = [&](double width) {
    ImplementedLoop loop = implemented_loop(test::kollar_loop(period, width));
    change(loop);
    return loop;
  };
  run_orbit_diagram(path, widths, Vector<double, 4>::Zero(), options,
                    [&](const StrobePoint& point) { points.push_back(point); });
  return points;
}

std::vector<StrobePoint> diagram_of(double period, const std::vector<double>& widths,
                                    const DiagramOptions& options) {
  return diagram_of(period, widths, options, [](ImplementedLoop&) {});
}

TEST(OrbitDiagram, ShowsAsManyLevelsAsTheOrbitHasForcingPeriods) {
  const auto points = diagram_of(0.001, {0.0, 0.0005, 0.002}, {40.0, 30});
  EXPECT_EQ(points.size(), 2U * 3U * 30U);
  const auto exactly = [](ImplementedLoop& loop) { loop.switching = Switching::exact; };
  const auto exact = diagram_of(0.001, {0.0, 0.0005}, {40.0, 30}, exactly);
  EXPECT_EQ(exact.size(), 2U * 2U * 30U);
  for (const bool upward : {true, false}) {
    for (const std::size_t index : {std::size_t{0}, std::size_t{1}}) {
      EXPECT_EQ(levels(points, index, upward).size(), 1U);
      EXPECT_EQ(levels(exact, index, upward).size(), 1U);
    }
    EXPECT_EQ(levels(points, 2, upward).size(), 5U);
  }
}

/// The strobes of one motion by the sampled map and matrix exponentials between its samples.
std::vector<Vector<double, 4>> strobes_of(const IdealLoop<double>& loop,
                                          const DiagramOptions& options,
                                          const Vector<double, 4>& initial_state) {
  std::vector<Vector<double, 4>> strobes;
  auto motion = harmonically_forced_motion(loop, initial_state);
  const auto first = static_cast<int>(std::ceil(options.transient * loop.excitation.frequency));
  const double period = loop.sampling.period;
  while (static_cast<int>(strobes.size()) < options.strobes) {
    const double before = motion.memory().previous_force;
    const auto sample = motion.sense();
    const auto due = [&] {
      const auto next = static_cast<double>(first + static_cast<int>(strobes.size()));
      return std::max(next / loop.excitation.frequency - sample.time, 0.0);
    };
    while (due() < period * (1.0 - 1e-9) && static_cast<int>(strobes.size()) < options.strobes)
      strobes.push_back(test::state_between_samples(loop, sample, before, due()));
    motion.advance();
  }
  return strobes;
}

TEST(OrbitDiagram, StrobesAreThoseOfMatrixExponentials) {
  for (const double period : {0.001, 0.009}) {
    const std::vector<double> widths{0.0, 0.0005, 0.001};
    const DiagramOptions options{20.0, 20};
    const auto points = diagram_of(period, widths, options);
    ASSERT_EQ(points.size(), 2U * 3U * 20U);
    Vector<double, 4> state = Vector<double, 4>::Zero();
    for (std::size_t k = 0; k < points.size();) {
      const auto expected =
          strobes_of(test::kollar_loop(period, widths[points[k].index]), options, state);
      state = points[k + expected.size() - 1].state;
      for (const auto& strobe : expected) {
        EXPECT_LE((points[k].state - strobe).cwiseAbs().maxCoeff(), 1e-11) << k;
        ++k;
      }
    }
  }
}

TEST(OrbitDiagram, StrobesBetweenJitteringSamplesAreThoseOfTheResponse) {
  // Without control the samples are of no effect, wherever they fall: the strobes of the steady
  // response to an exactly integrated force are all one.
  const auto points = diagram_of(0.009, {0.0}, {60.0, 30}, [](ImplementedLoop& loop) {
    loop.digital.gains = {0.0, 0.0};
    loop.digital.hold = ForceHold::exact;
    loop.digital.jitter = {0.004, 7};
  });
  ASSERT_EQ(points.size(), 2U * 30U);
  const double size = points.front().state.cwiseAbs().maxCoeff();
  ASSERT_GT(size, 1e-4);
  for (const StrobePoint& point : points)
    EXPECT_LE((point.state - points.front().state).cwiseAbs().maxCoeff(), 1e-11 * size);
}

TEST(OrbitDiagram, StrobesAreAtThePeriodsOfTheFirstHarmonic) {
  // 10 Hz and 5 Hz: once every period of the second the motion repeats, so that strobes at those
  // of the first come in two levels, and the other way round in one.
  for (const bool slower_first : {false, true}) {
    const auto points = diagram_of(0.001, {0.0}, {60.0, 20}, [&](ImplementedLoop& loop) {
      const Harmonic slower{0.3, 5.0, 1.0};
      auto& harmonics = loop.digital.force.harmonics;
      harmonics.insert(slower_first ? harmonics.begin() : harmonics.end(), slower);
    });
    EXPECT_EQ(levels(points, 0, true).size(), slower_first ? 1U : 2U);
  }
}

TEST(OrbitDiagram, AMotionThatDivergesShowsNothingAndTheNextBeginsAnew) {
  for (const Switching switching : {Switching::sampled, Switching::exact}) {
    std::vector<StrobePoint> points;
    const auto path = [&](double delay) {
      ImplementedLoop loop = implemented_loop(test::kollar_loop(0.011, 0.0));
      loop.digital.sampling.processing_delay = delay;
      loop.switching = switching;
      return loop;
    };
    run_orbit_diagram(path, {0.011, 0.0}, Vector<double, 4>::Zero(), {60.0, 5},
                      [&](const StrobePoint& point) { points.push_back(point); });
    EXPECT_EQ(points.size(), 10U);
    for (const StrobePoint& point : points) EXPECT_EQ(point.index, 1U);
  }
}

TEST(OrbitDiagram, WatchesABuiltLoop) {
  int looks = 0;
  DiagramOptions options{40.0, 1};
  options.watch = [&] { ++looks; };
  diagram_of(0.001, {0.0}, options);
  EXPECT_EQ(looks, 2 * 3) << "at samples 0, 16384 and 32768 of each way";
}

TEST(OrbitDiagram, RefusesALoopWithoutAHarmonic) {
  const auto built = [] {
    diagram_of(0.001, {0.0}, {1.0, 1},
               [](ImplementedLoop& loop) { loop.digital.force.harmonics.clear(); });
  };
  EXPECT_NE(tests::message_of<InvalidParameter>(built).find("number of harmonics"),
            std::string::npos);
}

TEST(OrbitDiagram, RefusesWhatIsNotAdmissible) {
  EXPECT_THROW(validate(DiagramOptions{-1.0, 5}), InvalidParameter);
  EXPECT_THROW(validate(DiagramOptions{1.0, 0}), InvalidParameter);
}

/// What begins where another loop ended begins anew where the order of the plant is another.
TEST(OrbitDiagram, OfAnotherOrderBeginsAtTheInitialState) {
  const auto path = [](double order) {
    const IdealLoop<double> of = test::kollar_loop(0.001, 0.0005);
    const LinearPlant<double> plant =
        order == 4.0 ? test::through_ports(of.plant) : test::lagging_plant(1e6, 1e6);
    return implemented_loop(IdealLoop<double, LinearPlant<double>>{
        plant, of.sampling, of.gains, of.excitation, of.backlash_width});
  };
  const auto begin = [](double order) -> Vector<double, Eigen::Dynamic> {
    return Vector<double, Eigen::Dynamic>::Constant(static_cast<Eigen::Index>(order), 1e-3);
  };
  const auto points_of = [&](const std::vector<double>& orders) {
    std::vector<StrobePoint> points;
    run_orbit_diagram(path, orders, begin, {0.1, 3},
                      [&](const StrobePoint& point) { points.push_back(point); });
    return points;
  };
  const auto both = points_of({4.0, 7.0}), alone = points_of({7.0});
  ASSERT_EQ(both.size(), 12U);
  ASSERT_EQ(alone.size(), 6U);
  for (std::size_t k = 0; k < 6; ++k) EXPECT_EQ(both[3 + k].state, alone[k].state) << k;
  EXPECT_EQ(both[9].state, both[0].state) << "back at the first order";
  EXPECT_NE(both[6].state, both[3].state) << "of the same order it goes on";
}

/// Most strobes fall between the samples; the modes are more at one of the values.
TEST(OrbitDiagram, OfAConductorByItsModesIsThatOfTheDensePlant) {
  const auto string = taut_string(kollar2022_conductor());
  const auto loop_at = [&](double width) {
    return ModalLoop{string_modes(string, 0.64, width > 4e-4 ? 6 : 5),
                     test::papers_absorber(0.01),
                     {0.009, 0.004},
                     {-557.0, -2.0},
                     {0.5, 10.0},
                     width,
                     ForceHold::exact};
  };
  const auto dense_at = [&](double width) {
    const ModalLoop loop = loop_at(width);
    return implemented_loop(IdealLoop<double, LinearPlant<double>>{
        modal_plant(loop.modes, loop.absorber), loop.sampling, loop.gains, loop.excitation,
        loop.backlash_width, loop.hold});
  };
  std::vector<StrobePoint> found;
  const DiagramOptions options{3.0, 7};
  const std::vector<double> widths{1e-4, 3e-4};
  const ModalMotion::Full rest = ModalMotion::Full::Zero(12);
  EXPECT_EQ(run_orbit_diagram(loop_at, widths, rest, options,
                              [&](const StrobePoint& point) { found.push_back(point); }),
            0U);
  std::size_t next = 0;
  run_orbit_diagram(dense_at, widths, rest, options, [&](const StrobePoint& point) {
    ASSERT_LT(next, found.size());
    EXPECT_EQ(found[next].index, point.index);
    EXPECT_EQ(found[next].upward, point.upward);
    EXPECT_LE((found[next++].state - point.state).cwiseAbs().maxCoeff(), 1e-10);
  });
  EXPECT_EQ(next, found.size());
  // Of a value with a mode more the motion goes on with the slower ones.
  found.clear();
  run_orbit_diagram(loop_at, {3e-4, 5e-4}, rest, options,
                    [&](const StrobePoint& point) { found.push_back(point); });
  EXPECT_EQ(found.size(), 28U);
}

}  // namespace
}  // namespace holdfast
