// The slowest computer on a conductor by its modes, against the link by link search of a plant of
// any order.

#include "holdfast/stability/design/max_delay.hpp"

#include "holdfast/cable/taut_string.hpp"
#include "support/string_case.hpp"

namespace holdfast::test {
namespace {

ConductorWithAbsorber string_with(int modes, double clamp_mass) {
  return string_with_absorber(modes, 0.02, {}, 0.64, papers_absorber(clamp_mass));
}

MaxDelayOptions tuned_to(double frequency, const Absorber<double>& absorber) {
  const double omega = 2.0 * pi<double> * frequency;
  return {frequency, absorber.stiffness - absorber.mass * omega * omega};
}

void expect_same(const MaxDelay& found, const MaxDelay& expected, double tolerance) {
  EXPECT_EQ(found.outcome, expected.outcome);
  EXPECT_EQ(found.limit, expected.limit);
  EXPECT_NEAR(found.sampling_period, expected.sampling_period,
              tolerance * expected.sampling_period);
}

TEST(ModalMaxDelay, OfSomeModesIsThatOfTheirMatrices) {
  const ConductorWithAbsorber plant = string_with(3, 0.01);
  const LinearPlant<double> matrices = modal_plant(plant.modes, plant.absorber);
  for (const double frequency : {6.0, 12.0}) {
    MaxDelayOptions question = tuned_to(frequency, plant.absorber);
    question.shortest_period = 1e-3;
    question.search_ratio = 1.001;
    SCOPED_TRACE(frequency);
    expect_same(modal_max_sampling_period(plant, question, 1.01),
                max_sampling_period(matrices, question), 1e-4);
  }
}

TEST(ModalMaxDelay, RefusesWhatIsNotAdmissible) {
  ConductorWithAbsorber plant = string_with(3, 0.0);
  const MaxDelayOptions question = tuned_to(10.0, plant.absorber);
  EXPECT_THROW(modal_max_sampling_period(plant, question, 1.0), InvalidParameter);
  EXPECT_THROW(modal_max_sampling_period(plant, {-1.0, 0.0}), InvalidParameter);
  plant.poles.clear();
  EXPECT_THROW(modal_max_sampling_period(plant, question), InvalidParameter);
}

}  // namespace
}  // namespace holdfast::test
