// Proved margins against the spectral radius of the loop's map, of two masses, strings, filtered
// and late loops, and against the margins that doubles walk.

#include "holdfast/stability/margins/proved_margins.hpp"

#include "holdfast/control/loop_map.hpp"
#include "holdfast/math/linalg/spectral_radius.hpp"
#include "holdfast/plant/linear_plant.hpp"
#include "holdfast/stability/design/max_delay.hpp"
#include "holdfast/stability/design/proved_max_delay.hpp"
#include "holdfast/stability/margins/modal_margins.hpp"
#include "support/margin_ends.hpp"
#include "support/random_loop.hpp"
#include "support/string_case.hpp"

namespace holdfast::test {
namespace {

constexpr auto unwatched = [] {};

/// A loop, by its poles for the proof and by its matrices for what tries it.
struct ProvedLoop {
  std::vector<EnclosedPole> poles;
  std::vector<PlantPole> approximate;
  LinearPlant<double> plant;
  Sampling<double> sampling;
  PdGains<double> gains;

  ProvedLoop(const ConductorWithAbsorber& conductor, Sampling<double> s, PdGains<double> g)
      : poles(enclosed_poles(conductor)),
        approximate(with_hardware(conductor.poles, conductor.hardware)),
        plant(linear_plant(conductor)),
        sampling(s),
        gains(g) {}

  double radius(const Sampling<double>& s, const PdGains<double>& g) const {
    return spectral_radius(loop_map(plant, s).closed_map(g));
  }
  double radius_at_period(double period) const {
    return radius({period, sampling.processing_delay / sampling.period * period}, gains);
  }
  double radius_at_delay(double delay) const { return radius({sampling.period, delay}, gains); }
  StabilityMargins walked() const {
    return modal_stability_margins<double>(approximate, sampling, gains);
  }
  ProvedMargins proved(double resolution = 1e-5) const {
    return proved_margins(poles, sampling, gains, walked(), {resolution}, unwatched);
  }
};

std::vector<ProvedLoop> proved_loops() {
  return {{string_with_absorber(1, 0.02), {0.001, 0.0}, {-200.0, -4.0}},
          {string_with_absorber(6, 0.02), {0.002, 0.0013}, {-200.0, -2.0}},
          {string_with_absorber(4, 0.01), {0.002, 0.0047}, {-50.0, -1.0}},
          {string_with_absorber(3, 0.02, {80.0, 60.0, 0.7}), {0.003, 0.003}, {-100.0, -1.0}}};
}

/// A path of which nothing, or all up to a place, can be proved.
struct PathTo {
  double last;

