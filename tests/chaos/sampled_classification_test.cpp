#include "holdfast/chaos/sampled_classification.hpp"
#include "holdfast/plant/two_mass.hpp"

#include <gtest/gtest.h>

#include <string>

#include "support/kollar_case.hpp"

namespace holdfast {
namespace {

IdealLoop<double> classified_loop(double period, double delay, double width, double frequency) {
  return {kollar2022_plant(), {period, delay}, {-557.0, -13.0}, {0.5, frequency}, width};
}

SampledClassification from_rest(const IdealLoop<double>& loop) {
  return classify_motion(loop, Vector<double, 4>::Zero());
}

TEST(SampledClassification, TheIrregularMotionOfThePaperIsPeriodic) {
  const SampledClassification found = from_rest(classified_loop(0.011, 0.0, 0.002, 10.0));
  EXPECT_EQ(found.classification.kind, AttractorType::periodic);
  EXPECT_EQ(found.classification.period, 2100);
  EXPECT_TRUE(found.indicators.certified_period.has_value());
  EXPECT_NE(found.classification.rests_on.find("Certified"), std::string::npos);
}

TEST(SampledClassification, TheLinearLoopFollowsItsForcing) {
  const SampledClassification found = from_rest(classified_loop(0.01, 0.0, 0.0, 10.0));
  EXPECT_EQ(found.classification.kind, AttractorType::periodic);
  EXPECT_EQ(found.classification.period, 10);
}

TEST(SampledClassification, ADelayOfAWholePeriodDiverges) {
  EXPECT_EQ(from_rest(classified_loop(0.011, 0.011, 0.002, 10.0)).classification.kind,
            AttractorType::diverges);
}

TEST(SampledClassification, AnIncommensurateForcingOfAStableLinearLoopIsQuasiPeriodic) {
  const SampledClassification found = from_rest(classified_loop(0.011, 0.0, 0.0, 9.8765432101));
  EXPECT_EQ(found.search.outcome, OrbitOutcome::incommensurate);
  EXPECT_EQ(found.classification.kind, AttractorType::quasi_periodic);
}

TEST(SampledClassification, AnIncommensurateForcingWithBacklashIsNeverCalledPeriodicByCertificate) {
  const SampledClassification found = from_rest(classified_loop(0.011, 0.0, 0.002, 9.8765432101));
  EXPECT_FALSE(found.indicators.certified_period.has_value());
  EXPECT_NE(found.classification.kind, AttractorType::chaotic);
  ASSERT_TRUE(found.indicators.largest_exponent.has_value());
  EXPECT_TRUE(found.indicators.largest_exponent->negative());
}

}  // namespace
}  // namespace holdfast
