// How many digits of what the loop without backlash derives may be trusted: the same templates in
// double and in long double, over the cases of Kollár 2022 (Figs. 3–5).

#include "holdfast/control/gains.hpp"
#include "holdfast/stability/boundary/boundary_features.hpp"
#include "holdfast/stability/design/max_delay.hpp"
#include "holdfast/stability/design/minimum_radius.hpp"
#include "holdfast/stability/design/modal_design.hpp"
#include "holdfast/stability/margins/margins.hpp"
#include "support/digits.hpp"

namespace holdfast::loop_digits {
namespace {

using test::loop_inputs;
using test::loop_of;
using test::LoopInputs;
using test::plant_inputs;
using test::plant_of;
using test::sampled_of;
using test::SamplingCase;
using test::samplings;

class LoopDigits : public test::Digits {};

constexpr auto lowest_differential_gain = [](const auto& v) {
  return stable_differential_gains(characteristic_polynomial(sampled_of(v)), v[8]).front().lower;
};

TEST_F(LoopDigits, OfTheMatricesOfOneSample) {
  // Scaling and squaring of a balanced matrix, whose norm is below ten: ε times a few hundred.
  for (const SamplingCase& which : samplings) {
    const LoopInputs x = loop_inputs(which.period, which.delay, 0.0);
    const auto narrow = sampled_of(x);
    const auto wide = sampled_of(x.cast<long double>().eval());
    const auto input = harmonic_input(kollar2022_plant(), narrow, ForceHold::exact, 62.8);
    const auto wide_input = harmonic_input(converted<long double>(kollar2022_plant()), wide,
                                           ForceHold::exact, static_cast<long double>(62.8));
    const auto tell = [&](const char* quantity, const auto& found, const auto& reference) {
      report(quantity, which.name, trusted_digits(found, reference), 12.5);
    };
    tell("A_d", narrow.transition, wide.transition);
    tell("A_d - I", narrow.increment, wide.increment);
    tell("Gamma_0", narrow.present_force, wide.present_force);
    tell("Gamma_1", narrow.previous_force, wide.previous_force);
    tell("c_d", narrow.held_excitation, wide.held_excitation);
    tell("c_d of the exact hold, cosine", input.cosine, wide_input.cosine);
    tell("c_d of the exact hold, sine", input.sine, wide_input.sine);
  }
}

TEST_F(LoopDigits, OfTheStabilityOfTheLoop) {
  for (const SamplingCase& which : samplings) {
    LoopInputs x = loop_inputs(which.period, which.delay, 0.0);
    if (which.period > 0.02) {  // D = −13 is not stable there
      x[9] = stable_differential_gains(characteristic_polynomial(sampled_of(x)), x[8])
                 .front()
                 .representative();
    }
    compare("spectral radius", which.name, x, [](const auto& v) {
      return spectral_radius(sampled_of(v).engaged_map(loop_of(v).gains));
    });
    compare("1 - radius", which.name, x,
            [](const auto& v) { return -loop_polynomial(sampled_of(v)).excess(loop_of(v).gains); });
    compare("lowest stable D", which.name, x, lowest_differential_gain);
    compare("highest stable D", which.name, x, [](const auto& v) {
      return stable_differential_gains(characteristic_polynomial(sampled_of(v)), v[8]).back().upper;
    });
    compare("lowest stable P", which.name, x, [](const auto& v) {
      return stable_proportional_gains(characteristic_polynomial(sampled_of(v)), v[9])
          .front()
          .lower;
    });
  }
  compare("lowest stable D", "continuous (Fig. 3)", plant_inputs(), [](const auto& v) {
    return stable_differential_gains(characteristic_polynomial(plant_of(v)),
                                     decltype(v[0] + v[0])(-557))
        .front()
        .lower;
  });
}

template <class Scalar>
SteadyResponse<Scalar> response_of(const Vector<Scalar, 13>& x) {
  const auto loop = loop_of(x);
  const auto sampled = sampled_of(x);
  const Scalar omega = loop.excitation.angular_frequency();
  return {sampled, harmonic_input(loop.plant, sampled, loop.hold, omega), omega};
}

TEST_F(LoopDigits, OfTheSteadyResponse) {
  for (const SamplingCase& which : samplings) {
    const LoopInputs x = loop_inputs(which.period, which.delay, 0.0);
    compare("steady amplitude", which.name, x,
            [](const auto& v) { return response_of(v).amplitude_per_force(loop_of(v).gains); });
    compare("ratio to no control", which.name, x,
            [](const auto& v) { return response_of(v).ratio_to_uncontrolled(loop_of(v).gains); });
    compare("D of least amplitude", which.name, x, [](const auto& v) {
      const auto stable = stable_differential_gains(characteristic_polynomial(sampled_of(v)), v[8]);
      return response_of(v).best_differential_gain(v[8], stable).differential_gain;
    });
  }
}

/// The point between two, one with and one without, at which a property changes, by bisection to
/// the precision of the type.
template <class Has>
long double change_between(long double with, long double without, const Has& has) {
  EXPECT_TRUE(has(with) && !has(without)) << "the property does not change here";
  for (int step = 0; step < 200; ++step) {
    const long double middle = (with + without) / 2.0L;
    if (middle == with || middle == without) break;
    (has(middle) ? with : without) = middle;
  }
  return with;
}

Vector<long double, 13> sampled_every(LoopInputs x, long double period, long double delay) {
  Vector<long double, 13> wide = x.cast<long double>();
  wide[6] = period;
  wide[7] = delay;
  return wide;
}

TEST_F(LoopDigits, OfTheMarginsOfPeriodAndDelay) {
  // The walk in double against bisection of the spectral radius in long double: two routes.
  const LoopInputs x = loop_inputs(0.001, 0.0, 0.0);
  const auto margins = stability_margins(kollar2022_plant(), {0.001, 0.0}, {-557.0, -13.0});
  const auto stable = [](const Vector<long double, 13>& v) {
    return spectral_radius(sampled_of(v).engaged_map(loop_of(v).gains)) < 1.0L;
  };
  ASSERT_EQ(margins.sampling_period.above.outcome, MarginEndOutcome::boundary);
  const double period = margins.sampling_period.above.position;
  const long double true_period =
      change_between(period * (1.0L - 1e-6L), period * (1.0L + 1e-6L),
                     [&](long double t) { return stable(sampled_every(x, t, 0.0L)); });
  report("longest stable period", "1 ms", trusted_digits(period, true_period), 11.0);

  const auto at_ten = stability_margins(kollar2022_plant(), {0.01, 0.0}, {-557.0, -13.0});
  ASSERT_EQ(at_ten.processing_delay.above.outcome, MarginEndOutcome::boundary);
  const double delay = at_ten.processing_delay.above.position;
  const long double true_delay = change_between(
      delay * (1.0L - 1e-6L), delay * (1.0L + 1e-6L),
      [&](long double t) { return stable(sampled_every(x, static_cast<long double>(0.01), t)); });
  report("longest stable delay", "10 ms", trusted_digits(delay, true_delay), 11.0);
}

TEST_F(LoopDigits, OfTheLargestPeriodThatAttenuates) {
  for (const double frequency : {10.0, 30.0}) {
    MaxDelayOptions options;
    options.frequency = frequency;
    options.proportional_gain = tuned_proportional_gain(74.4, 0.16, frequency);
    const MaxDelay answer = max_sampling_period(kollar2022_plant(), options);
    ASSERT_EQ(answer.outcome, MaxDelayOutcome::found);
    const auto attenuates = [&](long double period) {
      Vector<long double, 13> v =
          sampled_every(loop_inputs(0.01, 0.0, 0.0, frequency), period, 0.0L);
      v[8] = options.proportional_gain;
      const auto stable = stable_differential_gains(characteristic_polynomial(sampled_of(v)), v[8]);
      return response_of(v).best_differential_gain(v[8], stable).ratio_to_uncontrolled < 1.0L;
    };
    const double period = answer.sampling_period;
    report("largest period that attenuates",
           "Fig. 5, " + std::to_string(std::lround(frequency)) + " Hz",
           trusted_digits(period, change_between(period * (1.0L - 1e-6L), period * (1.0L + 1e-6L),
                                                 attenuates)),
           9.0);
  }
}

TEST_F(LoopDigits, OfTheLeastSpectralRadius) {
  for (const SamplingCase& which : samplings) {
    const LoopInputs x = loop_inputs(which.period, which.delay, 0.0);
    const MinimumRadius least = minimum_radius(sampled_of(x), -557.0, -5.0);
    const auto polynomial = loop_polynomial(sampled_of(x.cast<long double>().eval()));
    const auto reached = [&](long double radius) {
      return !polynomial.differential_gains_within(-557.0L, radius - polynomial.centre).empty();
    };
    report("least spectral radius", which.name,
           trusted_digits(least.radius, change_between(least.radius * (1.0L + 1e-6L),
                                                       least.radius * (1.0L - 1e-6L), reached)),
           11.0);
  }
}

TEST_F(LoopDigits, WhereTwoRootsMeetAreAtLeastHalfAsMany) {
  // At the P and D of minimum radius roots meet, and where two do, each answers to the square root
  // of an error: √(1000 ε/2) is what theory promises of the radius at the very same gains.
  for (const SamplingCase& which : samplings) {
    LoopInputs x = loop_inputs(which.period, which.delay, 0.0);
    const auto least_at = [&](double p) { return minimum_radius(sampled_of(x), p); };
    const auto radius_at = [&](double p) { return least_at(p).radius; };
    x[8] = detail::narrow_to_minimum(-800.0, 800.0, 60, radius_at);
    x[9] = least_at(x[8]).differential_gain;
    const auto radius = [](const auto& v) {
      return spectral_radius(sampled_of(v).engaged_map(loop_of(v).gains));
    };
    report("spectral radius at its least", which.name,
           trusted_digits(radius(x), radius(x.cast<long double>().eval())),
           -0.5 * std::log10(500.0 * std::numeric_limits<double>::epsilon()));
  }
}

TEST_F(LoopDigits, OfTheFeaturesOfTheBoundary) {
  // Tangents, cusps, crossings and ends, found again in long double: as many, at the same gains. A
  // crossing of a curve with itself and a cusp are double roots: half the digits.
  const GainWindow window{{-900.0, 300.0}, {-60.0, 20.0}};
  for (const SamplingCase& which : samplings) {
    const LoopInputs x = loop_inputs(which.period, which.delay, 0.0);
    const auto narrow = boundary_features(characteristic_polynomial(sampled_of(x)), window);
    const auto wide = boundary_features(
        characteristic_polynomial(sampled_of(x.cast<long double>().eval())), window);
    ASSERT_EQ(narrow.size(), wide.size()) << which.name;
    double least = most_trusted_digits;
    for (std::size_t k = 0; k < narrow.size(); ++k) {
      ASSERT_EQ(narrow[k].kind, wide[k].kind) << which.name << " " << k;
      const auto& found = narrow[k].gains;
      const auto& there = wide[k].gains;
      least = std::min(
          least,
          trusted_digits(Vector<double, 2>(found.proportional, 40.0 * found.differential),
                         Vector<long double, 2>(there.proportional, 40.0L * there.differential)));
    }
    report("gains of boundary features (" + std::to_string(narrow.size()) + ")", which.name, least,
           7.0);
  }
}

}  // namespace
}  // namespace holdfast::loop_digits
