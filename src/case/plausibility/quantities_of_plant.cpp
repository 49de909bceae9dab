#include <algorithm>
#include <cmath>
#include <complex>

#include "case/model/cable_of_case.hpp"
#include "case/plausibility/words.hpp"

namespace holdfast::program {
namespace {

using namespace plausibility;

/// |z1| of the steady vibration without control, m.
double free_amplitude(const Case& c) {
  const case_tables::Plant& p = c.plant;
  const double omega = two_pi * force_frequency(c), square = omega * omega;
  const std::complex<double> spring{p.absorber_stiffness, omega * p.absorber_damping};
  const std::complex<double> ground{p.conductor_stiffness - p.conductor_mass * square,
                                    omega * p.conductor_damping};
  const std::complex<double> absorber = spring - p.absorber_mass * square;
  return effective_excitation(c).amplitude / std::abs(ground + spring - spring * spring / absorber);
}

/// The largest circular frequency that control has to do with, 1/s.
double highest_frequency(const Case& c) {
  return two_pi * std::max(force_frequency(c), undamped_frequencies(c.plant)[1]);
}

/// |P| beside that of Eq. 6, which is not taken as less than a tenth of m2 ω².
double proportional_share(const Case& c) {
  const double gain = std::abs(c.control.proportional_gain);
  if (c.control.proportional_gain_tuned || gain == 0.0) return unknown;
  const double inertia = c.plant.absorber_mass * std::pow(highest_frequency(c), 2);
  return gain / std::max(std::abs(c.plant.absorber_stiffness - inertia), 0.1 * inertia);
}

double differential_share(const Case& c) {
  const double gain = std::abs(c.control.differential_gain);
  return gain == 0.0 ? unknown : gain / (c.plant.absorber_mass * highest_frequency(c));
}

double damping_ratio(double damping, double stiffness, double mass) {
  return damping / (2.0 * std::sqrt(stiffness * mass));
}

const Quantities listed_of_plant = {
    {"plant.conductor_mass over that of the conductor",
     "",
     {"plant.conductor_mass", "conductor.mass_per_length", "reduction.first_frequency"},
     [](const Case& c) {
       return c.conductor_given ? c.plant.conductor_mass * c.conductor.gravity / weight_of(c)
                                : unknown;
     },
     {1e-5, 10},
     whatever,
     "what moves in a mode is a part of the span"},
    {"plant.absorber_mass over plant.conductor_mass",
     "",
     {"plant.absorber_mass", "plant.conductor_mass", "absorber.mass"},
     [](const Case& c) { return c.plant.absorber_mass / c.plant.conductor_mass; },
     {1e-5, 100},
     whatever,
     "absorbers have 0.001 to 10 of the mass that they calm"},
    {"absorber.clamp_mass over plant.absorber_mass",
     "",
     {"absorber.clamp_mass", "plant.absorber_mass"},
     [](const Case& c) { return c.absorber.clamp_mass / c.plant.absorber_mass; },
     at_most(2),
     whatever,
     "a clamp is a part of what hangs on the conductor"},
    {"the higher natural frequency of the plant over the lower",
     "",
     {"plant.conductor_stiffness", "plant.absorber_stiffness", "plant.conductor_mass",
      "plant.absorber_mass", "reduction.first_frequency", "reduction.second_frequency"},
     [](const Case& c) {
       const auto frequencies = undamped_frequencies(c.plant);
       return frequencies[1] / frequencies[0];
     },
     at_most(20),
     whatever,
     "an absorber is tuned to what it calms"},
    {"c1 over its critical value",
     "",
     {"plant.conductor_damping", "plant.conductor_stiffness"},
     [](const Case& c) {
       const auto& p = c.plant;
       return damping_ratio(p.conductor_damping, p.conductor_stiffness, p.conductor_mass);
     },
     at_most(1),
     whatever,
     "cables have 0.0001 to 0.03"},
    {"c2 over its critical value",
     "",
     {"plant.absorber_damping", "plant.absorber_stiffness"},
     [](const Case& c) {
       const auto& p = c.plant;
       return damping_ratio(p.absorber_damping, p.absorber_stiffness, p.absorber_mass);
     },
     at_most(30),
     whatever,
     "a damper so stiff holds the absorber fast"},
    {"the frequency of the force over the higher one of the plant",
     "",
     {"excitation.frequency", "wind.speed", "wind.diameter", "plant.conductor_stiffness",
      "plant.absorber_stiffness", "plant.conductor_mass", "plant.absorber_mass"},
     [](const Case& c) {
       return plant_is_reduced(c) ? unknown : force_frequency(c) / undamped_frequencies(c.plant)[1];
     },
     at_most(5),
     whatever,
     "so fast a force hardly moves a plant of two masses"},
    {"control.sampling_period over the longest period of the plant",
     "",
     {"control.sampling_period", "plant.conductor_stiffness"},
     [](const Case& c) { return c.control.sampling_period * undamped_frequencies(c.plant)[0]; },
     at_most(1),
     whatever,
     "from 0.5 on the computer sees none of its vibrations"},
    {"control.proportional_gain beside that of Eq. 6",
     "",
     {"control.proportional_gain"},
     proportional_share,
     {1.6e-3, 200},
     whatever,
     "one so much smaller does nothing, one so much larger only disturbs"},
    {"control.differential_gain over m2 omega",
     "",
     {"control.differential_gain"},
     differential_share,
     {3e-3, 500},
     whatever,
     "one so much smaller does nothing, one so much larger only disturbs"},
    {"the vibration without control over the reach of the absorber's place",
     "",
     {"excitation.amplitude", "wind.speed", "wind.diameter", "wind.effective_length",
      "plant.conductor_stiffness", "excitation.frequency"},
     [](const Case& c) { return free_amplitude(c) / reach_of_absorber(c); },
     at_most(1),
     whatever,
     reach_reason},
};

}  // namespace

std::array<double, 2> undamped_frequencies(const case_tables::Plant& plant) {
  const double first =
      (plant.conductor_stiffness + plant.absorber_stiffness) / plant.conductor_mass;
  const double second = plant.absorber_stiffness / plant.absorber_mass;
  // ω² = s ± √(d² + k2²/(m1 m2)); the lower from the product k1 k2/(m1 m2), without cancellation.
  const double coupling = plant.absorber_stiffness / plant.conductor_mass * second;
  const double high =
      0.5 * (first + second) + std::sqrt(0.25 * (first - second) * (first - second) + coupling);
  const double low = plant.conductor_stiffness / plant.conductor_mass * (second / high);
  return {std::sqrt(low) / plausibility::two_pi, std::sqrt(high) / plausibility::two_pi};
}

const std::vector<PlausibleQuantity>& quantities_of_plant() { return listed_of_plant; }

}  // namespace holdfast::program
