// The laws of the loop have no direction: z → −z under F → −F mirrors the motion, to the last bit.

#include "holdfast/excitation/recorded_force.hpp"
#include "holdfast/motion/implemented_loop.hpp"
#include "property/loop_case.hpp"

namespace holdfast {
namespace {

using test::LoopCase;
using test::Random;

constexpr ContactLaw all_laws[] = {ContactLaw::kollar, ContactLaw::immediate, ContactLaw::play,
                                   ContactLaw::dead_zone, ContactLaw::none};

/// A loop under a force that is recorded, so that its sign can be turned.
struct MirrorCase {
  LoopCase loop;
  int law = 0;              // index of all_laws
  int exact_switching = 0;  // 1: the drive switches between the samples
  double stop_stiffness = 0.0, stop_damping = 0.0;
  double quantum = 0.0;  // of the displacement
  int held_rows = 0;     // 1: the record holds its rows
  int rows_per_cycle = 4;

  std::vector<test::Parameter> parameters() {
    std::vector<test::Parameter> all = loop.parameters();
    all.insert(all.end(), {{"law", &law},
                           {"exact switching", &exact_switching},
                           {"kc (N/m)", &stop_stiffness},
                           {"cc (N s/m)", &stop_damping},
                           {"quantum (m)", &quantum},
                           {"held rows", &held_rows},
                           {"rows per cycle", &rows_per_cycle, 2.0}});
    return all;
  }

  MultiHarmonicForce force(double sign) const {
    std::vector<double> times, forces;
    const double row_time = 1.0 / (loop.excitation.frequency * rows_per_cycle);
    const double end = loop.samples * loop.period;
    // A force much faster than the samples is not worth its rows: the last one holds to the end.
    for (int row = 0; row < 200 && row * row_time < end; ++row) {
      times.push_back(row * row_time);
      forces.push_back(sign * loop.excitation.amplitude *
                       std::cos(2.0 * pi<double> * row / rows_per_cycle + 0.1 * row));
    }
    times.push_back(end + row_time);
    forces.push_back(0.0);
    const auto between = held_rows != 0 ? RecordInterpolation::held : RecordInterpolation::linear;
    return {{}, std::make_shared<const RecordedForce>(times, forces, between)};
  }

  ImplementedLoop implemented_loop(double sign) const {
    ImplementedLoop result{loop.plant, {loop.sampling(), loop.gains, force(sign), loop.hold()}};
    result.digital.limits.displacement_quantum = quantum;
    result.backlash = {all_laws[law], loop.width, stop_stiffness, stop_damping};
    result.switching = exact_switching != 0 ? Switching::exact : Switching::sampled;
    return result;
  }
};

MirrorCase random_mirror_case(Random& random, bool exact_switching) {
  MirrorCase drawn;
  drawn.loop = test::random_loop_case(random);
  drawn.law = static_cast<int>(random.index(exact_switching ? 4 : 5));
  drawn.exact_switching = exact_switching ? 1 : 0;
  if (random.unit() < 0.5) {
    drawn.stop_stiffness = drawn.loop.plant.absorber_stiffness * random.log_uniform(0.1, 10.0);
    drawn.stop_damping = drawn.loop.plant.absorber_damping * random.unit();
  }
  if (random.unit() < 0.3) drawn.quantum = drawn.loop.width * random.log_uniform(0.01, 1.0);
  drawn.held_rows = static_cast<int>(random.index(2));
  drawn.rows_per_cycle = 2 + static_cast<int>(random.index(8));
  return drawn;
}

struct MirroredSample {
  Vector<double, 4> state;
  double control_force;
  ContactMode mode;
};

std::vector<MirroredSample> motion_of(const MirrorCase& drawn, double sign) {
  std::vector<MirroredSample> result;
  result.reserve(static_cast<std::size_t>(drawn.loop.samples));
  auto motion = event_motion(drawn.implemented_loop(sign), sign * drawn.loop.state);
  for (int j = 0; j < drawn.loop.samples && test::is_moderate(motion.state()); ++j) {
    const EventSample sample = motion.sense();
    result.push_back({sample.state, sample.control_force, sample.mode});
    motion.advance();
    // Changes of contact without end are not followed: from there on no motion is to be trusted.
    if (motion.counts().accumulates) break;
  }
  return result;
}

test::PropertyOutcome mirrors(const MirrorCase& drawn) {
  const auto there = motion_of(drawn, 1.0), mirrored = motion_of(drawn, -1.0);
  if (there.size() != mirrored.size()) return test::fails("one of the motions ends earlier");
  for (std::size_t j = 0; j < there.size(); ++j) {
    const MirroredSample &a = there[j], &b = mirrored[j];
    if (a.state == -b.state && a.control_force == -b.control_force && a.mode == b.mode) continue;
    const std::string where = "mirrored sample " + std::to_string(j) + ", " + word_for(b.mode) +
                              " beside " + word_for(a.mode) + ", z1";
    return test::fails(test::differs(where, b.state[0], -a.state[0]));
  }
  return test::holds();
}

TEST(Mirror, TurnsAMotionThatSwitchesAtSamplesToTheLastBit) {
  test::expect_property(
      501, 1000, [](Random& random) { return random_mirror_case(random, false); }, mirrors);
}

TEST(Mirror, TurnsAMotionThatSwitchesExactlyToTheLastBit) {
  test::expect_property(
      502, 300, [](Random& random) { return random_mirror_case(random, true); }, mirrors);
}

}  // namespace
}  // namespace holdfast
