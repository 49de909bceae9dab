#include "report/switching/switching_page.hpp"

#include "case/case_file.hpp"
#include "case/model/loop_of_case.hpp"
#include "holdfast/motion/observers.hpp"
#include "holdfast/motion/trajectory.hpp"
#include "process/errors.hpp"
#include "support/reference/state_between_samples.hpp"

namespace holdfast::program {
namespace {

StudiedLoop loop_of_paper(double sampling_period, double backlash_width, std::size_t reading) {
  Case the_case = load_case({}, {});
  the_case.control.sampling_period = sampling_period;
  the_case.backlash.width = backlash_width;
  return {the_case, readings[reading], 3.0};
}

/// Largest |z₁| of the samples of the second half, by the motions themselves.
double largest_of_samples(const StudiedLoop& studied) {
  const Case& the_case = studied.the_case;
  PhaseExtent extent(0.5 * studied.duration);
  const std::int64_t samples = samples_within(studied.duration, the_case.control.sampling_period);
  if (studied.reading.switching == Switching::sampled) {
    IdealLoop<double> loop = ideal_loop_of(the_case);
    loop.hold = studied.reading.hold;
    auto motion = harmonically_forced_motion(loop, initial_state_of(the_case));
    run_trajectory(motion, samples, {}, extent);
  } else {
    ImplementedLoop loop = implemented_loop_of(the_case, Switching::exact);
    loop.digital.hold = studied.reading.hold;
    auto motion = event_motion(loop, initial_state_of(the_case));
    run_trajectory(motion, samples, {}, extent);
  }
  return extent.displacement();
}

TEST(SwitchingPage, LooksForTheLargestSampleAsTheMotionsShowIt) {
  for (const double width : {0.0, 0.0005, 0.002}) {
    for (std::size_t k = 0; k < 3; ++k) {
      const StudiedLoop studied = loop_of_paper(0.004, width, k);
      const double expected = largest_of_samples(studied);
      EXPECT_NEAR(steady_motion(studied).largest_of_samples, expected, 1e-9 * expected);
    }
  }
}

// With the state by matrix exponentials, 200 instants a sample miss a peak of curvature ω² z₁ by
// (ω τ/400)²/2 of it, and no more.
TEST(SwitchingPage, SeesThePeaksBetweenTheSamples) {
  const StudiedLoop studied = loop_of_paper(0.011, 0.002, sampled_and_held);
  const IdealLoop<double> loop = ideal_loop_of(studied.the_case);
  auto motion = harmonically_forced_motion(loop, initial_state_of(studied.the_case));
  double previous_force = 0.0, largest = 0.0;
  while (motion.time() < studied.duration - 0.011) {
    const MotionSample<double> sample = motion.sense();
    for (int part = 0; sample.time >= 0.5 * studied.duration && part <= 200; ++part) {
      const double after = 0.011 * part / 200.0;
      const auto state = test::state_between_samples(loop, sample, previous_force, after);
      largest = std::max(largest, std::abs(state[0]));
    }
    previous_force = sample.control_force;
    motion.advance();
  }
  const SteadyMotion steady = steady_motion(studied);
  EXPECT_NEAR(steady.largest_displacement, largest, 1e-4 * largest);
  EXPECT_GT(steady.largest_displacement, 1.02 * steady.largest_of_samples);
}

TEST(SwitchingPage, CountsOnePhaseOfEachKindInAHalfCycleOfExactSwitching) {
  const StudiedLoop exact = loop_of_paper(0.001, 0.0005, exact_switching);
  for (const double phases : steady_motion(exact).phases_per_half_cycle)
    EXPECT_NEAR(phases, 1.0, 1e-12);
  const StudiedLoop sampled = loop_of_paper(0.001, 0.0005, sampled_and_held);
  const auto flicker = steady_motion(sampled).phases_per_half_cycle;
  EXPECT_GT(flicker[static_cast<std::size_t>(ContactMode::gap)], 1.5);
  EXPECT_EQ(flicker[static_cast<std::size_t>(ContactMode::stick)], 0.0);
}

/// The instants at which phases of a mode begin inside a window.
std::vector<double> beginnings(const MotionWindow& window, ContactMode mode) {
  std::vector<double> instants;
  for (std::size_t k = 1; k < window.phases.size(); ++k)
    if (window.phases[k].mode == mode) instants.push_back(window.phases[k].begin);
  return instants;
}

TEST(SwitchingPage, ShowsTheInstantsOfFig8) {
  const StudiedLoop studied = loop_of_paper(0.001, 0.0005, sampled_and_held);
  const auto window = window_of(studied, 9.05, 9.11, 0);
  const auto in = beginnings(window, ContactMode::gap);
  const auto out = beginnings(window, ContactMode::engaged);
  ASSERT_EQ(in.size(), 2U);
  ASSERT_EQ(out.size(), 2U);
  EXPECT_NEAR(in[0], 9.065, 1e-9);
  EXPECT_NEAR(out[0], 9.068, 1e-9);
  EXPECT_NEAR(in[1], 9.069, 1e-9);
  EXPECT_NEAR(out[1], 9.095, 1e-9);
}

ContactMode mode_at(const MotionWindow& window, double time) {
  const auto phase = std::find_if(window.phases.begin(), window.phases.end(),
                                  [time](const auto& part) { return time < part.end; });
  return phase == window.phases.end() ? window.phases.back().mode : phase->mode;
}

void expect_law_of_the_modes(const MotionWindow& window, const InstantOfMotion& now) {
  switch (mode_at(window, now.time)) {
    case ContactMode::engaged:
      EXPECT_EQ(now.transmitted, now.command);
      break;
    case ContactMode::gap:
      EXPECT_EQ(now.transmitted, 0.0);
      break;
    case ContactMode::stick:
      EXPECT_NEAR(relative_velocity(now.state), 0.0, 1e-12);
      EXPECT_GE(now.transmitted / now.command, -1e-9);
      EXPECT_LE(now.transmitted / now.command, 1.0 + 1e-9);
  }
}

TEST(SwitchingPage, ShowsThePhasesOfTheExactMotionWithoutSpaceBetweenThem) {
  const StudiedLoop studied = loop_of_paper(0.001, 0.0005, exact_switching);
  const auto window = window_of(studied, 9.05, 9.11, 1201);
  ASSERT_EQ(window.instants.size(), 1201U);
  EXPECT_EQ(window.phases.front().begin, 9.05);
  EXPECT_EQ(window.phases.back().end, 9.11);
  for (std::size_t k = 1; k < window.phases.size(); ++k) {
    EXPECT_NEAR(window.phases[k].begin, window.phases[k - 1].end, 1e-12);
    EXPECT_NE(window.phases[k].mode, window.phases[k - 1].mode);
  }
  EXPECT_EQ(beginnings(window, ContactMode::stick).size(), 1U);
  // An instant that falls on a change of contact has both modes.
  for (const auto& now : window.instants) {
    const bool at_change =
        std::any_of(window.phases.begin(), window.phases.end(),
                    [&](const auto& phase) { return std::abs(phase.begin - now.time) < 1e-9; });
    if (!at_change) expect_law_of_the_modes(window, now);
  }
}

// MODEL.md, section 6: 2100 samples, 231 forcing periods.
TEST(SwitchingPage, AnswersWhetherTheLongPeriodSurvivesExactSwitching) {
  const auto sampled = period_of(loop_of_paper(0.011, 0.002, sampled_and_held));
  EXPECT_EQ(sampled.samples, 2100);
  EXPECT_EQ(sampled.forcing_periods, 231);
  EXPECT_NEAR(sampled.seconds, 23.1, 1e-9);
  const StudiedLoop loop = loop_of_paper(0.011, 0.002, exact_switching);
  const auto exact = period_of(loop);
  // f τ = 11/100: no orbit is shorter than 100 samples.
  EXPECT_EQ(shortest_period(loop), 100);
  EXPECT_EQ(exact.samples, 100);
  EXPECT_LT(exact.largest_multiplier, 1.0);
}

TEST(SwitchingPage, SaysWhyThereIsNoPeriod) {
  StudiedLoop studied = loop_of_paper(0.011, 0.0005, sampled_and_held);
  studied.the_case.control.processing_delay = 0.011;
  const auto none = period_of(studied);
  EXPECT_EQ(none.samples, 0);
  EXPECT_NE(none.verdict.find("diverges"), std::string::npos);
  EXPECT_TRUE(steady_motion({studied.the_case, studied.reading, 20.0}).diverges);
  EXPECT_THROW(window_of(studied, 9.05, 9.11, 0), NoAnswer);
}

StudiedMotion made_motion(std::size_t reading, double amplitude, std::int64_t forcing_periods) {
  StudiedMotion motion{loop_of_paper(0.001, 0.0005, reading), {}, {}};
  motion.steady.largest_displacement = motion.steady.largest_of_samples = amplitude;
  motion.period.verdict = "periodic";
  motion.period.forcing_periods = forcing_periods;
  motion.period.samples = 100 * forcing_periods;
  motion.period.seconds = 0.1 * static_cast<double>(forcing_periods);
  motion.period.largest_multiplier = 0.5;
  return motion;
}

std::string lead_of(double held, double sampled, double exact, std::int64_t sampled_periods,
                    std::int64_t exact_periods) {
  return switching_lead({made_motion(sampled_and_held, held, sampled_periods),
                         made_motion(sampled_switching, sampled, sampled_periods),
                         made_motion(exact_switching, exact, exact_periods)});
}

void expect_in(const std::string& text, const std::vector<std::string>& parts) {
  for (const std::string& part : parts)
    EXPECT_NE(text.find(part), std::string::npos) << part << "\nis not in\n" << text;
}

TEST(SwitchingPage, LeadsWithWhatTheSwitchingChanges) {
  expect_in(lead_of(0.9e-3, 1.25e-3, 1e-3, 5, 1),
            {"changes the steady amplitude by +25 %", "1.25 mm for 1 mm",
             "makes the period 5 forcing periods (0.5 s) where it is 1 forcing period (0.1 s)",
             "0.9 mm (−10 %)"});
  expect_in(lead_of(1e-3, 1e-3, 1e-3, 3, 3),
            {"does not change the steady amplitude", "leaves the period as it is, 3 forcing"});
  expect_in(lead_of(1e-3, 1e-3, 1e-3, 0, 3), {"At samples no certified periodic orbit is found"});
  expect_in(lead_of(1e-3, 1e-3, 1e-3, 3, 0), {"with exact switching no certified periodic orbit"});
  expect_in(lead_of(0.0, 0.0, 0.0, 1, 1), {"comes to rest"});
}

TEST(SwitchingPage, CountsTheShortestPeriods) {
  const std::string text = subharmonics_text({made_motion(sampled_and_held, 1e-3, 7),
                                              made_motion(sampled_switching, 1e-3, 1),
                                              made_motion(exact_switching, 1e-3, 1)});
  expect_in(text, {"With exact switching 1 of the 1", "1 of the 1 with the exact force",
                   "0 of the 1 with the force held", "has 7 forcing periods (0.7 s)",
                   "with exact switching it is 1 forcing period (0.1 s)"});
}

TEST(SwitchingPage, NamesBothSwitchings) {
  SwitchingPage page;
  page.of_case = {made_motion(sampled_and_held, 1e-3, 2), made_motion(sampled_switching, 1.1e-3, 2),
                  made_motion(exact_switching, 1e-3, 1)};
  page.laws = {page.of_case[1], page.of_case[2]};
  page.laws[0].loop.the_case.backlash.law = "play";
  const std::string html = html_of(page);
  expect_in(html,
            {"id=\"switching\"", "How much the sampled switching matters",
             "<td>at samples</td><td>held</td>", "<td>at samples</td><td>exact</td>",
             "<td>exact</td><td>exact</td>", "+10 %", "<td>play</td>", "data/switching-case.csv"});
  EXPECT_EQ(html.find("switching-paper"), std::string::npos);
}

}  // namespace
}  // namespace holdfast::program
