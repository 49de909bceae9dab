#include "holdfast/chaos/sampled_classification.hpp"
#include "holdfast/plant/two_mass.hpp"

#include <gtest/gtest.h>

#include <string>

#include "support/kollar_case.hpp"

namespace holdfast {
namespace {

ForcedLoop<double> judged_loop(double period, double delay, double width, double frequency) {
  return {kollar2022_plant(), {period, delay}, {-557.0, -13.0}, {0.5, frequency}, width};
}

MotionVerdict from_rest(const ForcedLoop<double>& loop) {
  return classify_motion(loop, Vector<double, 4>::Zero());
}

TEST(MotionVerdict, TheIrregularMotionOfThePaperIsPeriodic) {
  const MotionVerdict found = from_rest(judged_loop(0.011, 0.0, 0.002, 10.0));
  EXPECT_EQ(found.verdict.kind, MotionKind::periodic);
  EXPECT_EQ(found.verdict.period, 2100);
  EXPECT_TRUE(found.evidence.certified_period.has_value());
  EXPECT_NE(found.verdict.rests_on.find("Certified"), std::string::npos);
}

TEST(MotionVerdict, TheLinearLoopFollowsItsForcing) {
  const MotionVerdict found = from_rest(judged_loop(0.01, 0.0, 0.0, 10.0));
  EXPECT_EQ(found.verdict.kind, MotionKind::periodic);
  EXPECT_EQ(found.verdict.period, 10);
}

TEST(MotionVerdict, ADelayOfAWholePeriodDiverges) {
  EXPECT_EQ(from_rest(judged_loop(0.011, 0.011, 0.002, 10.0)).verdict.kind, MotionKind::diverges);
}

TEST(MotionVerdict, AnIncommensurateForcingOfAStableLinearLoopIsQuasiPeriodic) {
  const MotionVerdict found = from_rest(judged_loop(0.011, 0.0, 0.0, 9.8765432101));
  EXPECT_EQ(found.search.outcome, OrbitOutcome::incommensurate);
  EXPECT_EQ(found.verdict.kind, MotionKind::quasi_periodic);
}

TEST(MotionVerdict, AnIncommensurateForcingWithBacklashIsNeverCalledPeriodicByCertificate) {
  const MotionVerdict found = from_rest(judged_loop(0.011, 0.0, 0.002, 9.8765432101));
  EXPECT_FALSE(found.evidence.certified_period.has_value());
  EXPECT_NE(found.verdict.kind, MotionKind::chaotic);
  ASSERT_TRUE(found.evidence.largest_exponent.has_value());
  EXPECT_TRUE(found.evidence.largest_exponent->negative());
}

}  // namespace
}  // namespace holdfast
