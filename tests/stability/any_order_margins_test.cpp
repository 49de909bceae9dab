// Margins, steady amplitudes and largest sampling periods of loops of any order: against the closed
// forms of the two masses, and against the eigenvalues and the dense solutions of the loop's map.

#include "holdfast/control/loop_map.hpp"
#include "holdfast/stability/margins/margins.hpp"
#include "holdfast/stability/response/response.hpp"
#include "support/dense_routes.hpp"
#include "support/lagging_plant.hpp"
#include "support/random.hpp"
#include "support/random_loop.hpp"
#include "support/testing.hpp"

namespace holdfast::test {
namespace {

using Complex = std::complex<double>;

template <class Plant>
double radius(const Plant& plant, const Sampling<double>& sampling, const PdGains<double>& gains) {
  return spectral_radius(loop_map(plant, sampling).closed_map(gains));
}

struct NamedMargin {
  const char* name;
  TwoSidedMargin margin;
  double value;
};

std::vector<NamedMargin> all_of(const StabilityMargins& margins, const Sampling<double>& sampling,
                                const PdGains<double>& gains) {
  return {{"D", margins.differential_gain, gains.differential},
          {"P", margins.proportional_gain, gains.proportional},
          {"period", margins.sampling_period, sampling.period},
          {"delay", margins.processing_delay, sampling.processing_delay}};
}

void expect_same_end(const MarginEnd& general, const MarginEnd& closed, double value) {
  EXPECT_EQ(general.outcome, closed.outcome);
  if (general.outcome != closed.outcome) return;
  if (!std::isfinite(closed.position)) {
    EXPECT_EQ(general.position, closed.position);
    return;
  }
  EXPECT_NEAR(general.position, closed.position,
              1e-7 * std::max(std::abs(value), std::abs(closed.position)));
  if (closed.outcome != MarginEndOutcome::boundary) return;
  EXPECT_EQ(general.curve, closed.curve);
  EXPECT_NEAR(general.frequency, closed.frequency, 1e-6 * closed.frequency);
}

TEST(AnyOrderMargins, OfTwoMassesAreTheClosedForms) {
  Random random(20263);
  int stable = 0, boundaries = 0;
  for (int draw = 0; draw < 400 && stable < 40; ++draw) {
    const TwoMass<double> plant = random_plant(random);
    const Sampling<double> sampling = random_sampling(plant, random);
    const PdGains<double> gains = random_gains(plant, sampling.period, random);
    const StabilityMargins closed = stability_margins(plant, sampling, gains);
    if (closed.outcome != MarginOutcome::stable || closed.unit_circle < 1e-4) continue;
    ++stable;
    SCOPED_TRACE(draw);
    const StabilityMargins general = stability_margins(through_ports(plant), sampling, gains);
    ASSERT_EQ(general.outcome, MarginOutcome::stable);
    EXPECT_NEAR(general.unit_circle, closed.unit_circle, 1e-9);
    const auto expected = all_of(closed, sampling, gains), found = all_of(general, sampling, gains);
    for (std::size_t k = 0; k < expected.size(); ++k) {
      SCOPED_TRACE(expected[k].name);
      const double value = expected[k].value;
      expect_same_end(found[k].margin.below, expected[k].margin.below, value);
      if (k == 3 && expected[k].margin.above.outcome == MarginEndOutcome::none) {
        EXPECT_GE(found[k].margin.above.position,
                  sampling.period);  // which the closed forms end at
      } else {
        expect_same_end(found[k].margin.above, expected[k].margin.above, value);
      }
      boundaries += expected[k].margin.above.outcome == MarginEndOutcome::boundary ? 1 : 0;
    }
  }
  EXPECT_EQ(stable, 40);
  EXPECT_GT(boundaries, 40);
}

struct MarginCase {
  double filter, drive;
  Sampling<double> sampling;
  PdGains<double> gains;
};

/// Stable loops of seven states, with delays of none, part of a sample, and several.
const std::vector<MarginCase>& margin_cases() {
  static const std::vector<MarginCase> cases = {{200.0, 300.0, {0.001, 0.0}, {-100.0, -5.0}},
                                                {100.0, 150.0, {0.002, 0.001}, {-50.0, -3.0}},
                                                {200.0, 300.0, {0.001, 0.0025}, {-60.0, -4.0}},
                                                {100.0, 300.0, {0.001, 0.003}, {-30.0, -2.0}},
                                                {200.0, 300.0, {0.005, 0.002}, {-100.0, -6.5}},
                                                {200.0, 300.0, {0.0005, 0.0031}, {-60.0, -5.5}},
                                                {30.0, 60.0, {0.01, 0.0}, {-20.0, -1.0}}};
  return cases;
}

/// Stable at all of many points up to an end, and at a boundary on the circle, beyond it outside.
void expect_first_loss(const MarginEnd& end, double value,
                       const std::function<double(double)>& radius_at) {
  ASSERT_NE(end.outcome, MarginEndOutcome::undefined);
  const bool boundary = end.outcome == MarginEndOutcome::boundary;
  const double far = std::isfinite(end.position) ? end.position : value + 30.0 * std::abs(value);
  for (int k = 0; k < 500; ++k) {
    const double at = value + (far - value) * k / 500.0;
    if (at > 0.0 || value <= 0.0) {
      EXPECT_LT(radius_at(at), 1.0) << at;
    }
  }
  if (!boundary) return;
  EXPECT_NEAR(radius_at(end.position), 1.0, 1e-9);
  EXPECT_GT(radius_at(value + (end.position - value) * (1.0 + 1e-5)), 1.0);
}

TEST(AnyOrderMargins, OfSevenStatesAreTheFirstLossesOfStability) {
  int late = 0;
  for (const MarginCase& c : margin_cases()) {
    SCOPED_TRACE(c.sampling.processing_delay / c.sampling.period);
    const LinearPlant<double> plant = lagging_plant(c.filter, c.drive);
    const StabilityMargins margins = stability_margins(plant, c.sampling, c.gains);
    ASSERT_EQ(margins.outcome, MarginOutcome::stable);
    EXPECT_NEAR(margins.unit_circle, 1.0 - radius(plant, c.sampling, c.gains), 1e-10);
    const double fraction = c.sampling.processing_delay / c.sampling.period;
    const std::function<double(double)> radii[] = {
        [&](double d) {
          return radius(plant, c.sampling, {c.gains.proportional, d});
        },
        [&](double p) {
          return radius(plant, c.sampling, {p, c.gains.differential});
        },
        [&](double t) {
          return radius(plant, {t, fraction * t}, c.gains);
        },
        [&](double t) {
          return radius(plant, {c.sampling.period, t}, c.gains);
        }};
    const auto named = all_of(margins, c.sampling, c.gains);
    for (std::size_t k = 0; k < named.size(); ++k) {
      SCOPED_TRACE(named[k].name);
      expect_first_loss(named[k].margin.below, named[k].value, radii[k]);
      expect_first_loss(named[k].margin.above, named[k].value, radii[k]);
    }
    const MarginEnd& delay = margins.processing_delay.above;
    late += delay.outcome == MarginEndOutcome::boundary && delay.position > 2.0 * c.sampling.period
                ? 1
                : 0;
  }
  EXPECT_GE(late, 1);
}

TEST(AnyOrderMargins, AnUnstableLoopHasNone) {
  const auto margins = stability_margins(lagging_plant(20.0, 20.0), {0.01, 0.03}, {-300.0, 40.0});
  EXPECT_EQ(margins.outcome, MarginOutcome::not_stable);
  EXPECT_LE(margins.unit_circle, 0.0);
  EXPECT_THROW(stability_margins(lagging_plant(20.0, 20.0), {0.0, 0.0}, {0.0, 0.0}),
               InvalidParameter);
}

TEST(AnyOrderMargins, TheBoundOnSlowSamplingIsThatOfTheResolventPolynomials) {
  Random random(20264);
  for (int draw = 0; draw < 50; ++draw) {
    const TwoMass<double> plant = random_plant(random);
    const PdGains<double> gains = random_gains(plant, 0.01, random);
    const SlowSamplingBound closed(plant, gains, 0.3), general(through_ports(plant), gains, 0.3);
    for (const double period : {0.01, 0.3, 2.0}) {
      if (!std::isfinite(closed.at(period))) continue;
      EXPECT_NEAR(general.at(period), closed.at(period), 1e-6 * closed.at(period) + 1e-14) << draw;
    }
  }
}

/// |z| per newton of a loop, by a dense solution of (λI − S) y = g.
template <class Plant>
double dense_amplitude(const Plant& plant, const Sampling<double>& sampling,
                       const PdGains<double>& gains, ForceHold hold, double omega) {
  const LoopMap<double> map = loop_map(plant, sampling);
  const auto input = harmonic_input(plant, map, hold, omega);
  Eigen::MatrixXcd matrix = -map.closed_map(gains).template cast<Complex>();
  matrix.diagonal().array() += std::polar(1.0, omega * sampling.period);
  const Eigen::VectorXcd source =
      input.cosine.template cast<Complex>() - Complex(0, 1) * input.sine.template cast<Complex>();
  const Eigen::VectorXcd solution = test::solution_of(matrix, source);
  return std::abs((map.conductor.template cast<Complex>() * solution).value());
}

TEST(AnyOrderResponse, AmplitudeIsThatOfTheClosedMap) {
  for (const MarginCase& c : margin_cases()) {
    const LinearPlant<double> plant = lagging_plant(c.filter, c.drive);
    for (const ForceHold hold : {ForceHold::sampled, ForceHold::exact}) {
      for (const double frequency : {0.5, 8.0, 30.0}) {
        const double omega = 2.0 * pi<double> * frequency;
        const auto response = steady_response(plant, c.sampling, hold, omega);
        const double expected = dense_amplitude(plant, c.sampling, c.gains, hold, omega);
        EXPECT_NEAR(response.amplitude_per_force(c.gains), expected, 1e-9 * expected);
        const double free = dense_amplitude(plant, c.sampling, {0.0, 0.0}, hold, omega);
        EXPECT_NEAR(response.uncontrolled_amplitude_per_force(), free, 1e-9 * free);
        EXPECT_NEAR(response.squared_ratio(c.gains.proportional).at(c.gains.differential),
                    expected * expected / (free * free),
                    1e-8 * expected * expected / (free * free));
      }
    }
  }
}

TEST(AnyOrderResponse, OfTwoMassesIsTheClosedForm) {
  Random random(20265);
  for (int draw = 0; draw < 100; ++draw) {
    const TwoMass<double> plant = random_plant(random);
    const Sampling<double> sampling = random_sampling(plant, random);
    const PdGains<double> gains = random_gains(plant, sampling.period, random);
    const double omega = random.uniform(0.05, 3.0) / sampling.period;
    const auto closed = steady_response(plant, sampling, ForceHold::exact, omega);
    const auto general = steady_response(through_ports(plant), sampling, ForceHold::exact, omega);
    EXPECT_NEAR(general.ratio_to_uncontrolled(gains), closed.ratio_to_uncontrolled(gains),
                1e-8 * closed.ratio_to_uncontrolled(gains))
        << draw;
  }
}

TEST(AnyOrderResponse, ADelayOfTwoMassesBeyondASampleIsThatOfTheirMap) {
  const TwoMass<double> plant = kollar2022_plant();
  const Sampling<double> late{0.002, 0.0051};
  const PdGains<double> gains{-50.0, -3.0};
  const double omega = 2.0 * pi<double> * 10.0;
  const double expected = dense_amplitude(plant, late, gains, ForceHold::exact, omega);
  EXPECT_NEAR(steady_response(plant, late, ForceHold::exact, omega).amplitude_per_force(gains),
              expected, 1e-10 * expected);
}

/// The closed map anywhere in a stretch is its polynomial but for the remainder, which is small.
TEST(SamplingFamily, TheMovingMapIsTheMapAllOverTheStretch) {
  const LinearPlant<double> plant = lagging_plant(40.0, 60.0);
  const PdGains<double> gains{-50.0, -3.0};
  const double period = 0.003;
  using Family = SamplingFamily<LinearPlant<double>>;
  for (const bool by_period : {true, false}) {
    for (const double fraction : {0.0, 0.4, 1.0, 2.3}) {
      if (!by_period && fraction == std::floor(fraction)) continue;
      const Family family = by_period
                                ? Family::of_period(plant, fraction)
                                : Family::of_delay(plant, period, held_commands({1.0, fraction}));
      const double position = by_period ? period : fraction * period, radius = 0.3 * period;
      const MovingMatrix moving = family.moving(family.map_at(position), gains, radius);
      for (const double x : {-0.9, -0.3, 0.4, 0.9}) {
        const Eigen::MatrixXd map = family.map_at(position + x * radius).closed_increment(gains);
        Eigen::MatrixXd sum = moving.terms.back();
        for (std::size_t k = moving.terms.size() - 1; k > 0; --k)
          sum = (x * sum + moving.terms[k - 1]).eval();
        if (!by_period && position + x * radius > held_commands({1.0, fraction}) * period) continue;
        const Eigen::MatrixXd allowed =
            moving.remainder.array() + 1e-12 * moving.terms.front().cwiseAbs().maxCoeff();
        EXPECT_LE(((map - sum).cwiseAbs() - allowed).maxCoeff(), 0.0) << by_period << fraction << x;
        EXPECT_LT(moving.remainder.maxCoeff(), 1e-8);
      }
    }
  }
}

}  // namespace
}  // namespace holdfast::test
