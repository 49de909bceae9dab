// The nonlinear cable under the sampled drive: small motions against those of its modes, which are
// another route from the elements on.

#include "holdfast/sundials/elements_motion.hpp"

#include "holdfast/cable/cable_place_modes.hpp"
#include "holdfast/motion/modal/modal_motion.hpp"
#include "support/string_case.hpp"

namespace holdfast::test {
namespace {

constexpr int bars = 24;
const RayleighDamping damping = rayleigh_damping(0.02, 2.0, 7.0);

CableElements driven_cable(double clamp_mass, bool sideways) {
  const Absorber<double> absorber = papers_absorber(clamp_mass);
  return {kollar2022_conductor(),
          0.64,
          bars,
          {AbsorberReading::spring_mass, absorber.mass, absorber.stiffness, absorber.damping,
           clamp_mass, sideways},
          damping};
}

/// A force of 0.1 mN, and a play that such a motion leaves again and again.
cvode::ElementsLoop small_loop(double delay, ForceHold hold) {
  return {{0.005, delay}, {-557.0, -3.0}, {1e-4, 10.0}, 3e-8, hold};
}

ModalMotion motion_of_modes(const CableElements& cable, const cvode::ElementsLoop& loop,
                            double clamp_mass, bool sideways) {
  const Absorber<double> absorber = papers_absorber(clamp_mass);
  auto modes = cable_place_modes(cable.chain(),
                                 {absorber.mass, clamp_mass + (sideways ? absorber.mass : 0.0)},
                                 2 * (bars - 1), BarMass::lumped)
                   .modes;
  for (auto& mode : modes) mode.damping_ratio = damping.damping_ratio(mode.angular_frequency);
  const ModalMotion::Full rest =
      ModalMotion::Full::Zero(2 * static_cast<Eigen::Index>(modes.size()) + 2);
  return *modal_motion(
      {modes, absorber, loop.sampling, loop.gains, loop.excitation, loop.backlash_width, loop.hold},
      rest);
}

void expect_same_motion(double clamp_mass, bool sideways, double delay, ForceHold hold) {
  const CableElements cable = driven_cable(clamp_mass, sideways);
  const cvode::ElementsLoop loop = small_loop(delay, hold);
  cvode::ElementsMotion elements(cable, loop, cable.held_by(0.0).state, {1e-12, 1e-13});
  ModalMotion modes = motion_of_modes(cable, loop, clamp_mass, sideways);
  Vector<double, 4> largest = Vector<double, 4>::Zero(), misfit = largest;
  int gaps = 0;
  for (int j = 0; j < 80; ++j) {
    const auto found = elements.sense(), expected = modes.sense();
    largest = largest.cwiseMax(expected.state.cwiseAbs());
    misfit = misfit.cwiseMax((found.state - expected.state).cwiseAbs());
    ASSERT_EQ(found.engaged, expected.engaged) << j;
    EXPECT_EQ(found.time, expected.time);
    gaps += found.engaged ? 0 : 1;
    elements.advance();
    modes.advance();
  }
  ASSERT_EQ(elements.outcome(), cvode::IntegrationOutcome::completed) << elements.words();
  EXPECT_TRUE((misfit.array() <= 1e-4 * largest.array()).all())
      << misfit.transpose() << " of " << largest.transpose();
  EXPECT_GT(gaps, 5);
  EXPECT_LT(gaps, 75);
}

TEST(ElementsMotion, OfSmallSizeIsThatOfTheModes) {
  expect_same_motion(0.0, false, 0.0, ForceHold::sampled);
  expect_same_motion(0.01, false, 0.002, ForceHold::exact);
  expect_same_motion(0.01, true, 0.005, ForceHold::sampled);
}

/// A stiffer or a slacker spring than the linear one, by the sag and the stretch: the answer of ten
/// thousand times the force is another one.
TEST(ElementsMotion, OfLargeSizeIsAnother) {
  const CableElements cable = driven_cable(0.01, false);
  cvode::ElementsLoop loop = small_loop(0.0, ForceHold::sampled);
  loop.excitation.amplitude = 1.0;
  loop.backlash_width = 0.0;
  cvode::ElementsMotion elements(cable, loop, cable.held_by(0.0).state, {1e-6, 1e-10});
  ModalMotion modes = motion_of_modes(cable, loop, 0.01, false);
  double misfit = 0.0, largest = 0.0;
  for (int j = 0; j < 80; ++j) {
    const auto found = elements.sense(), expected = modes.sense();
    misfit = std::max(misfit, std::abs(found.state[0] - expected.state[0]));
    largest = std::max(largest, std::abs(expected.state[0]));
    elements.advance();
    modes.advance();
  }
  EXPECT_GT(misfit, 0.02 * largest);
  EXPECT_LT(misfit, largest);
}

TEST(ElementsMotion, EndsWhereTheCableGoesSlack) {
  const CableElements cable = driven_cable(0.0, false);
  cvode::ElementsLoop loop = small_loop(0.0, ForceHold::sampled);
  loop.gains.differential = -40.0;
  loop.backlash_width = 0.0;
  cvode::ElementsMotion motion(cable, loop, cable.held_by(0.0).state);
  for (int j = 0; j < 400 && motion.outcome() == cvode::IntegrationOutcome::completed; ++j) {
    motion.sense();
    motion.advance();
  }
  EXPECT_EQ(motion.outcome(), cvode::IntegrationOutcome::model_ended) << motion.words();
}

TEST(ElementsMotion, RefusesWhatIsNotAdmissible) {
  const CableElements cable = driven_cable(0.0, false);
  const CableElements weight(kollar2022_conductor(), 0.64, bars, {AbsorberReading::weight, 0.16},
                             damping);
  const auto begin = [](const CableElements& of, const cvode::ElementsLoop& loop) {
    cvode::ElementsMotion motion(of, loop, of.held_by(0.0).state);
  };
  const auto loop = small_loop(0.0, ForceHold::sampled);
  EXPECT_THROW(begin(weight, loop), InvalidParameter);
  EXPECT_THROW(begin(cable, small_loop(0.006, ForceHold::sampled)), InvalidParameter);
  cvode::ElementsLoop negative = loop;
  negative.backlash_width = -1.0;
  EXPECT_THROW(begin(cable, negative), InvalidParameter);
}

}  // namespace
}  // namespace holdfast::test
