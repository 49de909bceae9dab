// Kollár 2022, Table 1: the plant, its poles and natural frequencies, and Eq. (6) for it.

#include "holdfast/chaos/lyapunov_run.hpp"
#include "holdfast/control/gains.hpp"
#include "holdfast/motion/implemented_loop.hpp"
#include "holdfast/plant/two_mass.hpp"

#include "support/contacts.hpp"
#include "support/dense_routes.hpp"
#include "support/kollar_case.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

/// Poles in the upper half-plane, fastest decay first.
std::vector<std::complex<double>> upper_poles(const TwoMass<double>& plant) {
  std::vector<std::complex<double>> poles;
  for (const auto& pole : test::eigenvalues_of(plant.state_matrix())) {
    if (pole.imag() > 0) poles.push_back(pole);
  }
  std::sort(poles.begin(), poles.end(), [](auto a, auto b) { return a.real() < b.real(); });
  return poles;
}

TEST(Table1, HasTheStatedPoles) {
  const auto poles = upper_poles(kollar2022_plant());
  ASSERT_EQ(poles.size(), 2U);
  EXPECT_NEAR(poles[0].real(), -38.0078, 0.00005);
  EXPECT_NEAR(poles[0].imag(), 18.3331, 0.00005);
  EXPECT_NEAR(poles[1].real(), -1.08277, 0.000005);
  EXPECT_NEAR(poles[1].imag(), 13.0415, 0.00005);
}

TEST(Table1, HasTheNaturalFrequenciesThatItWasReducedFrom) {
  auto undamped = kollar2022_plant();
  undamped.conductor_damping = undamped.absorber_damping = 0.0;
  const auto poles = upper_poles(undamped);
  ASSERT_EQ(poles.size(), 2U);
  std::vector<double> frequencies = {poles[0].imag() / (2 * pi<double>),
                                     poles[1].imag() / (2 * pi<double>)};
  std::sort(frequencies.begin(), frequencies.end());
  EXPECT_NEAR(frequencies[0], 1.999, 0.0005);
  EXPECT_NEAR(frequencies[1], 6.998, 0.0005);
}

TEST(Table1, TheConductorAloneVibratesAtTheFrequencyOfFigure5) {
  const auto plant = kollar2022_plant();
  EXPECT_NEAR(std::sqrt(plant.conductor_stiffness / plant.conductor_mass) / (2 * pi<double>), 4.1,
              0.05);
}

TEST(Equation6, TunesTheProportionalGainToTheExcitation) {
  const auto plant = kollar2022_plant();
  const double gain = tuned_proportional_gain(plant.absorber_stiffness, plant.absorber_mass, 10.0);
  EXPECT_NEAR(gain, -557.25, 0.005);
  EXPECT_NEAR(gain, -557.0, 0.5) << "as the paper rounds it";
}

// Kollár 2022, Table 2: the Lyapunov exponents per sample.
//
// The trajectory has δ = 0. The paper's tangent maps are S and S* as printed in Eq. (14), which
// belong to δ = τ; the consistent tangent has the δ of the trajectory. The fifth exponent is −∞
// exactly, since S* has a row of zeros; the paper's −33.26 and −29.23 are logarithms of round-off.

constexpr double infinity = std::numeric_limits<double>::infinity();

Vector<double, 5> exponents(double period, double duration, bool printed_tangent) {
  const test::KollarCase which = test::kollar_case(period, 0.002);
  test::KollarCase tangent = which;
  if (printed_tangent) tangent.processing_delay = period;
  LyapunovObserver observer(tangent.loop(), which.gains);
  auto motion = which.motion();
  run_trajectory(motion, samples_within(duration, period), std::nullopt, observer);
  return observer.spectrum().exponents();
}

TEST(Table2, OneMillisecondWithThePrintedTangent) {
  const auto lambda = exponents(0.001, 10.0, true);
  EXPECT_NEAR(lambda[0], -0.0010, 0.00005);
  EXPECT_NEAR(lambda[1], -0.0014, 0.00005 + 0.01 * 0.0014);
  EXPECT_NEAR(lambda[2], -0.0476, 0.01 * 0.0476);
  // The paper's fourth is 2 % away from this one, more than it claims; these digits come from a
  // separate computation of the same model.
  EXPECT_NEAR(lambda[3], -0.0486, 0.00005);
  EXPECT_EQ(lambda[4], -infinity);
}

TEST(Table2, ElevenMillisecondsWithThePrintedTangent) {
  const auto lambda = exponents(0.011, 100.0, true);
  EXPECT_NEAR(lambda[0], -0.0140, 0.01 * 0.0140);
  EXPECT_NEAR(lambda[2], -0.1855, 0.01 * 0.1855);
  EXPECT_NEAR(lambda[3], -0.4789, 0.00005 + 0.001 * 0.4789);
  // −0.0148 in the paper, 1.4 % away: its motion of 100 s need not be the same to the last switch.
  EXPECT_NEAR(lambda[1], -0.0146, 0.00005);
  EXPECT_EQ(lambda[4], -infinity);
}

