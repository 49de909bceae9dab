#include "case/model/own/own_parts.hpp"

#include <complex>
#include <memory>
#include <utility>

#include "case/case_keys.hpp"
#include "case/case_source.hpp"
#include "case/model/linear_loop.hpp"
#include "case/model/loop_of_case.hpp"
#include "case/model/modal/modal_plant_of_case.hpp"
#include "case/model/plant_of_case.hpp"
#include "holdfast/control/gains.hpp"
#include "holdfast/excitation/recorded_force.hpp"
#include "holdfast/plant/natural_modes.hpp"
#include "jobs/motion/case_motion.hpp"
#include "jobs/motion/cell_motion.hpp"
#include "jobs/support.hpp"
#include "process/errors.hpp"
#include "support/lagging_plant.hpp"
#include "support/testing.hpp"

namespace holdfast::program {
namespace {

/// The two masses of the built-in case, at any order.
LinearPlant<double> two_masses() {
  return test::of_dynamic_order(linear_plant(plant_of(CaseSource{}.load())));
}

CaseSource source_of(std::optional<LinearPlant<double>> plant, OwnForce controller = {}) {
  auto own = std::make_shared<OwnParts>();
  own->state = Vector<double, Eigen::Dynamic>::Zero(4);
  own->plant = std::move(plant);
  own->controller = std::move(controller);
  CaseSource source;
  source.own = own;
  return source;
}

TEST(OwnPlant, AnswersAsTheTwoMassesThatItIs) {
  const Case theirs = CaseSource{}.load(), ours = source_of(two_masses()).load();
  EXPECT_EQ(motion_kind_of(ours, Switching::sampled), MotionKind::built_plant);
  EXPECT_FALSE(is_two_masses(ours));
  EXPECT_NEAR(LinearLoop(ours).radius(gains_of(ours)), LinearLoop(theirs).radius(gains_of(theirs)),
              1e-12);
  const auto one = LinearLoop(ours).stable_gains(FreeGain::differential, gains_of(ours));
  ASSERT_EQ(one.size(), 1u);
  const double omega = 2.0 * pi<double> * 10.0;
  EXPECT_NEAR(true_amplitude_of(ours, omega), true_amplitude_of(theirs, omega), 1e-15);
  CaseMotion a(ours, {}), b(theirs, {});
  for (int j = 0; j < 2000; ++j) {
    ASSERT_NEAR(a.sense().state[2], b.sense().state[2], 1e-10) << "sample " << j;
    a.advance();
    b.advance();
  }
}

TEST(OwnPlant, LargestPeriodIsThatOfTheTwoMassesThatItIs) {
  const Case theirs = CaseSource{}.load(), ours = source_of(two_masses()).load();
  MaxDelayOptions question;
  question.frequency = 10.0;
  question.proportional_gain = gains_of(theirs).proportional;
  for (const DelayCriterion criterion : {DelayCriterion::stable, DelayCriterion::attenuates}) {
    question.criterion = criterion;
    const MaxDelay one = LinearLoop(ours).longest_period(question);
    const MaxDelay other = LinearLoop(theirs).longest_period(question);
    EXPECT_EQ(one.outcome, other.outcome);
    EXPECT_NEAR(one.sampling_period, other.sampling_period, 1e-6 * other.sampling_period);
  }
}

TEST(OwnPlant, CellsOfASweepAreThoseOfTheTwoMassesThatItIs) {
  const Case theirs = CaseSource{}.load(), ours = source_of(two_masses()).load();
  const auto metrics = [](const Case& of) {
    return metrics_of(
        {cell_motion(case_with(of, "backlash.width", 0.0007), Switching::sampled, 5.0),
         motion_without_control(of, 5.0)},
        5.0, InstructionSet::baseline);
  };
  const auto one = metrics(ours), other = metrics(theirs);
  for (const std::size_t k : {0U, 1U})
    EXPECT_NEAR(one[k].steady_peak, other[k].steady_peak, 1e-7 * other[k].steady_peak) << k;
  EXPECT_THROW(case_with(ours, "plant.absorber_mass", 0.2), WrongInput);
  EXPECT_THROW(case_with(ours, "initial.z1", 0.2), WrongInput);
}

TEST(OwnPlant, PolesAreItsEigenvaluesWithTheirResidues) {
  const LinearPlant<double> plant = two_masses();
  const std::complex<double> s(-0.3, 17.0);
  std::complex<double> sum = 0.0;
  for (const PlantPole& pole : poles_of(plant)) sum += pole.residue / (s - pole.s);
  const Eigen::MatrixXcd resolvent = s * Eigen::MatrixXcd::Identity(4, 4) - plant.state_matrix();
  const std::complex<double> direct =
      (plant.connections.measured_displacement.cast<std::complex<double>>() *
       resolvent.partialPivLu().solve(plant.control_input().cast<std::complex<double>>()))(0);
  EXPECT_NEAR(std::abs(sum - direct), 0.0, 1e-12 * std::abs(direct));
}

TEST(OwnPlant, RefusesWhatHasNoSumOverPoles) {
  LinearPlant<double> plant = two_masses();
  plant.connections.measured_velocity[0] = 1.0;
  EXPECT_THROW(poles_of(plant), NoAnswer);
  plant = two_masses();
  plant.released_matrix.setZero();
  plant.released_matrix(0, 1) = plant.released_matrix(2, 3) = 1.0;
  EXPECT_THROW(poles_of(plant), NoAnswer);
}

TEST(OwnPlant, RefusesWhatDoesNotCountBesideIt) {
  for (const char* setting : {"plant.absorber_mass=1.0", "conductor.span=3.0", "initial.z1=0.1",
                              "control.proportional_gain=tuned"}) {
    CaseSource source = source_of(two_masses());
    source.overrides = {setting};
    EXPECT_THROW(source.load(), WrongInput) << setting;
  }
  EXPECT_THROW(conductor_with_absorber_of(source_of(two_masses()).load()), WrongInput);
  const Case ours = source_of(two_masses()).load();
  EXPECT_NE(support_of(ours, {"design", {"--band"}}).refusal.find("a plant of your own"),
            std::string::npos);
  EXPECT_EQ(support_of(ours, {"design", {}}).refusal, "");
}

/// A force in memory is a recorded one without a file.
TEST(OwnForce, IsARecordedForce) {
  Case the_case = CaseSource{}.load();
  const Asked elements{"simulate", {"--plant", "--plant elements"}};
  EXPECT_EQ(support_of(the_case, elements).refusal, "");
  the_case.force_record = std::make_shared<const RecordedForce>(
      std::vector<double>{0.0, 1.0}, std::vector<double>{0.0, 1.0}, RecordInterpolation::linear);
  EXPECT_NE(support_of(the_case, elements).refusal.find("a recorded force"), std::string::npos);
}

TEST(OwnController, DecidesInThePlaceOfTheGains) {
  const Case theirs = CaseSource{}.load();
  const PdGains<double> gains = gains_of(theirs);
  std::vector<std::int64_t> seen;
  const Case ours = source_of(std::nullopt, [&](std::int64_t k, double t, double z, double v) {
                      seen.push_back(k);
                      EXPECT_DOUBLE_EQ(t, static_cast<double>(k) * 0.001);
                      return gains.proportional * z + gains.differential * v;
                    }).load();
  EXPECT_EQ(motion_kind_of(ours, Switching::sampled), MotionKind::built_plant);
  CaseMotion a(ours, {}), b(theirs, {});
  for (int j = 0; j < 1000; ++j) {
    ASSERT_NEAR(a.sense().state[2], b.sense().state[2], 1e-10) << "sample " << j;
    a.advance();
    b.advance();
  }
  EXPECT_EQ(seen.front(), 0);
  EXPECT_EQ(seen.back(), 999);
  const Case free = ours;
  CaseMotion without(free, {Switching::sampled, false});
  const std::size_t calls = seen.size();
  without.sense();
  EXPECT_EQ(seen.size(), calls);
}

TEST(OwnController, RefusesWhatItDoesItself) {
  const OwnForce none = [](std::int64_t, double, double, double) { return 0.0; };
  for (const char* setting : {"control.processing_delay=0.002", "control.largest_force=1.0",
                              "control.velocity=difference"}) {
    CaseSource source = source_of(std::nullopt, none);
    source.overrides = {setting};
    EXPECT_THROW(source.load(), WrongInput) << setting;
  }
}

}  // namespace
}  // namespace holdfast::program
