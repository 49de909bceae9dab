#pragma once

#include "holdfast/core/types.hpp"
#include "holdfast/excitation/harmonic_input.hpp"
#include "holdfast/motion/ideal_loop.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "support/property.hpp"
#include "support/random_loop.hpp"

namespace holdfast::test {

/// A loop with its excitation, its backlash and a state to begin with.
struct LoopCase {
  TwoMass<double> plant{};
  double period = 0.0;
  double delay_share = 0.0;  // δ/τ
  PdGains<double> gains{};
  HarmonicExcitation<double> excitation{};
  double width = 0.0;
  Vector<double, 4> state = Vector<double, 4>::Zero();
  int samples = 0;
  int exact_hold = 0;  // 1: the force is followed over the sample

  Sampling<double> sampling() const { return {period, delay_share * period}; }
  ForceHold hold() const { return exact_hold != 0 ? ForceHold::exact : ForceHold::sampled; }
  IdealLoop<double> loop() const { return {plant, sampling(), gains, excitation, width, hold()}; }

  std::vector<Parameter> parameters() {
    return {{"m1 (kg)", &plant.conductor_mass, 1.0},
            {"k1 (N/m)", &plant.conductor_stiffness, 1.0},
            {"c1 (N s/m)", &plant.conductor_damping},
            {"m2 (kg)", &plant.absorber_mass, 1.0},
            {"k2 (N/m)", &plant.absorber_stiffness, 1.0},
            {"c2 (N s/m)", &plant.absorber_damping},
            {"tau (s)", &period, 1.0},
            {"delay / tau", &delay_share},
            {"P (N/m)", &gains.proportional},
            {"D (N s/m)", &gains.differential},
            {"F_m (N)", &excitation.amplitude},
            {"f (Hz)", &excitation.frequency, 1.0},
            {"r0 (m)", &width},
            {"z1 (m)", &state[0]},
            {"z1' (m/s)", &state[1]},
            {"z2 (m)", &state[2]},
            {"z2' (m/s)", &state[3]},
            {"samples", &samples},
            {"exact hold", &exact_hold}};
  }
};

/// Masses 0.01 … 100 kg, frequencies of the two parts alone 0.5 … 50 Hz, damping ratios 0 … 50 %,
/// one in ten undamped.
inline TwoMass<double> wide_plant(Random& random) {
  TwoMass<double> plant{};
  const auto draw_part = [&random](double& mass, double& stiffness, double& damping) {
    const double omega = 2.0 * pi<double> * random.log_uniform(0.5, 50.0);
    const double ratio = random.unit() < 0.1 ? 0.0 : random.log_uniform(1e-3, 0.5);
    mass = random.log_uniform(0.01, 100.0);
    stiffness = mass * omega * omega;
    damping = 2.0 * ratio * mass * omega;
  };
  draw_part(plant.conductor_mass, plant.conductor_stiffness, plant.conductor_damping);
  draw_part(plant.absorber_mass, plant.absorber_stiffness, plant.absorber_damping);
  return plant;
}

/// Sampling and gains as the tests of stability have them, a force and a state that move the masses
/// about as far as each other, and a backlash of a thousandth of that up to ten times it.
inline LoopCase random_loop_case(Random& random) {
  LoopCase drawn;
  drawn.plant = wide_plant(random);
  const Sampling<double> sampling = random_sampling(drawn.plant, random);
  drawn.period = sampling.period;
  drawn.delay_share = sampling.processing_delay / sampling.period;
  if (drawn.delay_share > 1.0) drawn.delay_share = 1.0;
  drawn.gains = random_gains(drawn.plant, drawn.period, random);
  drawn.excitation = {random.log_uniform(1e-3, 1e3), random.log_uniform(0.2, 100.0)};
  const double size = drawn.excitation.amplitude / drawn.plant.conductor_stiffness;
  const double omega = std::sqrt(drawn.plant.conductor_stiffness / drawn.plant.conductor_mass);
  drawn.width = size * random.log_uniform(1e-3, 10.0);
  const double push = size * random.log_uniform(0.1, 10.0);
  const Vector<double, 4> direction = random.matrix<Vector<double, 4>>();
  drawn.state << push * direction[0], push * omega * direction[1], push * direction[2],
      push * omega * direction[3];
  drawn.samples = 20 + static_cast<int>(random.index(180));
  drawn.exact_hold = static_cast<int>(random.index(2));
  return drawn;
}

/// A property that holds in every random case, or in more than a share of them where it says
/// nothing of the others.
template <class Generate, class Check>
void expect_property(std::uint64_t seed, std::int64_t ordinarily, const Generate& generate,
                     const Check& check, double share = 1.0) {
  const std::int64_t draws = property_draws(ordinarily);
  const auto held = static_cast<double>(for_all(seed, draws, generate, check).held);
  const double all = static_cast<double>(draws);
  EXPECT_TRUE(share < 1.0 ? held > share * all : held == all) << held << " of " << draws;
}

/// The first of some outcomes that is not that the property holds.
inline PropertyOutcome all_of(const std::vector<PropertyOutcome>& outcomes) {
  for (const PropertyOutcome& outcome : outcomes)
    if (outcome.kind != PropertyOutcome::Kind::holds) return outcome;
  return holds();
}

/// Whether a state is still one to compare: an unstable loop leaves the range of numbers.
inline bool is_moderate(const Vector<double, 4>& state) {
  return state.cwiseAbs().maxCoeff() < 1e100;
}

/// What a sampled motion shows at a sample, to the last bit.
template <class Sample>
bool same_sample(const Sample& a, const Sample& b) {
  return a.state == b.state && a.control_force == b.control_force && a.engaged == b.engaged;
}

/// "sample 12: 1.25 instead of 1.5", in full precision.
inline std::string differs(const std::string& where, double found, double expected) {
  std::ostringstream text;
  text.precision(17);
  text << where << ": " << found << " instead of " << expected;
  return text.str();
}

}  // namespace holdfast::test
