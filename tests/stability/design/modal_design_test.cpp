// The best D and the margins of a loop by the poles of its plant, against those of its matrices.

#include "holdfast/stability/design/modal_design.hpp"

#include "holdfast/cable/taut_string.hpp"
#include "holdfast/control/loop_map.hpp"
#include "holdfast/math/linalg/spectral_radius.hpp"
#include "holdfast/plant/plant_poles.hpp"
#include "holdfast/stability/design/minimum_amplitude_gains.hpp"
#include "holdfast/stability/margins/modal_margins.hpp"
#include "holdfast/stability/response/modal_steady_response.hpp"
#include "support/margin_ends.hpp"
#include "support/string_case.hpp"

namespace holdfast::test {
namespace {

const Sampling<double> samplings[] = {{1e-3, 3e-4}, {3e-3, 3e-3}, {0.01, 0.0}, {0.01, 0.016}};

/// Five modes of the paper's string with its absorber, by its poles and by its matrices.
struct SomeString {
  std::vector<PlaceMode<double>> modes = papers_modes(5);
  Absorber<double> absorber;
  ConductorWithAbsorber conductor{modes, absorber, plant_poles(modes, absorber), {}};
  LinearPlant<double> plant = modal_plant(modes, absorber);

  explicit SomeString(double clamp_mass = 0.01) : absorber(papers_absorber(clamp_mass)) {}

