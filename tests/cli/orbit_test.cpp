#include "cli/program.hpp"

namespace holdfast::tests {
namespace {

using program::CsvTable;

const std::string slow = " --set control.sampling_period=0.011 --set backlash.width=0.002";
const std::string neighbour = " --set control.sampling_period=0.003 --set backlash.width=0.002";

TEST(OrbitJob, TheTraceClosesAndIsWhatSimulateComesTo) {
  const CsvTable trace = table_of("orbit --trace" + slow);
  ASSERT_EQ(trace.rows(), 2101U);
  for (const std::string column : {"z1_m", "v1_m_per_s", "z2_m", "v2_m_per_s", "control_force_N"})
    EXPECT_NEAR(trace.number(0, column), trace.number(2100, column), 1e-12) << column;
  // 976.8 s are 888 common periods of sampling and forcing, so that the phases agree.
  const CsvTable motion = table_of("simulate --duration 1000 --from 976.8" + slow);
  double nearest = 1.0;
  for (std::size_t row = 0; row < 2100; row += 100)
    nearest = std::min(nearest, std::abs(motion.number(row, "z1_m") - trace.number(0, "z1_m")) +
                                    std::abs(motion.number(row, "z2_m") - trace.number(0, "z2_m")));
  EXPECT_LE(nearest, 1e-9);
}

TEST(OrbitJob, ProvesWhatItCertifies) {
  const CsvTable proof = table_of("orbit --prove" + slow);
  const CsvTable certificate = table_of("orbit --certificate" + slow);
  EXPECT_EQ(value_of(proof, "period_samples"), 2100.0);
  EXPECT_GE(value_of(proof, "multiplier_bound"), value_of(certificate, "multiplier_1_modulus"));
  EXPECT_LT(value_of(proof, "multiplier_bound"), 1.0);
  EXPECT_GE(value_of(proof, "displacement_error"),
            value_of(certificate, "extended_precision_displacement_difference"));
  EXPECT_LT(value_of(proof, "displacement_error"), 1e-11);
  EXPECT_GE(value_of(proof, "attraction_radius"),
            0.99 * value_of(certificate, "capture_radius_smallest"));
  EXPECT_NEAR(value_of(proof, "nearest_decision"), value_of(certificate, "gap_distance"), 1e-11);
  EXPECT_GT(value_of(proof, "nearest_decided_by"), 1.0);
}

TEST(OrbitJob, ProvesAnOrbitThatSwitchesExactly) {
  const std::string exact = " --switching exact";
  const CsvTable proof = table_of("orbit --prove" + exact);
  const CsvTable certificate = table_of("orbit --certificate" + exact);
  EXPECT_EQ(value_of(proof, "period_samples"), value_of(certificate, "period_samples"));
  EXPECT_GE(value_of(proof, "multiplier_bound"), value_of(certificate, "multiplier_1_modulus"));
  EXPECT_LT(value_of(proof, "multiplier_bound"), 1.0);
  EXPECT_LT(value_of(proof, "displacement_error"), 1e-11);
  EXPECT_GT(value_of(proof, "attraction_radius"), value_of(proof, "displacement_error"));
  EXPECT_LT(value_of(proof, "attraction_radius"), 1e-4);
  EXPECT_GT(value_of(proof, "nearest_decided_by"), 1.0);
  // A belt that plays is the same law between the samples.
  const CsvTable play = table_of("orbit --prove --set backlash.law=play" + exact);
  EXPECT_EQ(value_of(play, "attraction_radius"), value_of(proof, "attraction_radius"));
}

TEST(OrbitJob, ProvesExactSwitchingOfAMovingGapAlone) {
  for (const std::string other : {"--set backlash.law=dead_zone", "--set control.jitter=1e-5",
                                  "--set control.displacement_quantum=1e-6"})
    expect_refused("orbit --prove --switching exact " + other, {"--prove"});
  expect_refused("orbit --prove --switching exact --follow backlash.width=0.0001:0.001",
                 {"--follow"});
}

/// The range of the proof ends where following the orbit finds its end, along the width as along a
/// gain.
TEST(OrbitJob, ProvesTheRangeOfAnOrbit) {
  const std::string loop = " --set control.sampling_period=0.01 --set backlash.width=0.002";
  const CsvTable ends = table_of("orbit --follow backlash.width=0.001:0.003" + loop);
  const CsvTable proof = table_of("orbit --prove" + loop);
  EXPECT_NEAR(value_of(proof, "backlash_width_from"), ends.number(0, "position"), 1e-10);
  EXPECT_NEAR(value_of(proof, "backlash_width_to"), ends.number(1, "position"), 1e-10);
  const std::string axis = "control.differential_gain=-14:-12";
  const CsvTable ranges = table_of("orbit --prove --follow " + axis + loop);
  const CsvTable along = table_of("orbit --follow " + axis + loop);
  double proved = 0.0;
  for (std::size_t row = 0; row < ranges.rows(); ++row)
    if (ranges.text(row, "outcome") == "proved")
      proved += ranges.number(row, "to") - ranges.number(row, "from");
  for (std::size_t row = 0; row < ranges.rows(); ++row)
    EXPECT_EQ(ranges.text(row, "outcome") == "proved", ranges.text(row, "reason").empty());
  // What a range does not show may be so in a part of it: the rows beside the proved one hold loops
  // that have the orbit.
  const CsvTable coarse = table_of("orbit --prove --follow backlash.width=0:0.004" + loop);
  const double from = value_of(proof, "backlash_width_from");
  for (std::size_t row = 0; row < coarse.rows(); ++row) {
    const bool is_proved = coarse.text(row, "outcome") == "proved";
    EXPECT_EQ(coarse.text(row, "outcome"), is_proved ? "proved" : "not_shown");
    EXPECT_GE(coarse.number(row, "from"), is_proved ? from : 0.0);
  }
  EXPECT_LE(proved, along.number(1, "position") - along.number(0, "position") + 1e-12);
  EXPECT_GE(proved, along.number(1, "position") - along.number(0, "position") - 0.02);
}

TEST(OrbitJob, FollowsTheOrbitToBothItsEnds) {
  const CsvTable table = table_of("orbit --follow backlash.width=0:0.01" + slow);
  ASSERT_EQ(table.rows(), 2U);
  EXPECT_EQ(table.text(0, "side"), "below");
  EXPECT_LT(table.number(0, "position"), 0.002);
  EXPECT_GT(table.number(1, "position"), 0.002);
  for (const std::size_t row : {0U, 1U}) EXPECT_EQ(table.text(row, "outcome"), "border_collision");
}

TEST(OrbitJob, TheBorderOverTwoKeysHoldsTheEndsAlongOne) {
  const CsvTable ends = table_of("orbit --follow backlash.width=0.001:0.003" + slow);
  const CsvTable border = table_of(
      "orbit --map backlash.width=0.0015:0.0025 --map control.differential_gain=-15:-10" + slow);
  double below = 0.0, above = 1.0, nearest = 1.0;
  for (std::size_t row = 0; row < border.rows(); ++row) {
    EXPECT_EQ(border.text(row, "border"), "border_collision");
    // The walk begins on the row of the case, to the right of it.
    const double height = std::abs(border.number(row, "control.differential_gain") + 13.0);
    if (height < nearest) above = border.number(row, "backlash.width");
    nearest = std::min(nearest, height);
    below = std::max(below, border.number(row, "backlash.width"));
  }
  EXPECT_LT(nearest, 0.01);
  EXPECT_GT(below, ends.number(1, "position"));
  EXPECT_NEAR(above, ends.number(above < 0.002 ? 0 : 1, "position"), 2e-6);
}

TEST(OrbitJob, AlongTheSamplingPeriodTheForceKeepsItsPhases) {
  const CsvTable border = table_of(
      "orbit --map control.sampling_period=0.0009:0.0012 --map backlash.width=0.0003:0.0007");
  double shortest = 1.0, longest = 0.0;
  for (std::size_t row = 0; row < border.rows(); ++row) {
    shortest = std::min(shortest, border.number(row, "control.sampling_period"));
    longest = std::max(longest, border.number(row, "control.sampling_period"));
  }
  EXPECT_LT(shortest, 0.99e-3);
  EXPECT_GT(longest, 1.01e-3);
  // Inside, away from the case, with the frequency that goes with the period.
  const CsvTable there = table_of(
      "orbit --certificate --set control.sampling_period=0.001005 --set "
      "excitation.frequency=9.950248756218906");
  EXPECT_EQ(value_of(there, "coincidence_samples"), 100.0);
}

TEST(OrbitJob, NamesTheBordersOfExactSwitching) {
  const CsvTable border = table_of(
      "orbit --switching exact --map backlash.width=0.0017:0.0019 --map "
      "control.differential_gain=-3:0 --set backlash.width=0.0018 --set "
      "control.differential_gain=-2.8");
  bool slides = false;
  for (std::size_t row = 0; row < border.rows(); ++row)
    slides = slides || border.text(row, "border") == "sliding";
  EXPECT_TRUE(slides);
}

TEST(BasinsJob, AMapKnowsTheLongPeriodOfTheIrregularMotion) {
  const CsvTable map = table_of(
      "basins --map backlash.width=0.001:0.002:2 --map control.sampling_period=0.01:0.011:2");
  ASSERT_EQ(map.rows(), 4U);
  EXPECT_EQ(map.number(3, "forcing_periods"), 231.0);
  EXPECT_EQ(map.number(2, "forcing_periods"), 3.0);
  EXPECT_EQ(map.number(1, "period_s"), 18.7);
  for (std::size_t row = 0; row < 4; ++row) {
    EXPECT_EQ(map.text(row, "outcome"), "certified");
    EXPECT_GE(map.number(row, "motions"), 1.0);
    EXPECT_LE(map.number(row, "least_forcing_periods"), map.number(row, "forcing_periods"));
  }
}

TEST(OrbitJob, SaysWhyThereIsNone) {
  expect_refused("orbit --set excitation.frequency=9.8765432101", {"never coincide"}, 1);
  expect_refused("orbit --max-period 50", {"coincide only every 100 samples"}, 1);
  expect_refused("orbit --max-period 1000" + slow, {"no periodic orbit"}, 1);
  expect_refused("orbit --set control.processing_delay=0.011" + slow, {"diverges"}, 1);
  expect_refused("orbit --set excitation.amplitude=0", {"touches a switching surface"}, 1);
}

TEST(OrbitJob, RefusesWhatItCannotFollow) {
  expect_refused("orbit --follow backlash.width", {"KEY=MIN:MAX"});
  const std::string map = "orbit --map backlash.width=0.0001:0.001 --map ";
  expect_refused("orbit --map backlash.width=0.0001:0.001", {"two keys, not 1"});
  expect_refused(map + "backlash.width=0.0001:0.001", {"both keys"});
  expect_refused(map + "control.differential_gain=-5:-1", {"must lie between"});
  expect_refused(map + "control.differential_gain=-13:-13", {"smaller"});
  expect_refused(map + "plant.absorber_mass=-1:1", {"plant.absorber_mass must be"});
  expect_refused("orbit --map control.sampling_period=0.0005:0.002 --map excitation.frequency=5:15",
                 {"cannot both be keys"});
  expect_refused(map + "control.differential_gain=-20:-1 --set backlash.law=immediate",
                 {"--switching exact"});
  const std::string cells = "basins --map backlash.width=0.001:0.002:2 --map ";
  expect_refused("basins --map backlash.width=0.001:0.002:2", {"two keys, not 1"});
  expect_refused(cells + "backlash.width=0.001:0.002:2", {"both keys"});
  expect_refused(cells + "control.sampling_period=-1:1:2", {"must be greater than 0 s"});
  expect_refused("orbit --follow backlash.width=0.001:0.002", {"must lie between"});
  expect_refused("orbit --follow control.sampling_period=0.0005:0.002",
                 {"changes the ratio of sampling and excitation period"});
  expect_refused("orbit --follow initial.z1=0:1", {"[plant]"});
  expect_refused("orbit --follow backlash.width=-1:1", {"must be"});
  expect_refused("orbit --follow backlash.width=0:1 --set backlash.width=0", {"without backlash"});
  expect_refused("orbit --follow backlash.widht=0:0.002", {"backlash.width"});
}

TEST(OrbitJob, RefusesWhatItCannotProve) {
  expect_refused("orbit --prove --set plant.model=string", {"--prove"});
  expect_refused("orbit --prove --certificate", {"--certificate"});
  expect_refused("orbit --prove --map backlash.width=0:1 --map plant.absorber_mass=0.1:0.2",
                 {"--map"});
  expect_refused("orbit --prove --follow plant.absorber_mass=0.15:0.17", {"with --prove"});
  expect_refused("orbit --prove --follow backlash.width=0:0.002 --set backlash.width=0",
                 {"without backlash"});
  expect_refused("orbit --prove --max-period 50", {"coincide only every 100 samples"}, 1);
  // Stick barely begins at a reversal.
  expect_refused(
      "orbit --quiet --prove --switching exact --set control.sampling_period=0.01 "
      "--set backlash.width=0.001 --set control.differential_gain=-4.66272076386",
      {"free_acceleration"}, 1);
}

TEST(BasinsJob, TellsTheTwoMotionsApartThatStartTenMicrometresApart) {
  const CsvTable table =
      table_of("basins --axis initial.z1=0:0.00001:2 --axis initial.v1=0:0:1" + neighbour);
  ASSERT_EQ(table.rows(), 2U);
  EXPECT_NEAR(table.number(0, "period_s"), 5.7, 1e-9);
  EXPECT_NEAR(table.number(1, "period_s"), 0.3, 1e-9);
  EXPECT_EQ(table.number(0, "attractor"), 1.0);
  EXPECT_EQ(table.number(1, "attractor"), 2.0);
}

TEST(BasinsJob, ResultsDoNotDependOnThreadsAndFractionsAddUp) {
  const std::string grid =
      " --axis initial.z1=-0.005:0.005:12 --axis initial.z2=-0.005:0.005:12" + neighbour;
  const Outcome one = run_holdfast("basins --threads 1" + grid);
  EXPECT_EQ(one.exit_code, 0) << one.errors;
  EXPECT_EQ(one.output, run_holdfast("basins --threads 2" + grid).output);
  const CsvTable fractions = table_of("basins --fractions" + grid);
  double sum = 0.0;
  for (std::size_t row = 0; row < fractions.rows(); ++row) {
    sum += fractions.number(row, "fraction");
    EXPECT_GE(fractions.number(row, "standard_error"), 0.0);
  }
  EXPECT_NEAR(sum, 1.0, 1e-12);
  EXPECT_GE(fractions.rows(), 2U);
}

TEST(BasinsJob, NumbersADivergingMotionZero) {
  const CsvTable table = table_of(
      "basins --axis initial.z1=0:0.001:2 --axis initial.z2=0:0.001:2 --set "
      "control.processing_delay=0.011" +
      slow);
  for (std::size_t row = 0; row < table.rows(); ++row)
    EXPECT_EQ(table.number(row, "attractor"), 0.0);
}

TEST(BasinsJob, RefusesOtherAxes) {
  expect_refused("basins", {"two keys"});
  expect_refused("basins --axis backlash.width=0:1:2 --axis initial.z1=0:1:2", {"initial.z1"});
  expect_refused("basins --axis initial.z1=0:1:2 --axis initial.z1=0:1:2", {"both keys"});
  expect_refused("basins --axis initial.z1=0:1:100000 --axis initial.z2=0:1:100000", {"more than"});
}

TEST(VerdictJob, SaysWhatTheMotionIsAndOnWhatThatRests) {
  const CsvTable slow_motion = table_of("verdict --quiet" + slow);
  EXPECT_EQ(slow_motion.text(0, "verdict"), "periodic(2100)");
  EXPECT_EQ(slow_motion.number(0, "certified"), 1.0);
  EXPECT_NE(slow_motion.text(0, "rests_on").find("Certified"), std::string::npos);
  EXPECT_EQ(table_of("verdict --set control.processing_delay=0.011" + slow).text(0, "verdict"),
            "diverges");
}

TEST(SectionJob, ItsPointsLieBetweenTheSamplesOfSimulate) {
  const CsvTable table = table_of("section --duration 2 --from 1" + slow);
  ASSERT_GT(table.rows(), 10U);
  for (std::size_t row = 0; row < table.rows(); ++row) EXPECT_GE(table.number(row, "time_s"), 1.0);
}

TEST(VerdictJob, SaysThatAnOrbitHasCopiesShiftedInTime) {
  const CsvTable orbit = table_of("orbit --quiet --set backlash.width=0.002");
  const double copies = orbit.number(0, "period_samples") / 100.0;  // 10 Hz at 1 ms
  ASSERT_GE(copies, 2.0);
  const std::string several = run_holdfast("verdict --set backlash.width=0.002").errors;
  expect_holds(several, {"has " + std::to_string(static_cast<int>(copies)) + " copies"});
  const std::string one = run_holdfast("verdict --set backlash.width=0").errors;
  EXPECT_EQ(one.find("copies"), std::string::npos) << one;
}

}  // namespace
}  // namespace holdfast::tests
