// The backlash where its gap is nothing, next to nothing, or so wide that it is never crossed.

#include "holdfast/contact/contact_law.hpp"
#include "property/loop_case.hpp"

namespace holdfast {
namespace {

using test::LoopCase;

using Samples = std::vector<MotionSample<double>>;

template <class Law>
SampledMotion<double, Law> motion_under(const LoopCase& drawn, const PdGains<double>& gains,
                                        const Law& law) {
  const SampledLoop<double> loop = sampled_loop(drawn.plant, drawn.sampling());
  const HarmonicInput<double> input =
      harmonic_input(drawn.plant, loop, drawn.hold(), drawn.excitation.angular_frequency());
  return {loop, gains, input, drawn.excitation, law, drawn.state};
}

template <class Law>
Samples samples_under(const LoopCase& drawn, const Law& law,
                      std::optional<PdGains<double>> gains = std::nullopt) {
  Samples result;
  result.reserve(static_cast<std::size_t>(drawn.samples));
  auto motion = motion_under(drawn, gains.value_or(drawn.gains), law);
  for (int j = 0; j < drawn.samples && test::is_moderate(motion.state()); ++j) {
    result.push_back(motion.sense());
    motion.advance();
  }
  return result;
}

test::PropertyOutcome same_samples(const std::string& law, const Samples& found,
                                   const Samples& expected) {
  if (found.size() != expected.size()) return test::fails(law + ": another length");
  for (std::size_t j = 0; j < found.size(); ++j) {
    if (test::same_sample(found[j], expected[j])) continue;
    return test::fails(test::differs(law + ", sample " + std::to_string(j) + ", z1",
                                     found[j].state[0], expected[j].state[0]));
  }
  return test::holds();
}

test::PropertyOutcome no_gap_is_no_backlash(const LoopCase& drawn) {
  const Samples expected = samples_under(drawn, NoBacklash<double>());
  return test::all_of(
      {same_samples("kollar", samples_under(drawn, Backlash<double>(0.0)), expected),
       same_samples("immediate", samples_under(drawn, ImmediateBacklash<double>(0.0)), expected),
       same_samples("play", samples_under(drawn, PlayBacklash<double>(0.0)), expected),
       same_samples("dead zone", samples_under(drawn, DeadZone<double>(0.0)), expected)});
}

TEST(GapLimits, WithoutAGapEveryLawTransmitsAlways) {
  test::expect_property(401, 2000, test::random_loop_case, no_gap_is_no_backlash);
}

double displacement_of(const MotionSample<double>& sample) {
  return relative_displacement(sample.state);
}

/// Whether Δz moves by more than `width` from each sample to the next and is never that near to 0.
bool strides_over(const Samples& samples, double width) {
  for (std::size_t j = 0; j < samples.size(); ++j) {
    const double here = displacement_of(samples[j]);
    if (!(std::abs(here) > width)) return false;
    if (j > 0 && !(std::abs(here - displacement_of(samples[j - 1])) > width)) return false;
  }
  return true;
}

/// Play and dead zone with a gap that is stepped over are without effect.
test::PropertyOutcome narrow_gap_is_none(const LoopCase& drawn) {
  const Samples expected = samples_under(drawn, NoBacklash<double>());
  if (!strides_over(expected, drawn.width)) return test::does_not_apply();
  return test::all_of(
      {same_samples("play", samples_under(drawn, PlayBacklash<double>(drawn.width)), expected),
       same_samples("dead zone", samples_under(drawn, DeadZone<double>(drawn.width)), expected)});
}

LoopCase random_case_with_narrow_gap(test::Random& random) {
  LoopCase drawn = test::random_loop_case(random);
  drawn.width *= random.log_uniform(1e-9, 1e-6);
  return drawn;
}

TEST(GapLimits, PlayAndDeadZoneTendToNoBacklash) {
  test::expect_property(402, 2000, random_case_with_narrow_gap, narrow_gap_is_none, 0.5);
}

/// Kollár's rule does not: however narrow the gap, each reversal costs the force of one sample, and
/// with entry only after exit the sample after it transmits whatever Δż does.
template <class Law>
test::PropertyOutcome reversals_cost_a_sample(const std::string& law, const LoopCase& drawn,
                                              bool only_after_exit) {
  const Samples samples = samples_under(drawn, Law(drawn.width));
  if (!strides_over(samples, drawn.width)) return test::does_not_apply();
  bool transmitted = true;
  for (std::size_t j = 1; j < samples.size(); ++j) {
    const double before = relative_velocity(samples[j - 1].state);
    const double now = relative_velocity(samples[j].state);
    const bool reverses = (before > 0.0 && now <= 0.0) || (before < 0.0 && now >= 0.0);
    const bool is_lost = reverses && (transmitted || !only_after_exit);
    if (samples[j].engaged == is_lost)
      return test::fails(law + ", sample " + std::to_string(j) + " transmits as it should not");
    transmitted = samples[j].engaged;
  }
  return test::holds();
}

TEST(GapLimits, HoweverNarrowTheGapOfKollarsRuleAReversalCostsASample) {
  test::expect_property(
      403, 2000, random_case_with_narrow_gap,
      [](const LoopCase& drawn) {
        return test::all_of(
            {reversals_cost_a_sample<Backlash<double>>("kollar", drawn, true),
             reversals_cost_a_sample<ImmediateBacklash<double>>("immediate", drawn, false)});
      },
      0.5);
}

/// The widest gap there is; its far end is never seen.
constexpr double widest = 1e300;

/// Follows a motion and, whenever it enters its gap, the uncontrolled motion from there: they are
/// one until Δz comes back past the end at which it turned.
template <class Law>
test::PropertyOutcome wide_gap_leaves_no_control(const std::string& law, const LoopCase& drawn,
                                                 int& entries) {
  auto motion = motion_under(drawn, drawn.gains, Law(widest));
  auto alone = motion_under(drawn, {0.0, 0.0}, Backlash<double>(0.0));
  bool engaged = true;
  double turned_at = 0.0, turned_from = 0.0, velocity_before = 0.0;
  for (int j = 0; j < drawn.samples && test::is_moderate(motion.state()); ++j) {
    const auto memory = motion.memory();
    const auto forcing = motion.forcing();
    const auto sample = motion.sense();
    const double here = displacement_of(sample);
    const std::string where = law + ", sample " + std::to_string(j);
    if (!sample.engaged && engaged) {
      ++entries;
      turned_at = here;
      turned_from = velocity_before;
      alone = {motion.loop(), {0.0, 0.0}, forcing, Backlash<double>(0.0), sample.state};
      const auto nothing = alone.memory().backlash;
      alone.restore(decltype(alone.memory()){sample.state, memory.previous_force, nothing});
    }
    if (sample.engaged && !engaged && !(turned_from > 0.0 ? here > turned_at : here < turned_at))
      return test::fails(
          test::differs(where + " leaves the gap by the far end, dz", here, turned_at));
    engaged = sample.engaged;
    velocity_before = relative_velocity(sample.state);
    if (!engaged) {
      if (alone.state() != sample.state || sample.control_force != 0.0)
        return test::fails(test::differs(where + ", z1", sample.state[0], alone.state()[0]));
      alone.sense();
      alone.advance();
    }
    motion.advance();
  }
  return test::holds();
}

TEST(GapLimits, InAGapThatIsNotCrossedTheMotionIsThatWithoutControl) {
  const auto draws = test::property_draws(2000);
  int entries = 0;
  const auto tally = test::for_all(404, draws, test::random_loop_case, [&](const LoopCase& drawn) {
    return wide_gap_leaves_no_control<Backlash<double>>("kollar", drawn, entries);
  });
  EXPECT_EQ(tally.held, draws);
  EXPECT_GT(entries, draws / 2);
}

test::PropertyOutcome all_wide_gaps_are_one(const LoopCase& drawn) {
  const Samples kollar = samples_under(drawn, Backlash<double>(widest));
  const Samples immediate = samples_under(drawn, ImmediateBacklash<double>(widest));
  const auto span = [](const Samples& samples) {
    double largest = 0.0;
    for (const auto& sample : samples)
      largest = std::max(largest, std::abs(displacement_of(sample)));
    return 4.0 * largest;
  };
  const Samples alone = samples_under(drawn, NoBacklash<double>(), PdGains<double>{0.0, 0.0});
  Samples idle = samples_under(drawn, DeadZone<double>(widest));
  for (auto& sample : idle) {
    if (sample.engaged) return test::fails("the dead zone transmits in its gap");
    sample.engaged = true;  // as NoBacklash calls it
  }
  return test::all_of(
      {same_samples("kollar", samples_under(drawn, Backlash<double>(span(kollar))), kollar),
       same_samples("immediate", samples_under(drawn, ImmediateBacklash<double>(span(immediate))),
                    immediate),
       same_samples("dead zone", idle, alone)});
}

TEST(GapLimits, AllGapsThatAreNotCrossedAreOne) {
  test::expect_property(405, 2000, test::random_loop_case, all_wide_gaps_are_one);
}

}  // namespace
}  // namespace holdfast
