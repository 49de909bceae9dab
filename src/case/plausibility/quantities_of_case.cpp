#include <algorithm>
#include <cmath>

#include "case/plausibility/words.hpp"
#include "holdfast/core/types.hpp"

namespace holdfast::program {
namespace {

using namespace plausibility;

double tension_of(const Case& c) { return weight_of(c) * c.conductor.span / (8 * c.conductor.sag); }

/// A word stands for what is not known.
double known(double value) { return std::isfinite(value) ? value : unknown; }

double largest_displacement(const Case& c) {
  return std::max(std::abs(c.initial.z1), std::abs(c.initial.z2));
}

/// Those of one key come first: what they explain is not laid to the others.
const Quantities listed_of_case = {
    {"conductor.youngs_modulus",
     "Pa",
     {"conductor.youngs_modulus"},
     [](const Case& c) { return c.conductor.youngs_modulus; },
     {1e7, 1e12},
     whatever,
     "rubber has 1e7, polymer ropes 1e9, aluminium 7e10, steel 2.1e11, diamond 1.1e12"},
    {"conductor.span",
     "m",
     {"conductor.span"},
     [](const Case& c) { return c.conductor.span; },
     {0.05, 8000},
     at_most(1e5),
     "the longest span of a line has 5400; a steel wire of 28000 breaks under its weight"},
    {"conductor.gravity",
     "m/s2",
     {"conductor.gravity"},
     [](const Case& c) { return c.conductor.gravity; },
     {0.05, 30},
     whatever,
     "9.81, and its part across a steep stay"},
    {"conductor.damping_ratio",
     "",
     {"conductor.damping_ratio"},
     [](const Case& c) { return c.conductor.damping_ratio; },
     at_most(0.2),
     whatever,
     "cables have 0.0001 to 0.03"},
    {"conductor.diameter",
     "m",
     {"conductor.diameter"},
     [](const Case& c) { return known(c.conductor.diameter); },
     {1e-4, 1.5},
     {1e-6, 10},
     "lines have 0.005 to 0.06, stays 0.1 to 0.3, cables of suspension bridges 1.1"},
    {"conductor.outer_wire_modulus",
     "Pa",
     {"conductor.outer_wire_modulus"},
     [](const Case& c) { return known(c.conductor.outer_wire_modulus); },
     {1e9, 1e12},
     whatever,
     "aluminium has 7e10, steel 2e11"},
    {"conductor.outer_wire_diameter over conductor.diameter",
     "",
     {"conductor.outer_wire_diameter", "conductor.diameter"},
     [](const Case& c) {
       return known(c.conductor.outer_wire_diameter / known(c.conductor.diameter));
     },
     {1e-3, 1},
     whatever,
     "seven wires have 0.33, sixty-one 0.11, a stay of a hundred strands 0.03"},
    {"wind.speed",
     "m/s",
     {"wind.speed"},
     [](const Case& c) { return c.wind ? c.wind->speed : unknown; },
     {0.005, 90},
     at_most(150),
     "the strongest gust on record had 113"},
    {"wind.diameter",
     "m",
     {"wind.diameter"},
     [](const Case& c) { return c.wind ? c.wind->diameter : unknown; },
     {1e-4, 1.5},
     {1e-6, 10},
     "lines have 0.005 to 0.06, stays 0.1 to 0.3, cables of suspension bridges 1.1"},
    {"wind.effective_length over conductor.span",
     "",
     {"wind.effective_length"},
     [](const Case& c) {
       return c.wind && has_own_cable(c) ? c.wind->effective_length / c.conductor.span : unknown;
     },
     at_most(1.01),
     whatever,
     "the wind acts on the span and nowhere else"},
    {"wind.strouhal",
     "",
     {"wind.strouhal"},
     [](const Case& c) { return c.wind ? c.wind->strouhal : unknown; },
     {0.05, 0.6},
     whatever,
     "a circular cylinder has 0.18 to 0.22, beyond the drag crisis up to 0.5"},
    {"wind.lift_coefficient",
     "",
     {"wind.lift_coefficient"},
     [](const Case& c) { return c.wind ? c.wind->lift_coefficient : unknown; },
     at_most(5),
     whatever,
     "a cylinder at rest has 0.3 to 0.6, one that moves up to 2"},
    {"wind.air_density",
     "kg/m3",
     {"wind.air_density"},
     [](const Case& c) { return c.wind ? c.wind->air_density : unknown; },
     {0.3, 1100},
     whatever,
     "air has 0.4 at 10 km to 1.4, water 1000"},
    {"site.weibull_scale",
     "m/s",
     {"site.weibull_scale"},
     [](const Case& c) { return known(c.site.weibull_scale); },
     {0.5, 25},
     whatever,
     "the mean is 0.89 of it: sheltered places have 2, mountain tops 15"},
    {"site.weibull_shape",
     "",
     {"site.weibull_shape"},
     [](const Case& c) { return c.site.weibull_shape; },
     {0.8, 6},
     whatever,
     "wind has 1.2 to 3, trade winds 4"},
    {"site.turbulence_intensity",
     "",
     {"site.turbulence_intensity"},
     [](const Case& c) { return c.site.turbulence_intensity; },
     at_most(0.6),
     whatever,
     "open water has 0.05, towns 0.4"},
    {"site.years",
     "years",
     {"site.years"},
     [](const Case& c) { return c.site.years; },
     {0.01, 500},
     whatever,
     "lines are built for 40 to 100"},
    {"control.sampling_period",
     "s",
     {"control.sampling_period"},
     [](const Case& c) { return c.control.sampling_period; },
     at_least(1e-6),
     whatever,
     "controllers of machines take 100 to 100000 samples a second"},
    {"control.processing_delay over control.sampling_period",
     "",
     {"control.processing_delay", "control.sampling_period"},
     [](const Case& c) { return c.control.processing_delay / c.control.sampling_period; },
     at_most(10),
     whatever,
     "a computer answers within a sample, with a bus or a camera within a few"},
    {"backlash.width",
     "m",
     {"backlash.width"},
     [](const Case& c) { return c.backlash.width; },
     at_most(0.01),
     whatever,
     "belts and gears have 1e-5 to 0.005"},
    {"control.displacement_quantum",
     "m",
     {"control.displacement_quantum"},
     [](const Case& c) { return c.control.displacement_quantum; },
     at_most(0.01),
     whatever,
     "encoders have 1e-8 to 0.001"},
    {"control.velocity_quantum",
     "m/s",
     {"control.velocity_quantum"},
     [](const Case& c) { return c.control.velocity_quantum; },
     at_most(1),
     whatever,
     "encoders have 1e-6 to 0.1"},
    {"conductor.bending_stiffness over that of a solid rod",
     "",
     {"conductor.bending_stiffness", "conductor.area", "conductor.youngs_modulus"},
     [](const Case& c) {
       const double area = c.conductor.area;
       return has_own_cable(c) ? c.conductor.bending_stiffness * 4.0 * pi<double> /
                                     (c.conductor.youngs_modulus * area * area)
                               : unknown;
     },
     at_most(3),
     whatever,
     "a strand bends at least as easily as one rod of its area, E A^2/(4 pi)"},
    {"conductor.mass_per_length / conductor.area",
     "kg/m3",
     {"conductor.area", "conductor.mass_per_length"},
     [](const Case& c) { return c.conductor.mass_per_length / c.conductor.area; },
     {800, 30000},
     {10, 1e6},
     "polymer ropes have 900, aluminium 2700, steel 7900, grouted stays up to 12000, tungsten "
     "19300, models with masses fixed to them more"},
    {"the share of its circle that the conductor fills, 4 conductor.area / (pi "
     "conductor.diameter^2),",
     "",
     {"conductor.diameter", "conductor.area"},
     [](const Case& c) {
       const double diameter = known(c.conductor.diameter);
       return has_own_cable(c) ? 8.0 * c.conductor.area / (two_pi * diameter * diameter) : unknown;
     },
     {0.005, 1.1},
     whatever,
     "a rod has 1, a strand 0.75, a sheathed stay 0.3, a model under foam 0.01"},
    {"conductor.rated_strength / conductor.area",
     "Pa",
     {"conductor.rated_strength", "conductor.area"},
     [](const Case& c) {
       return has_own_cable(c) ? known(c.conductor.rated_strength) / c.conductor.area : unknown;
     },
     {8e7, 6e9},
     whatever,
     "aluminium conductors have 1.6e8 to 3.3e8, steel strands up to 2e9, carbon fibre 5e9"},
    {"the tension over conductor.rated_strength",
     "",
     {"conductor.sag", "conductor.tension", "conductor.rated_strength", "conductor.span"},
     [](const Case& c) {
       return has_own_cable(c) ? tension_of(c) / known(c.conductor.rated_strength) : unknown;
     },
     at_most(0.75),
     at_most(1),
     "lines have 0.1 to 0.3 every day and up to 0.7 under ice, stays 0.45"},
    {"conductor.sag over conductor.span",
     "",
     {"conductor.sag", "conductor.span"},
     [](const Case& c) { return has_own_cable(c) ? c.conductor.sag / c.conductor.span : unknown; },
     at_most(0.125),
     whatever,
     "Eq. 1 and Irvine's modes are those of shallow cables; the exact statics and the finite "
     "elements hold",
     false},
    {"the speed of waves, conductor.span sqrt(conductor.gravity / (8 conductor.sag)),",
     "m/s",
     {"conductor.sag", "conductor.span"},
     [](const Case& c) { return std::sqrt(tension_of(c) / c.conductor.mass_per_length); },
     {0.2, 1500},
     whatever,
     "lines have 130, stays 260, steel at its strength 530, aramid 1400"},
    {"the stress under the conductor's own weight",
     "Pa",
     {"conductor.sag", "conductor.area", "conductor.mass_per_length", "conductor.span"},
     [](const Case& c) { return tension_of(c) / c.conductor.area; },
     at_most(5e9),
     whatever,
     "steel wire breaks at 2.2e9, carbon fibre at 5e9"},
    {"absorber.position over conductor.span, or over 100 m of a longer one,",
     "",
     {"absorber.position", "conductor.span"},
     [](const Case& c) { return c.absorber.position / std::min(c.conductor.span, 100.0); },
     at_least(1e-3),
     at_least(5e-5),
     "absorbers sit at 0.005 to 0.5; at its support a conductor does not move"},
    {"absorber.mass over that of the conductor",
     "",
     {"absorber.mass", "conductor.mass_per_length"},
     [](const Case& c) {
       return has_own_cable(c) && has_absorber(c)
                  ? c.absorber.mass * c.conductor.gravity / weight_of(c)
                  : unknown;
     },
     {2e-5, 3},
     whatever,
     "dampers have 0.0001 to 0.1 of it, in models up to 1"},
    {"the share of its circle that the conductor fills, 4 conductor.area / (pi wind.diameter^2),",
     "",
     {"wind.diameter", "conductor.area"},
     [](const Case& c) {
       if (!c.wind || !c.conductor_given) return unknown;
       return 8.0 * c.conductor.area / (two_pi * c.wind->diameter * c.wind->diameter);
     },
     {0.005, 1.1},
     whatever,
     "a rod has 1, a strand 0.75, a sheathed stay 0.3, a model under foam 0.01"},
    {"wind.diameter over conductor.diameter",
     "",
     {"wind.diameter", "conductor.diameter"},
     [](const Case& c) {
       return c.wind ? c.wind->diameter / known(c.conductor.diameter) : unknown;
     },
     {0.9, 10},
     whatever,
     "the wind meets the conductor, or the ice about it"},
    {"plant.absorber_mass over absorber.mass",
     "",
     {"plant.absorber_mass", "absorber.mass"},
     [](const Case& c) {
       const bool both =
           c.places.count("plant.absorber_mass") + c.places.count("absorber.mass") == 2;
       return both && c.plant.absorber_mass > 0.0 ? c.plant.absorber_mass / c.absorber.mass
                                                  : unknown;
     },
     {0.5, 2},
     whatever,
     "both are of the one absorber, and the first counts"},
    {"control.sampling_period over the period of the force",
     "",
     {"control.sampling_period", "excitation.frequency", "wind.speed", "wind.diameter"},
     [](const Case& c) { return c.control.sampling_period * force_frequency(c); },
     at_most(2),
     whatever,
     "from 0.5 on the computer does not see the vibration"},
    {"the largest initial displacement over the reach of the absorber's place",
     "",
     {"initial.z1", "initial.z2"},
     [](const Case& c) { return largest_displacement(c) / reach_of_absorber(c); },
     at_most(1),
     whatever,
     reach_reason},
    {"the largest initial displacement over conductor.span",
     "",
     {"initial.z1", "initial.z2"},
     [](const Case& c) {
       return has_own_cable(c) ? largest_displacement(c) / c.conductor.span : unknown;
     },
     whatever,
     at_most(1),
     "no cable is displaced by more than its span"},
    {"the largest initial velocity",
     "m/s",
     {"initial.v1", "initial.v2"},
     [](const Case& c) { return std::max(std::abs(c.initial.v1), std::abs(c.initial.v2)); },
     at_most(30),
     whatever,
     "lines that gallop reach 10"},
};

}  // namespace

double reach_of_absorber(const Case& the_case) {
  if (!plausibility::has_own_cable(the_case)) return 3.0;
  const double position = the_case.absorber.position;
  return 0.5 * std::min(position, the_case.conductor.span - position);
}

const std::vector<PlausibleQuantity>& quantities_of_case() { return listed_of_case; }

}  // namespace holdfast::program