  ModalResponse<double> response(const Sampling<double>& sampling) const {
    return modal_response(conductor, sampling);
  }
  LoopMap<double> map(const Sampling<double>& sampling) const { return loop_map(plant, sampling); }
  /// The response at 10 Hz, relative to no control under the true force.
  SteadyResponse<double> steady(const Sampling<double>& sampling, ForceHold hold) const {
    const double omega = 2.0 * pi<double> * 10.0;
    return steady_response(conductor, sampling, hold, omega)
        .relative_to(true_amplitude_per_force({modes, absorber, {}}, omega));
  }
};

TEST(ModalDesign, GainsWithinARadiusAreThoseOfTheMap) {
  const SomeString string;
  std::size_t intervals = 0;
  for (const Sampling<double>& sampling : samplings) {
    const auto response = string.response(sampling);
    const auto map = string.map(sampling);
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
  const SomeString string;
  for (const Sampling<double>& sampling : samplings) {
    const auto response = string.response(sampling);
    for (const double p : {-557.0, -100.0}) {
      const MinimumRadius radius = minimum_radius(response, p);
      const MinimumRadius by_map = minimum_radius(string.map(sampling), p);
      EXPECT_NEAR(radius.margin, by_map.margin, 2e-6 * std::abs(by_map.margin) + 1e-9);
      for (const double largest : {1.0, 0.9999}) {
        for (const ForceHold hold : {ForceHold::sampled, ForceHold::exact}) {
          const AmplitudeOptions options{sampling, hold, largest, 0.0, true};
          const auto found =
              minimum_amplitude(response, options, 10.0, p, string.steady(sampling, hold));
          const auto expected = minimum_amplitude(string.plant, options, 10.0, p);
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

/// min |1 − P G_z − D G_v| over the circle, of the map.
class Modulus {
 public:
  explicit Modulus(const LoopMap<double>& map) {
    const LoopResponse<double> response(map);
    // Close together where the modes are.
    for (int i = 1; i <= 8000; ++i)
      responses_.push_back(response.at_angle(pi<double> * std::pow(i / 8000.0, 3)));
  }
  double of(const PdGains<double>& gains) const {
    double least = 1e300;
    for (const auto& g : responses_)
      least = std::min(least, std::abs(1.0 - gains.proportional * g.displacement -
                                       gains.differential * g.velocity));
    return least;
  }

 private:
  std::vector<CommandResponse<double>> responses_;
};

/// The admissible gains end where the modulus margin is the share of the largest that was asked, or
/// so far from the gain that has that as was asked.
TEST(ModalDesign, AMarginIsAShareOfTheLargestModulus) {
  const SomeString string;
  int by_modulus = 0, by_way = 0;
  for (const Sampling<double>& sampling :
       {Sampling<double>{1e-3, 3e-4}, Sampling<double>{0.01, 0.016}}) {
    const auto response = string.response(sampling);
    const Modulus modulus(string.map(sampling));
    const double p = -100.0;
    const auto stable = differential_gains_within_radius(response, p, 1.0);
    ASSERT_EQ(stable.size(), 1U);
    const double width = stable[0].upper - stable[0].lower;
    double largest = 0.0, best = 0.0;
    for (int i = 1; i < 100; ++i) {
      const double d = stable[0].lower + width * i / 100.0, there = modulus.of({p, d});
      if (there > largest) best = d;
      largest = std::max(largest, there);
    }
    for (const double margin : {0.3, 0.5, 0.9}) {
      const auto admissible =
          admissible_differential_gains(response, p, {sampling, ForceHold::sampled, 1.0, margin});
      ASSERT_EQ(admissible.size(), 1U);
      for (const auto& [end, edge] : {std::pair{admissible[0].lower, stable[0].lower},
                                      std::pair{admissible[0].upper, stable[0].upper}}) {
        const double way = best + (1.0 - margin) * (edge - best);
        const bool at_modulus = std::abs(modulus.of({p, end}) - margin * largest) < 0.01;
        const bool at_way = std::abs(end - way) < 0.015 * width;
        EXPECT_TRUE(at_modulus || at_way) << sampling.period << ' ' << margin << ' ' << end;
        EXPECT_GT(modulus.of({p, end}), margin * largest - 0.01);
        EXPECT_LT(std::abs(end - best), std::abs(way - best) + 0.015 * width);
        by_modulus += at_modulus ? 1 : 0;
        by_way += at_way ? 1 : 0;
      }
    }
  }
  EXPECT_GT(by_modulus, 1);
  EXPECT_GT(by_way, 1);
}

/// One D for a band, against a scan of the band and of D by the matrices.
TEST(ModalDesign, OneGainForABandIsThatOfAScan) {
  const SomeString string;
  const Sampling<double> sampling{1e-3, 3e-4};
  const AmplitudeOptions options{sampling, ForceHold::exact, 1.0, 0.5, true};
  const auto found = modal_minimax_amplitude(string.conductor, options, -100.0, {8.0, 14.0});
  ASSERT_EQ(found.outcome, MinimaxOutcome::found);
  std::vector<RatioOfQuadratics<double>> ratios;
  for (double frequency = 8.0; frequency <= 14.0; frequency += 0.005) {
    const double omega = 2.0 * pi<double> * frequency;
    ratios.push_back(steady_response(string.plant, sampling, ForceHold::exact, omega)
                         .relative_to(true_amplitude_per_force(string.plant, omega))
                         .squared_ratio(-100.0));
  }
  const auto worst = [&](double d) {
    double most = 0.0;
    for (const auto& ratio : ratios) most = std::max(most, ratio.at(d));
    return std::sqrt(most);
  };
  EXPECT_NEAR(worst(found.differential_gain), found.worst_ratio, 1e-4);
  for (const auto& interval :
       admissible_differential_gains(string.response(sampling), -100.0, options))
    for (int i = 1; i < 200; ++i)
      EXPECT_GT(worst(interval.lower + (interval.upper - interval.lower) * i / 200.0),
                found.worst_ratio - 1e-4);
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
  const SomeString string;
  MarginSearch search;
  search.longest_period_ratio = 100.0;
  for (const Sampling<double>& sampling : samplings) {
    const PdGains<double> gains{-300.0, -2.0};
    const auto found = modal_stability_margins(string.conductor.poles, sampling, gains, search);
    const auto expected = stability_margins(string.plant, sampling, gains, search);
    ASSERT_EQ(found.outcome, expected.outcome) << sampling.period;
    EXPECT_NEAR(found.unit_circle, expected.unit_circle, 1e-10);
    const auto ours = two_sided_of(found), theirs = two_sided_of(expected);
    for (std::size_t k = 0; k < ours.size(); ++k) {
      expect_same(ours[k].below, theirs[k].below, sampling.period);
      expect_same(ours[k].above, theirs[k].above, sampling.period);
    }
  }
}

/// Behind twenty commands no roots are looked for; the turn of p decides.
TEST(ModalMargins, NeedNoRoots) {
  const SomeString string(0.0);
  const auto margins =
      modal_stability_margins(string.conductor.poles, {1e-4, 25e-4}, {-300.0, -2.0});
  EXPECT_EQ(margins.outcome, MarginOutcome::stable);
  EXPECT_EQ(margins.sampling_period.above.outcome, MarginEndOutcome::boundary);
  const double below = 0.999 * margins.sampling_period.above.position;
  const auto map = string.map({below, 25 * below});
  EXPECT_LT(spectral_radius(map.closed_map({-300.0, -2.0})), 1.0);
}

/// One mode is two masses, whose margins of the loop as a whole are in closed form.
TEST(ModalMargins, OfTheLoopAsAWholeAreThoseOfTwoMasses) {
  const SomeString string(0.0);
  const PlaceMode<double>& mode = string.modes.front();
  const Absorber<double>& absorber = string.absorber;
  const TwoMass<double> masses = two_masses_of(mode, absorber);
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

/// Of a grid of gains none that the map shows to have the margin leaves less amplitude.
TEST(ModalDesign, NoPairOfAGridIsQuieterThanTheBest) {
  const SomeString string;
  const double margin = 0.5;
  int admissible = 0;
  for (const Sampling<double>& sampling :
       {Sampling<double>{1e-3, 3e-4}, Sampling<double>{0.01, 0.004}}) {
    const auto response = string.response(sampling);
    const auto map = string.map(sampling);
    const auto steady = string.steady(sampling, ForceHold::exact);
    const AmplitudeOptions options{sampling, ForceHold::exact, 1.0, margin, true};
    const auto best = minimum_amplitude_gains(response, options, 10.0, {-1200.0, 200.0}, steady);
    const PdGains<double> gains{best.proportional_gain, best.quietest.differential_gain};
    const Modulus modulus(map);
    EXPECT_NEAR(modulus.of(gains), margin, 0.01) << "at the edge of what is admitted";
    EXPECT_LT(spectral_radius(map.closed_map(gains)), 1.0);
    EXPECT_NEAR(best.quietest.ratio_to_uncontrolled, steady.ratio_to_uncontrolled(gains), 1e-9);
    for (int i = 0; i <= 30; ++i) {
      for (int j = 0; j <= 30; ++j) {
        const PdGains<double> other{-400.0 + 20.0 * i, -6.0 + 0.4 * j};
        if (!(modulus.of(other) > margin + 0.01)) continue;
        if (!(spectral_radius(map.closed_map(other)) < 1.0)) continue;
        EXPECT_GT(steady.ratio_to_uncontrolled(other), best.quietest.ratio_to_uncontrolled)
            << other.proportional << ' ' << other.differential;
        ++admissible;
      }
    }
  }
  EXPECT_GT(admissible, 50);
}

}  // namespace
}  // namespace holdfast::test