  bool keeps_stability(double, double to) const { return to <= last; }
  ProvedStability at(double) const { return ProvedStability::undecided; }
};

TEST(ProvedMargins, SayWhyTheyGoNoFurther) {
  const auto walked = [](double last, int steps) {
    return detail::walked_end(PathTo{last}, 1.0, 2.0, {1e-6, steps}, unwatched);
  };
  EXPECT_EQ(walked(2.0, 1000).stop, ProofStop::at_end);
  EXPECT_EQ(walked(2.0, 3).stop, ProofStop::work);
  EXPECT_EQ(walked(1.5, 1000).stop, ProofStop::undecided);
  EXPECT_NEAR(walked(1.5, 1000).stable_to, 1.5, 1e-5);
  const ProvedMarginEnd nothing = walked(1.0, 1000);
  EXPECT_EQ(nothing.stop, ProofStop::undecided);
  EXPECT_EQ(nothing.stable_to, 1.0);
  EXPECT_TRUE(std::isnan(nothing.unstable_at));
}

/// That all of a stretch is stable and what is just beyond is not, by spectral radii.
template <class RadiusAt>
void expect_end(const ProvedMarginEnd& end, double value, const RadiusAt& radius_at) {
  for (int k = 0; k <= 40; ++k) {
    const double position = value + k / 40.0 * (end.stable_to - value);
    EXPECT_LT(radius_at(position), 1.0 + 1e-11) << position;
  }
  if (std::isfinite(end.unstable_at)) {
    EXPECT_GT(radius_at(end.unstable_at), 1.0 - 1e-11);
  }
}

/// Proved margins of D, P, τ and δ, in this order.
std::array<ProvedMargin, 4> margins_of(const ProvedMargins& proved) {
  return {proved.differential_gain, proved.proportional_gain, proved.sampling_period,
          proved.processing_delay};
}

TEST(ProvedMargins, HoldByTheSpectralRadius) {
  for (const ProvedLoop& loop : proved_loops()) {
    const ProvedMargins proved = loop.proved();
    ASSERT_EQ(proved.stability, ProvedStability::stable);
    const auto moved = all_moved(loop.walked(), loop.plant, loop.sampling, loop.gains);
    const auto ends = margins_of(proved);
    for (std::size_t k = 0; k < ends.size(); ++k) {
      SCOPED_TRACE(moved[k].name);
      expect_end(ends[k].below, moved[k].value, moved[k].radius);
      expect_end(ends[k].above, moved[k].value, moved[k].radius);
    }
  }
}

/// The boundary that doubles find lies in the gap, which is as narrow as was asked.
TEST(ProvedMargins, LeaveALittleAboutTheBoundaryUndecided) {
  constexpr double resolution = 1e-6;
  for (const ProvedLoop& loop : proved_loops()) {
    const ProvedMargins proved = loop.proved(resolution);
    const StabilityMargins walked = loop.walked();
    const auto expect_around = [&](const ProvedMarginEnd& end, const MarginEnd& found) {
      if (found.outcome != MarginEndOutcome::boundary) return;
      const auto [least, most] = std::minmax(end.stable_to, end.unstable_at);
      const double rounding = 1e-8 * std::abs(found.position);
      EXPECT_GE(found.position, least - rounding);
      EXPECT_LE(found.position, most + rounding);
      EXPECT_LT(most - least, 50.0 * resolution * found.distance);
    };
    const auto ends = margins_of(proved);
    const auto found = two_sided_of(walked);
    for (std::size_t k = 0; k < ends.size(); ++k) {
      if (k < 2) expect_around(ends[k].below, found[k].below);
      expect_around(ends[k].above, found[k].above);
    }
  }
}

/// A window of instability of τ that steps of 5 % pass over ends the proof, and is put right.
TEST(ProvedMargins, PassOverNoWindow) {
  const ProvedLoop loop(string_with_absorber(8, 1e-3), {0.00063, 0.0}, {-99.0, -3.5});
  const MarginEnd walked = loop.walked().sampling_period.above;
  const ProvedMarginEnd proved = loop.proved().sampling_period.above;
  ASSERT_TRUE(std::isfinite(proved.unstable_at));
  EXPECT_LT(proved.unstable_at, 0.99 * walked.position);
  EXPECT_GT(loop.radius_at_period(proved.unstable_at), 1.0);
  const MarginEnd right = modal_margin_end<double>(loop.approximate, loop.sampling, loop.gains,
                                                   proved.stable_to, proved.unstable_at, true);
  EXPECT_EQ(right.outcome, MarginEndOutcome::boundary);
  EXPECT_GE(right.position, proved.stable_to);
  EXPECT_LE(right.position, proved.unstable_at);
  EXPECT_NEAR(loop.radius_at_period(right.position), 1.0, 1e-7);
}

TEST(ProvedMargins, AreNotOfALoopThatIsUnstableOrOnTheBoundary) {
  const ProvedLoop stable(string_with_absorber(4, 0.02), {0.001, 0.0}, {-200.0, -2.0});
  const StabilityMargins walked = stable.walked();
  const auto at = [&](double d) {
    return proved_margins(stable.poles, stable.sampling, {-200.0, d}, walked, {1e-4}, unwatched);
  };
  const double edge = walked.differential_gain.above.position;
  EXPECT_EQ(at(edge + 1e-3).stability, ProvedStability::unstable);
  EXPECT_TRUE(std::isnan(at(edge + 1e-3).sampling_period.above.stable_to));
  EXPECT_EQ(at(edge - 1e-3).stability, ProvedStability::stable);
  EXPECT_EQ(at(edge).stability, ProvedStability::undecided);
}

/// Two masses over decades that are stable, δ < τ, with their margins in doubles.
struct RandomMasses {
  TwoMass<double> plant;
  Sampling<double> sampling;
  PdGains<double> gains;
  StabilityMargins walked;
  std::vector<EnclosedPole> poles;
};

std::vector<RandomMasses> random_masses(std::uint64_t seed, int trials) {
  Random random(seed);
  std::vector<RandomMasses> stable;
  for (int trial = 0; trial < trials; ++trial) {
    const TwoMass<double> plant = random_plant(random);
    const Sampling<double> sampling = random_sampling(plant, random);
    const PdGains<double> gains = random_gains(plant, sampling.period, random);
    const auto poles = enclosed_poles(plant);
    if (sampling.processing_delay >= sampling.period || poles.empty()) continue;
    const StabilityMargins walked = stability_margins(plant, sampling, gains);
    if (walked.outcome != MarginOutcome::stable) continue;
    stable.push_back({plant, sampling, gains, walked, poles});
  }
  return stable;
}

/// Two masses over decades, in extended precision.
TEST(ProvedMargins, OfRandomMassesHoldInExtendedPrecision) {
  int proved_loops = 0;
  for (const auto& loop : random_masses(5, 200)) {
    const auto& [plant, sampling, gains, walked, poles] = loop;
    if (gains.differential > 0.0) continue;
    const ProvedMargins proved = proved_margins(poles, sampling, gains, walked, {1e-4}, unwatched);
    if (proved.stability != ProvedStability::stable) continue;
    ++proved_loops;
    const double share = sampling.processing_delay / sampling.period;
    expect_end(proved.sampling_period.above, sampling.period, [&, &masses = loop](double tau) {
      return 1.0 + growth(masses.plant, {tau, share * tau}, masses.gains).excess;
    });
    expect_end(proved.differential_gain.below, gains.differential, [&masses = loop](double d) {
      const PdGains<double> moved{masses.gains.proportional, d};
      return 1.0 + growth(masses.plant, masses.sampling, moved).excess;
    });
  }
  EXPECT_GT(proved_loops, 20);
}

/// Strings with and without a filter, on time and late: wherever a stretch is proved, all loops in
/// it are stable, and short stretches of stable loops are proved.
TEST(SamplingProof, OfRandomStringsHoldsByTheSpectralRadius) {
  Random random(9);
  int short_ones = 0, proved_short_ones = 0, long_ones = 0, proved_long_ones = 0;
  while (short_ones < 150) {
    const LoopHardware hardware =
        random.index(3) > 0
            ? LoopHardware{}
            : LoopHardware{random.uniform(30.0, 300.0), random.uniform(50.0, 3e4), 0.7};
    const auto modes = static_cast<int>(1 + random.index(7));
    const double period = random.log_uniform(2e-4, 2e-2);
    const double delay = period * std::vector<double>{0.0, 0.4, 1.0, 1.7, 2.0}[random.index(5)];
    const ProvedLoop loop(string_with_absorber(modes, random.log_uniform(1e-4, 2e-2), hardware),
                          {period, delay},
                          {-random.log_uniform(10.0, 500.0), -random.log_uniform(0.1, 10.0)});
    if (loop.poles.empty() || !(loop.radius(loop.sampling, loop.gains) < 1.0 - 1e-6)) continue;
    const bool of_period = random.index(2) == 0;
    const SamplingProof<double> proof(
        loop.poles, loop.gains,
        of_period ? EnclosedSamplings::of_period(loop.sampling)
                  : EnclosedSamplings::of_delay(period, held_commands(loop.sampling)));
    const double value = of_period ? period : delay;
    const auto radius_at = [&](double position) {
      return of_period ? loop.radius_at_period(position) : loop.radius_at_delay(position);
    };
    const auto is_held = [&](double length) {
      // Within the stretch in which as many commands are on their way.
      const double from = value - (of_period || delay > 0.0 ? length * period : 0.0);
      const double to = from + length * period;
      const bool proved = proof.is_stable(from, to);
      for (int k = 0; proved && k <= 12; ++k)
        EXPECT_LT(radius_at(from + k / 12.0 * (to - from)), 1.0 + 1e-11);
      return proved;
    };
    ++short_ones;
    proved_short_ones += is_held(1e-5) ? 1 : 0;
    for (double length = 1e-3; length < 0.5; length *= 3.0) {
      ++long_ones;
      proved_long_ones += is_held(length) ? 1 : 0;
    }
  }
  EXPECT_GE(proved_short_ones, 147);
  EXPECT_GE(proved_long_ones, long_ones / 3);
}

/// W_i from the eigenvalues of the loop's map, Π_k (z_i − λ_k)/Π_{l≠i} (z_i − z_l), are within
/// their bounds at every position, and not far within.
TEST(SamplingProof, CorrectionsAreThoseOfTheEigenvalues) {
  int sharp = 0, asked = 0;
  for (const ProvedLoop& loop : proved_loops()) {
    const SamplingProof<double> proof(loop.poles, loop.gains,
                                      EnclosedSamplings::of_period(loop.sampling));
    const double from = loop.sampling.period, to = 1.05 * from;
    const auto nodes = proof.nodes_over(from, to);
    ASSERT_FALSE(nodes.empty());
    std::vector<double> most(nodes.size(), 0.0);
    for (const double t : {-1.0, -0.5, 0.3, 1.0}) {
      std::vector<std::complex<double>> places;
      for (const auto& node : nodes)
        places.push_back(node.path.start().middle() * std::exp(node.path.rate().middle() * t));
      const double period = 0.5 * (from + to) + 0.5 * (to - from) * t;
      const double delay = loop.sampling.processing_delay / loop.sampling.period * period;
      const Eigen::VectorXcd roots =
          loop_map(loop.plant, {period, delay}).closed_map(loop.gains).eigenvalues();
      ASSERT_EQ(static_cast<std::size_t>(roots.size()), nodes.size());
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        std::complex<double> correction = 1.0;
        for (std::size_t l = 0; l < nodes.size(); ++l) {
          correction *= places[i] - roots[static_cast<Eigen::Index>(l)];
          if (l != i) correction /= places[i] - places[l];
        }
        most[i] = std::max(most[i], std::abs(correction));
      }
    }
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      EXPECT_LE(most[i], nodes[i].correction * (1.0 + 1e-6) + 1e-11) << i;
      if (most[i] < 1e-9) continue;
      ++asked;
      sharp += nodes[i].correction < 100.0 * most[i] ? 1 : 0;
    }
  }
  EXPECT_GT(asked, 20);
  EXPECT_GE(sharp, asked / 2) << asked;
}