TEST(Table2, ElevenMillisecondsWithTheConsistentTangent) {
  const auto lambda = exponents(0.011, 100.0, false);
  EXPECT_NEAR(lambda[0], -0.0116, 0.00005);
  EXPECT_NEAR(lambda[1], -0.0119, 0.00005);
  EXPECT_NEAR(lambda[2], -0.3285, 0.00005);
  EXPECT_NEAR(lambda[3], -0.4580, 0.00005);
  EXPECT_EQ(lambda[4], -infinity);
}

TEST(Table2, NoExponentIsPositive) {
  for (const bool printed : {true, false}) {
    EXPECT_LT(exponents(0.001, 10.0, printed).maxCoeff(), 0.0);
    EXPECT_LT(exponents(0.011, 100.0, printed).maxCoeff(), 0.0);
  }
}

// What the instants of switching and the hold of the force make of the motions of Kollár 2022,
// §4.2: the largest |z₁| in the second half of three seconds from rest, and the modes of the drive.

struct SwitchingTableRow {
  double sampling_period, width, duration;  // s, m, s
  double held, sampled, exact;              // mm
};

constexpr std::array<SwitchingTableRow, 4> switching_table{{
    {0.001, 0.0005, 3.0, 0.699, 0.719, 0.6963},
    {0.001, 0.002, 3.0, 1.011, 0.969, 1.0029},
    {0.005, 0.001, 3.0, 0.652, 0.746, 0.7332},
    {0.011, 0.002, 3.003, 1.172, 1.299, 1.0089},
}};

ImplementedLoop table_loop(const SwitchingTableRow& row, ForceHold hold, Switching switching) {
  ImplementedLoop loop = implemented_loop(test::kollar_loop(row.sampling_period, row.width));
  loop.digital.hold = hold;
  loop.switching = switching;
  return loop;
}

/// Largest |z₁| (mm) at the samples of the second half.
double late_amplitude(const SwitchingTableRow& row, ForceHold hold, Switching switching) {
  auto motion = event_motion(table_loop(row, hold, switching), Vector<double, 4>::Zero());
  double largest = 0.0;
  run_trajectory(motion, samples_within(row.duration, row.sampling_period), std::nullopt,
                 [&](const MotionSample<double>& sample) {
                   if (not_before(sample.time, 0.5 * row.duration))
                     largest = std::max(largest, std::abs(sample.state[0]));
                 });
  return 1e3 * largest;
}

using ModeCounts = std::array<std::int64_t, 3>;  // engaged, gap, stick

/// How often each mode has begun by the samples that whole half cycles of the force end with.
std::vector<ModeCounts> modes_begun(const SwitchingTableRow& row) {
  const auto half_cycle = static_cast<std::int64_t>(std::lround(0.05 / row.sampling_period));
  EventMotion<> motion(table_loop(row, ForceHold::exact, Switching::exact).digital,
                       test::exact_backlash(kollar2022_plant(), row.width),
                       Vector<double, 4>::Zero());
  std::vector<ModeCounts> begun{motion.counts().entered};
  while (!not_before(motion.time(), row.duration)) {
    motion.sense();
    motion.advance();
    if (motion.index() % half_cycle == 0) begun.push_back(motion.counts().entered);
  }
  return begun;
}

TEST(SwitchingTable, LateAmplitudesAreTheStatedOnes) {
  for (const auto& row : switching_table) {
    SCOPED_TRACE(std::to_string(row.sampling_period) + " s, " + std::to_string(row.width) + " m");
    EXPECT_NEAR(late_amplitude(row, ForceHold::sampled, Switching::sampled), row.held, 0.0005);
    EXPECT_NEAR(late_amplitude(row, ForceHold::exact, Switching::sampled), row.sampled, 0.0005);
    EXPECT_NEAR(late_amplitude(row, ForceHold::exact, Switching::exact), row.exact, 0.00005);
  }
}

TEST(SwitchingTable, EveryHalfCycleHasOneStickOneGapAndOneEngagedPhase) {
  const std::vector<ModeCounts> begun = modes_begun(switching_table[0]);
  ASSERT_EQ(begun.size(), 61U);
  EXPECT_EQ(begun.back(), (ModeCounts{60, 60, 60}));
  for (std::size_t half = 31; half < begun.size(); ++half)
    for (std::size_t mode = 0; mode < 3; ++mode)
      EXPECT_EQ(begun[half][mode] - begun[half - 1][mode], 1) << "half cycle " << half;
}

}  // namespace
}  // namespace holdfast
