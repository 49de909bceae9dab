// The metrics of a conductor of one mode are those of the two masses that it is.

#include "holdfast/sweep/modal_metrics.hpp"

#include "holdfast/cable/taut_string.hpp"
#include "support/string_case.hpp"

namespace holdfast::test {
namespace {

ModalLoop loop_of_one_mode() {
  return {string_modes(taut_string(kollar2022_conductor()), 0.64, 1),
          papers_absorber(0.0),
          {0.005, 0.001},
          {-557.0, -4.0},
          {0.6, 10.0},
          2e-5,
          ForceHold::sampled};
}

MotionMetrics metrics_of_two_masses(const ModalLoop& loop, double duration) {
  return event_metrics(implemented_loop(IdealLoop<double>{
                           two_masses_of(loop.modes.front(), loop.absorber), loop.sampling,
                           loop.gains, loop.excitation, loop.backlash_width, loop.hold}),
                       Vector<double, 4>::Zero(), duration);
}

TEST(ModalMetrics, OfOneModeAreThoseOfTwoMasses) {
  const ModalLoop loop = loop_of_one_mode();
  const ModalMotion::Full rest = ModalMotion::Full::Zero(4);
  const MotionMetrics found =
      modal_metrics(loop, plant_poles(loop.modes, loop.absorber), rest, 10.0);
  const MotionMetrics expected = metrics_of_two_masses(loop, 10.0);
  EXPECT_EQ(found.end, MotionEnd::completed);
  EXPECT_EQ(found.samples, expected.samples);
  EXPECT_EQ(found.engaged_fraction, expected.engaged_fraction);
  EXPECT_GT(found.engaged_fraction, 0.0);
  EXPECT_LT(found.engaged_fraction, 1.0);
  for (const auto member :
       {&MotionMetrics::first_peak, &MotionMetrics::steady_peak, &MotionMetrics::steady_rms,
        &MotionMetrics::force_peak, &MotionMetrics::force_rms, &MotionMetrics::reversals_per_s,
        &MotionMetrics::absorber_stroke})
    EXPECT_NEAR(found.*member / (expected.*member), 1.0, 1e-8);
}

TEST(ModalMetrics, RefuseADurationThatIsNotAdmissible) {
  const ModalLoop loop = loop_of_one_mode();
  EXPECT_THROW(
      modal_metrics(loop, plant_poles(loop.modes, loop.absorber), ModalMotion::Full::Zero(4), -1.0),
      InvalidParameter);
}

}  // namespace
}  // namespace holdfast::test