/// Nodes and poles are in one order, also of poles that die out within a sample.
TEST(SamplingProof, CountsPolesThatDieOutWithinASample) {
  const ProvedLoop loop(string_with_absorber(3, 0.02, {80.0}), {0.02, 0.007}, {-10.0, -1.0});
  const auto line = EnclosedSamplings::of_period(loop.sampling);
  EXPECT_TRUE(SamplingProof<double>(loop.poles, loop.gains, line).is_stable(0.02, 0.022));
}

TEST(SamplingProof, IsOfNoStretchWithAnUnstableLoop) {
  for (const ProvedLoop& loop : proved_loops()) {
    const MarginEnd edge = loop.walked().sampling_period.above;
    if (edge.outcome != MarginEndOutcome::boundary) continue;
    const SamplingProof<double> proof(loop.poles, loop.gains,
                                      EnclosedSamplings::of_period(loop.sampling));
    const double beyond = 1.0 + 1e-7;
    for (const double share : {0.5, 0.9, 0.99, 0.999, 0.9999, 0.999999})
      EXPECT_FALSE(proof.is_stable(share * edge.position, beyond * edge.position)) << share;
    EXPECT_TRUE(proof.is_stable(0.999 * edge.position, 0.9992 * edge.position));
  }
}

/// Of random masses, across both ends of the period and of the delay: whichever way the roots bend
/// as they leave, a tangent would not tell.
TEST(SamplingProof, IsOfNoStretchAcrossAnEndOfRandomMasses) {
  int asked = 0;
  for (const RandomMasses& loop : random_masses(8, 600)) {
    const auto expect_none = [&](const EnclosedSamplings& line, const MarginEnd& end,
                                 double value) {
      if (end.outcome != MarginEndOutcome::boundary) return;
      const SamplingProof<double> proof(loop.poles, loop.gains, line);
      const double beyond = end.position + 1e-6 * (end.position - value);
      for (double share = 1.0; share > 1e-3; share *= 0.7) {
        const auto [from, to] = std::minmax(beyond, end.position + share * (value - end.position));
        EXPECT_FALSE(proof.is_stable(from, to)) << from << " " << to;
        ++asked;
      }
    };
    const auto period = EnclosedSamplings::of_period(loop.sampling);
    expect_none(period, loop.walked.sampling_period.below, loop.sampling.period);
    expect_none(period, loop.walked.sampling_period.above, loop.sampling.period);
    const auto delay = EnclosedSamplings::of_delay(loop.sampling.period, 1);
    expect_none(delay, loop.walked.processing_delay.below, loop.sampling.processing_delay);
    expect_none(delay, loop.walked.processing_delay.above, loop.sampling.processing_delay);
  }
  EXPECT_GT(asked, 500);
}

/// All periods up to the one that is proved have a stable D, and it is nearly the largest.
TEST(ProvedMaxSamplingPeriod, IsNextToTheLargest) {
  const TwoMass<double> plant = kollar2022_plant();
  for (const double frequency : {8.0, 14.0, 40.0}) {
    MaxDelayOptions question{};
    question.frequency = frequency;
    question.proportional_gain =
        tuned_proportional_gain(plant.absorber_stiffness, plant.absorber_mass, frequency);
    question.criterion = DelayCriterion::stable;
    const double largest = max_sampling_period(plant, question).sampling_period;
    const auto gains_at = [&](double period) {
      return feasible_differential_gains(plant, question, period);
    };
    const double proved = proved_max_sampling_period(
        enclosed_poles(plant), question.proportional_gain,
        EnclosedSamplings::of_period({0.001, 0.0}), {1e-5, 1.1 * largest}, gains_at, unwatched);
    EXPECT_LE(proved, largest * (1.0 + 1e-12));
    EXPECT_GT(proved, 0.999 * largest);
  }
}

}  // namespace
}  // namespace holdfast::test
