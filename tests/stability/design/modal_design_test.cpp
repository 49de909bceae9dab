// The best D and the margins of a loop by the poles of its plant, against those of its matrices.

#include "holdfast/stability/design/modal_design.hpp"

#include "holdfast/cable/taut_string.hpp"
#include "holdfast/control/loop_map.hpp"
#include "holdfast/math/linalg/spectral_radius.hpp"
#include "holdfast/plant/plant_poles.hpp"
#include "holdfast/stability/margins/modal_margins.hpp"
#include "holdfast/stability/response/modal_steady_response.hpp"
#include "support/string_case.hpp"
#include "support/testing.hpp"

namespace holdfast::test {
namespace {

const Sampling<double> samplings[] = {{1e-3, 3e-4}, {3e-3, 3e-3}, {0.01, 0.0}, {0.01, 0.016}};

std::vector<PlaceMode<double>> some_modes() {
  return string_modes(taut_string(kollar2022_conductor()), 0.64, 5);
}

TEST(ModalDesign, GainsWithinARadiusAreThoseOfTheMap) {
  const auto modes = some_modes();
  const auto absorber = papers_absorber(0.01);
  std::size_t intervals = 0;
  for (const Sampling<double>& sampling : samplings) {
    const auto response = modal_response(modes, absorber, sampling);
    const auto map = loop_map(modal_plant(modes, absorber), sampling);
    for (const double p : {-557.0, -100.0, 0.0})
      for (const double radius : {0.9, 0.996, 0.9999, 1.0, 1.2}) {
        const auto found = differential_gains_within_radius(response, p, radius);
        const auto expected = differential_gains_within_radius(map, p, radius);
        ASSERT_EQ(found.size(), expected.size()) << sampling.period << ' ' << p << ' ' << radius;
        for (std::size_t k = 0; k < found.size(); ++k) {
          EXPECT_NEAR(found[k].lower, expected[k].lower, 1e-6) << radius;
          EXPECT_NEAR(found[k].upper, expected[k].upper, 1e-6) << radius;
          ++intervals;
        }
      }
  }
  EXPECT_GT(intervals, 20U);
}

TEST(ModalDesign, BestGainsAreThoseOfTheMatrices) {
  const auto modes = some_modes();
  const auto absorber = papers_absorber(0.01);
  const auto plant = modal_plant(modes, absorber);
  for (const Sampling<double>& sampling : samplings) {
    if (sampling.processing_delay > sampling.period) continue;  // which AmplitudeOptions refuse
    const auto response = modal_response(modes, absorber, sampling);
    for (const double p : {-557.0, -100.0}) {
      const MinimumRadius radius = minimum_radius(response, p);
      const MinimumRadius by_map = minimum_radius(loop_map(plant, sampling), p);
      EXPECT_NEAR(radius.margin, by_map.margin, 2e-6 * std::abs(by_map.margin) + 1e-9);
      for (const double margin : {0.0, 0.5}) {
        for (const ForceHold hold : {ForceHold::sampled, ForceHold::exact}) {
          const AmplitudeOptions options{sampling, hold, 1.0, margin, true};
          const double omega = 2.0 * pi<double> * 10.0;
          const auto steady = steady_response(modes, absorber, sampling, hold, omega)
                                  .relative_to(true_amplitude_per_force(modes, absorber, omega));
          const auto found = minimum_amplitude(response, options, 10.0, p, steady);
          const auto expected = minimum_amplitude(plant, options, 10.0, p);
          EXPECT_EQ(found.outcome, expected.outcome) << sampling.period << ' ' << p;
          if (expected.outcome == MinimumAmplitudeOutcome::none) continue;
          EXPECT_NEAR(found.differential_gain, expected.differential_gain,
                      1e-3 * std::abs(expected.differential_gain));
          EXPECT_NEAR(found.ratio_to_uncontrolled, expected.ratio_to_uncontrolled, 1e-3);
        }
      }
    }
  }
}

void expect_same(const MarginEnd& found, const MarginEnd& expected, double period) {
  if (expected.outcome != MarginEndOutcome::boundary) {
    EXPECT_NE(found.outcome, MarginEndOutcome::boundary) << period;
    return;
  }
  EXPECT_EQ(found.outcome, MarginEndOutcome::boundary) << period;
  EXPECT_NEAR(found.position / expected.position, 1.0, 1e-6) << period;
  EXPECT_EQ(found.curve, expected.curve) << period;
  EXPECT_NEAR(found.frequency, expected.frequency, 1e-5 * expected.frequency) << period;
}

TEST(ModalMargins, AreThoseOfTheMatrices) {
  const auto modes = some_modes();
  const auto absorber = papers_absorber(0.01);
  const auto plant = modal_plant(modes, absorber);
  const auto poles = plant_poles(modes, absorber);
  MarginSearch search;
  search.longest_period_ratio = 100.0;
  for (const Sampling<double>& sampling : samplings) {
    const PdGains<double> gains{-300.0, -2.0};
    const auto found = modal_stability_margins(poles, sampling, gains, search);
    const auto expected = stability_margins(plant, sampling, gains, search);
    ASSERT_EQ(found.outcome, expected.outcome) << sampling.period;
    EXPECT_NEAR(found.unit_circle, expected.unit_circle, 1e-10);
    expect_same(found.differential_gain.below, expected.differential_gain.below, sampling.period);
    expect_same(found.differential_gain.above, expected.differential_gain.above, sampling.period);
    expect_same(found.proportional_gain.below, expected.proportional_gain.below, sampling.period);
    expect_same(found.proportional_gain.above, expected.proportional_gain.above, sampling.period);
    expect_same(found.sampling_period.below, expected.sampling_period.below, sampling.period);
    expect_same(found.sampling_period.above, expected.sampling_period.above, sampling.period);
    expect_same(found.processing_delay.below, expected.processing_delay.below, sampling.period);
    expect_same(found.processing_delay.above, expected.processing_delay.above, sampling.period);
  }
}

/// Behind twenty commands no roots are looked for; the turn of p decides.
TEST(ModalMargins, NeedNoRoots) {
  const auto poles = plant_poles(some_modes(), papers_absorber(0.0));
  const auto margins = modal_stability_margins(poles, {1e-4, 25e-4}, {-300.0, -2.0});
  EXPECT_EQ(margins.outcome, MarginOutcome::stable);
  EXPECT_EQ(margins.sampling_period.above.outcome, MarginEndOutcome::boundary);
  const auto map = loop_map(modal_plant(some_modes(), papers_absorber(0.0)),
                            {0.999 * margins.sampling_period.above.position,
                             25 * 0.999 * margins.sampling_period.above.position});
  EXPECT_LT(spectral_radius(map.closed_map({-300.0, -2.0})), 1.0);
}

/// One mode is two masses, whose margins of the loop as a whole are in closed form.
TEST(ModalMargins, OfTheLoopAsAWholeAreThoseOfTwoMasses) {
  const PlaceMode<double> mode = some_modes().front();
  const double mass = mode.mass / (mode.shape * mode.shape), omega = mode.angular_frequency;
  const Absorber<double> absorber = papers_absorber(0.0);
  const TwoMass<double> masses{
      mass,          mass * omega * omega, 2.0 * mode.damping_ratio * omega * mass,
      absorber.mass, absorber.stiffness,   absorber.damping};
  for (const Sampling<double> sampling :
       {Sampling<double>{1e-3, 0.0}, Sampling<double>{1e-3, 5e-4}, Sampling<double>{0.01, 0.002}}) {
    const PdGains<double> gains{-557.0, -5.0};
    const auto found = modal_loop_margins(plant_poles({mode}, absorber), sampling, gains);
    const auto expected = loop_margins(masses, sampling, gains);
    ASSERT_EQ(found.outcome, expected.outcome);
    EXPECT_NEAR(found.unit_circle, expected.unit_circle, 1e-10);
    EXPECT_NEAR(found.largest_factor, expected.largest_factor, 1e-6 * expected.largest_factor);
    EXPECT_NEAR(found.least_factor, expected.least_factor, 1e-6);
    EXPECT_NEAR(found.phase, expected.phase, 1e-6);
    expect_same(found.delay, expected.delay, sampling.period);
  }
  const auto unstable = modal_loop_margins(plant_poles({mode}, absorber), {1e-3}, {-557.0, 90.0});
  EXPECT_EQ(unstable.outcome, MarginOutcome::not_stable);
  EXPECT_TRUE(std::isnan(unstable.phase));
}

}  // namespace
}  // namespace holdfast::test
