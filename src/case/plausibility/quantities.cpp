#include "case/plausibility/quantities.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <utility>

#include "case/model/cable_of_case.hpp"
#include "holdfast/core/types.hpp"

namespace holdfast::program {
namespace {

using case_tables::Wind;
using Quantities = std::vector<PlausibleQuantity>;

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr double two_pi = 2.0 * pi<double>;
constexpr AdmissibleRange whatever{};

constexpr AdmissibleRange at_most(double highest) {
  return {-std::numeric_limits<double>::infinity(), highest};
}
constexpr AdmissibleRange at_least(double lowest) { return {lowest}; }

/// A quantity with its usual and possible ranges.
PlausibleQuantity quantity(const char* name, const char* unit, std::vector<std::string> keys,
                           double (*of)(const Case&), const AdmissibleRange& usual,
                           const char* reason, const AdmissibleRange& possible = whatever,
                           bool asks_unit = true) {
  return {name, unit, std::move(keys), of, usual, possible, reason, asks_unit};
}

/// A quantity that is the value of one key.
PlausibleQuantity number_of(const char* key, const char* unit, double (*of)(const Case&),
                            const AdmissibleRange& usual, const char* reason,
                            const AdmissibleRange& possible = whatever) {
  return quantity(key, unit, {key}, of, usual, reason, possible);
}

/// Weight of the whole conductor, N.
double weight_of(const Case& c) {
  return c.conductor.mass_per_length * c.conductor.gravity * c.conductor.span;
}

double force_frequency(const Case& c) { return effective_excitation(c).frequency; }

/// A finite value, else NaN: infinity means "unknown".
double known(double value) { return std::isfinite(value) ? value : unknown; }

double largest_displacement(const Case& c) {
  return std::max(std::abs(c.initial.z1), std::abs(c.initial.z2));
}

/// The value if the case has a cable of its own; NaN for the built-in cable.
double of_own_cable(const Case& c, double value) { return has_own_cable(c) ? value : unknown; }

template <double Wind::*Member>
double of_wind(const Case& c) {
  return c.wind ? (*c.wind).*Member : unknown;
}

/// The conductor's metal area divided by that of a circle of the given diameter.
double filled_share(const Case& c, double diameter) {
  return 8.0 * c.conductor.area / (two_pi * diameter * diameter);
}

constexpr bool asks_no_unit = false;
constexpr const char* reach_reason =
    "the reach is half the distance from the nearer support, or 3 m if the case gives "
    "only "
    "[plant]; vibrations are 1e-5 to 0.1 of the reach";
constexpr const char* usual_diameters =
    "lines have 0.005 to 0.06, stays 0.1 to 0.3, cables of suspension bridges up to 1.1";
constexpr const char* usual_shares =
    "a rod has 1, a strand 0.75, a sheathed stay 0.3, a model under foam 0.01";

/// The quantities of a case. Those of one key come first, so that a mistake is blamed on its key.
const Quantities listed_of_case = {
    number_of(
        "conductor.youngs_modulus", "Pa", [](const Case& c) { return c.conductor.youngs_modulus; },
        {1e7, 1e12},
        "rubber has 1e7, polymer ropes 1e9, aluminium 7e10, steel 2.1e11, diamond 1.1e12"),
    number_of(
        "conductor.span", "m", [](const Case& c) { return c.conductor.span; }, {0.05, 8000},
        "the longest span of a line is 5400 m; a steel wire of 28000 m breaks under its own weight",
        at_most(1e5)),
    number_of(
        "conductor.gravity", "m/s2", [](const Case& c) { return c.conductor.gravity; }, {0.05, 30},
        "gravity is 9.81 on earth; its component across a steep stay is less"),
    number_of(
        "conductor.damping_ratio", "", [](const Case& c) { return c.conductor.damping_ratio; },
        at_most(0.2), "cables have 0.0001 to 0.03"),
    number_of("conductor.diameter", "m", [](const Case& c) { return known(c.conductor.diameter); },
              {1e-4, 1.5}, usual_diameters, {1e-6, 10}),
    number_of(
        "conductor.outer_wire_modulus", "Pa",
        [](const Case& c) { return known(c.conductor.outer_wire_modulus); }, {1e9, 1e12},
        "aluminium has 7e10, steel 2e11"),
    quantity(
        "conductor.outer_wire_diameter / conductor.diameter", "",
        {"conductor.outer_wire_diameter", "conductor.diameter"},
        [](const Case& c) {
          return known(c.conductor.outer_wire_diameter / known(c.conductor.diameter));
        },
        {1e-3, 1}, "seven wires have 0.33, sixty-one 0.11, a stay of a hundred strands 0.03"),
    number_of("wind.speed", "m/s", of_wind<&Wind::speed>, {0.005, 90},
              "the strongest gust on record had 113 m/s", at_most(150)),
    number_of("wind.diameter", "m", of_wind<&Wind::diameter>, {1e-4, 1.5}, usual_diameters,
              {1e-6, 10}),
    quantity(
        "wind.effective_length / conductor.span", "", {"wind.effective_length"},
        [](const Case& c) {
          return of_own_cable(c, of_wind<&Wind::effective_length>(c) / c.conductor.span);
        },
        at_most(1.01), "the wind acts on no more than the span"),
    number_of("wind.strouhal", "", of_wind<&Wind::strouhal>, {0.05, 0.6},
              "a circular cylinder has 0.18 to 0.22, beyond the drag crisis up to 0.5"),
    number_of("wind.lift_coefficient", "", of_wind<&Wind::lift_coefficient>, at_most(5),
              "a cylinder at rest has 0.3 to 0.6, a moving cylinder up to 2"),
    number_of("wind.air_density", "kg/m3", of_wind<&Wind::air_density>, {0.3, 1100},
              "air has 0.4 (at a height of 10 km) to 1.4, water 1000"),
    number_of(
        "site.weibull_scale", "m/s", [](const Case& c) { return known(c.site.weibull_scale); },
        {0.5, 25},
        "the mean speed is 0.89 of the scale; sheltered places have 2, mountain tops 15"),
    number_of(
        "site.weibull_shape", "", [](const Case& c) { return c.site.weibull_shape; }, {0.8, 6},
        "wind has 1.2 to 3, trade winds 4"),
    number_of(
        "site.turbulence_intensity", "", [](const Case& c) { return c.site.turbulence_intensity; },
        at_most(0.6), "open water has 0.05, towns 0.4"),
    number_of(
        "site.years", "years", [](const Case& c) { return c.site.years; }, {0.01, 500},
        "lines are built for 40 to 100"),
    number_of(
        "control.sampling_period", "s", [](const Case& c) { return c.control.sampling_period; },
        at_least(1e-6), "controllers of machines take 100 to 100000 samples a second"),
    quantity(
        "control.processing_delay / control.sampling_period", "",
        {"control.processing_delay", "control.sampling_period"},
        [](const Case& c) { return c.control.processing_delay / c.control.sampling_period; },
        at_most(10), "computers answer within a sampling period, over a bus or a camera in a few"),
    number_of(
        "backlash.width", "m", [](const Case& c) { return c.backlash.width; }, at_most(0.01),
        "belts and gears have 1e-5 to 0.005"),
    number_of(
        "control.displacement_quantum", "m",
        [](const Case& c) { return c.control.displacement_quantum; }, at_most(0.01),
        "encoders have 1e-8 to 0.001"),
    number_of(
        "control.velocity_quantum", "m/s", [](const Case& c) { return c.control.velocity_quantum; },
        at_most(1), "encoders have 1e-6 to 0.1"),
    quantity(
        "conductor.bending_stiffness divided by that of a solid rod of the same metal area", "",
        {"conductor.bending_stiffness", "conductor.area", "conductor.youngs_modulus"},
        [](const Case& c) {
          const double area = c.conductor.area;
          return of_own_cable(c, c.conductor.bending_stiffness * 4.0 * pi<double> /
                                     (c.conductor.youngs_modulus * area * area));
        },
        at_most(3), "a strand bends at least as easily as one rod of its area, E A^2/(4 pi)"),
    quantity("conductor.mass_per_length / conductor.area", "kg/m3",
             {"conductor.area", "conductor.mass_per_length"},
             [](const Case& c) { return c.conductor.mass_per_length / c.conductor.area; },
             {800, 30000},
             "polymer ropes have 900, aluminium 2700, steel 7900, grouted stays up to 12000, "
             "tungsten 19300, models with added masses more",
             {10, 1e6}),
    quantity(
        "the metal share of the circle of this diameter, 4 conductor.area / (pi "
        "conductor.diameter^2),",
        "", {"conductor.diameter", "conductor.area"},
        [](const Case& c) { return of_own_cable(c, filled_share(c, known(c.conductor.diameter))); },
        {0.005, 1.1}, usual_shares),
    quantity(
        "conductor.rated_strength / conductor.area", "Pa",
        {"conductor.rated_strength", "conductor.area"},
        [](const Case& c) {
          return of_own_cable(c, known(c.conductor.rated_strength) / c.conductor.area);
        },
        {8e7, 6e9},
        "aluminium conductors have 1.6e8 to 3.3e8, steel strands up to 2e9, carbon fibre 5e9"),
    quantity(
        "the tension divided by conductor.rated_strength", "",
        {"conductor.sag", "conductor.tension", "conductor.rated_strength", "conductor.span"},
        [](const Case& c) {
          return of_own_cable(c, parabolic_tension_of(c) / known(c.conductor.rated_strength));
        },
        at_most(0.75), "lines have 0.1 to 0.3 every day and up to 0.7 under ice, stays 0.45",
        at_most(1)),
    quantity(
        "conductor.sag / conductor.span", "", {"conductor.sag", "conductor.span"},
        [](const Case& c) { return of_own_cable(c, c.conductor.sag / c.conductor.span); },
        at_most(0.125),
        "the paper's Eq. 1 and Irvine's modes hold only for shallow cables; exact statics and "
        "finite elements hold for all",
        whatever, asks_no_unit),
    quantity(
        "the speed of waves, conductor.span sqrt(conductor.gravity / (8 conductor.sag)),", "m/s",
        {"conductor.sag", "conductor.span"},
        [](const Case& c) {
          return std::sqrt(parabolic_tension_of(c) / c.conductor.mass_per_length);
        },
        {0.2, 1500}, "lines have 130, stays 260, steel near breaking 530, aramid 1400"),
    quantity(
        "the stress under the conductor's own weight", "Pa",
        {"conductor.sag", "conductor.area", "conductor.mass_per_length", "conductor.span"},
        [](const Case& c) { return parabolic_tension_of(c) / c.conductor.area; }, at_most(5e9),
        "steel wire breaks at 2.2e9, carbon fibre at 5e9"),
    quantity(
        "absorber.position / conductor.span, or / 100 m if the span is longer,", "",
        {"absorber.position", "conductor.span"},
        [](const Case& c) { return c.absorber.position / std::min(c.conductor.span, 100.0); },
        at_least(1e-3), "absorbers sit at 0.005 to 0.5; at its support a conductor does not move",
        at_least(5e-5)),
    quantity(
        "absorber.mass divided by the mass of the conductor", "",
        {"absorber.mass", "conductor.mass_per_length"},
        [](const Case& c) {
          return has_own_cable(c) && has_absorber(c)
                     ? c.absorber.mass * c.conductor.gravity / weight_of(c)
                     : unknown;
        },
        {2e-5, 3}, "dampers have 0.0001 to 0.1 of the conductor's mass, in models up to 1"),
    quantity(
        "the metal share of the circle of this diameter, 4 conductor.area / (pi wind.diameter^2),",
        "", {"wind.diameter", "conductor.area"},
        [](const Case& c) {
          return c.conductor_given ? filled_share(c, of_wind<&Wind::diameter>(c)) : unknown;
        },
        {0.005, 1.1}, usual_shares),
    quantity(
        "wind.diameter / conductor.diameter", "", {"wind.diameter", "conductor.diameter"},
        [](const Case& c) { return of_wind<&Wind::diameter>(c) / known(c.conductor.diameter); },
        {0.9, 10}, "wind.diameter is that of the conductor, or of the ice around it"),
    quantity(
        "plant.absorber_mass / absorber.mass", "", {"plant.absorber_mass", "absorber.mass"},
        [](const Case& c) {
          const bool both = c.is_given("plant.absorber_mass") && c.is_given("absorber.mass");
          return both && c.plant.absorber_mass > 0.0 ? c.plant.absorber_mass / c.absorber.mass
                                                     : unknown;
        },
        {0.5, 2}, "both are masses of the same absorber, and plant.absorber_mass is used"),
    quantity(
        "control.sampling_period divided by the period of the force", "",
        {"control.sampling_period", "excitation.frequency", "wind.speed", "wind.diameter"},
        [](const Case& c) { return c.control.sampling_period * force_frequency(c); }, at_most(2),
        "at 0.5 or more the samples do not show the vibration"),
    quantity(
        "the largest initial displacement divided by the reach of the absorber", "",
        {"initial.z1", "initial.z2"},
        [](const Case& c) { return largest_displacement(c) / reach_of_absorber(c); }, at_most(1),
        reach_reason),
    quantity(
        "the largest initial displacement / conductor.span", "", {"initial.z1", "initial.z2"},
        [](const Case& c) { return of_own_cable(c, largest_displacement(c) / c.conductor.span); },
        whatever, "no cable is displaced by more than its span", at_most(1)),
    quantity(
        "the largest initial velocity", "m/s", {"initial.v1", "initial.v2"},
        [](const Case& c) { return std::max(std::abs(c.initial.v1), std::abs(c.initial.v2)); },
        at_most(30), "galloping lines reach 10 m/s"),
};

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

/// The larger of the angular frequencies (rad/s) of the force and of the plant's higher mode.
double highest_frequency(const Case& c) {
  return two_pi * std::max(force_frequency(c), undamped_frequencies(c.plant)[1]);
}

/// |P| divided by the tuned |P| of Eq. 6, which counts as at least a tenth of m2 ω².
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
    quantity(
        "plant.conductor_mass divided by the mass of the conductor", "",
        {"plant.conductor_mass", "conductor.mass_per_length", "reduction.first_frequency"},
        [](const Case& c) {
          return c.conductor_given ? c.plant.conductor_mass * c.conductor.gravity / weight_of(c)
                                   : unknown;
        },
        {1e-5, 10}, "a mode moves only a part of the span's mass"),
    quantity(
        "plant.absorber_mass / plant.conductor_mass", "",
        {"plant.absorber_mass", "plant.conductor_mass", "absorber.mass"},
        [](const Case& c) { return c.plant.absorber_mass / c.plant.conductor_mass; }, {1e-5, 100},
        "absorbers have 0.001 to 10 of the mass that they damp"),
    quantity(
        "absorber.clamp_mass / plant.absorber_mass", "",
        {"absorber.clamp_mass", "plant.absorber_mass"},
        [](const Case& c) { return c.absorber.clamp_mass / c.plant.absorber_mass; }, at_most(2),
        "the clamp is only a part of the absorber"),
    quantity(
        "the higher natural frequency of the plant divided by the lower", "",
        {"plant.conductor_stiffness", "plant.absorber_stiffness", "plant.conductor_mass",
         "plant.absorber_mass", "reduction.first_frequency", "reduction.second_frequency"},
        [](const Case& c) {
          const auto frequencies = undamped_frequencies(c.plant);
          return frequencies[1] / frequencies[0];
        },
        at_most(20), "an absorber is tuned near the vibration that it damps"),
    quantity(
        "plant.conductor_damping divided by critical damping", "",
        {"plant.conductor_damping", "plant.conductor_stiffness"},
        [](const Case& c) {
          const auto& p = c.plant;
          return damping_ratio(p.conductor_damping, p.conductor_stiffness, p.conductor_mass);
        },
        at_most(1), "cables have 0.0001 to 0.03"),
    quantity(
        "plant.absorber_damping divided by critical damping", "",
        {"plant.absorber_damping", "plant.absorber_stiffness"},
        [](const Case& c) {
          const auto& p = c.plant;
          return damping_ratio(p.absorber_damping, p.absorber_stiffness, p.absorber_mass);
        },
        at_most(30), "a damper this strong locks the absorber"),
    quantity(
        "the frequency of the force divided by the higher natural frequency of the plant", "",
        {"excitation.frequency", "wind.speed", "wind.diameter", "plant.conductor_stiffness",
         "plant.absorber_stiffness", "plant.conductor_mass", "plant.absorber_mass"},
        [](const Case& c) {
          return plant_is_reduced(c) ? unknown
                                     : force_frequency(c) / undamped_frequencies(c.plant)[1];
        },
        at_most(5), "a force this fast hardly moves a plant of two masses"),
    quantity(
        "control.sampling_period divided by the longest period of the plant", "",
        {"control.sampling_period", "plant.conductor_stiffness"},
        [](const Case& c) { return c.control.sampling_period * undamped_frequencies(c.plant)[0]; },
        at_most(1), "at 0.5 or more the samples show none of the plant's vibrations"),
    quantity("control.proportional_gain / the P of the paper's Eq. 6", "",
             {"control.proportional_gain"}, proportional_share, {1.6e-3, 200},
             "a far smaller gain has no effect, a far larger gain only disturbs the motion"),
    quantity("control.differential_gain / (m2 omega)", "", {"control.differential_gain"},
             differential_share, {3e-3, 500},
             "a far smaller gain has no effect, a far larger gain only disturbs the motion"),
    quantity(
        "the vibration amplitude without control divided by the reach of the absorber", "",
        {"excitation.amplitude", "wind.speed", "wind.diameter", "wind.effective_length",
         "plant.conductor_stiffness", "excitation.frequency"},
        [](const Case& c) { return free_amplitude(c) / reach_of_absorber(c); }, at_most(1),
        reach_reason),
};

}  // namespace

double reach_of_absorber(const Case& the_case) {
  if (!has_own_cable(the_case)) return 3.0;
  const double position = the_case.absorber.position;
  return 0.5 * std::min(position, the_case.conductor.span - position);
}

std::array<double, 2> undamped_frequencies(const case_tables::Plant& plant) {
  const double first =
      (plant.conductor_stiffness + plant.absorber_stiffness) / plant.conductor_mass;
  const double second = plant.absorber_stiffness / plant.absorber_mass;
  // ω² = s ± √(d² + k2²/(m1 m2)); the lower from the product k1 k2/(m1 m2), without cancellation.
  const double coupling = plant.absorber_stiffness / plant.conductor_mass * second;
  const double high =
      0.5 * (first + second) + std::sqrt(0.25 * (first - second) * (first - second) + coupling);
  const double low = plant.conductor_stiffness / plant.conductor_mass * (second / high);
  return {std::sqrt(low) / two_pi, std::sqrt(high) / two_pi};
}

const std::vector<PlausibleQuantity>& quantities_of_case() { return listed_of_case; }
const std::vector<PlausibleQuantity>& quantities_of_plant() { return listed_of_plant; }

}  // namespace holdfast::program
