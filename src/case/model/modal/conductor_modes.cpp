#include "case/model/modal/conductor_modes.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "case/model/cable_of_case.hpp"
#include "case/model/loop_of_case.hpp"
#include "case/needed.hpp"
#include "holdfast/cable/cable_place_modes.hpp"
#include "holdfast/cable/elements.hpp"
#include "process/errors.hpp"
#include "process/memo.hpp"

namespace holdfast::program {
namespace {

/// Throws MissingKeys for all missing keys of conductor, absorber and computer at once.
void require_all(const Case& the_case) {
  std::vector<std::string> keys = {"plant.absorber_mass",     "conductor.mass_per_length",
                                   "conductor.span",          "conductor.sag",
                                   "conductor.damping_ratio", "absorber.position",
                                   "control.sampling_period"};
  if (is_cable(the_case)) keys.insert(keys.end(), {"conductor.area", "conductor.youngs_modulus"});
  if (has_absorber(the_case))
    keys.insert(keys.end(), {"plant.absorber_stiffness", "plant.absorber_damping"});
  require_keys(the_case, keys);
}

/// Limits of the chosen numbers of modes and bars.
constexpr int fewest_modes = 60, most_modes_of_string = 300, most_modes_of_cable = 200;
constexpr double fewest_bars = 200.0, most_bars = 8000.0;

/// The modes of a chain of bars at the absorber's place.
CablePlaceModes chain_modes_of(const Case& the_case, int bars, int steps) {
  constexpr std::size_t enough = 16;
  static Memo<std::array<double, 11>, CablePlaceModes> memo(enough);
  const Conductor<double> conductor = conductor_of(the_case);
  const double clamp = the_case.absorber.clamp_mass, hung = the_case.plant.absorber_mass;
  const bool plane = the_case.absorber.motion == "plane";
  const HungMass mass{hung, clamp + (plane ? hung : 0.0)};
  const double place = the_case.absorber.position;
  const std::array<double, 11> all = {conductor.mass_per_length,
                                      conductor.span,
                                      conductor.sag,
                                      conductor.area,
                                      conductor.youngs_modulus,
                                      conductor.gravity,
                                      place,
                                      mass.weight,
                                      mass.sideways,
                                      static_cast<double>(bars),
                                      static_cast<double>(steps)};
  return memo.of(all,
                 [&] { return cable_place_modes(BarChain(conductor, place, bars), mass, steps); });
}

/// Adds the bare conductor's damping ratio to that of each mode or bundle (root of the squares).
ConductorModes damped(const Case& the_case, std::vector<PlaceMode<double>> modes, int apart,
                      int bars) {
  for (PlaceMode<double>& mode : modes)
    mode.damping_ratio =
        std::hypot(mode.damping_ratio, bare_damping_of(the_case, mode.angular_frequency));
  return {std::move(modes), apart, bars};
}

TautString<double> undamped_string_of(const Case& the_case) {
  TautString<double> string = string_of(the_case);
  string.damping_ratio = 0.0;
  return string;
}

/// The larger of half the sampling rate and twice the frequency of the force (rad/s).
double seen_frequency(const Case& the_case) {
  return 2.0 * pi<double> *
         std::max(0.5 / the_case.control.sampling_period,
                  2.0 * effective_excitation(the_case).frequency);
}

/// Largest number of single modes in a test of stability.
constexpr int most_judged = 2000;

/// Twice the sampling rate (rad/s).
double twice_the_rate_of(const Case& the_case) {
  require_keys(the_case, {"control.sampling_period"});
  return 4.0 * pi<double> / the_case.control.sampling_period;
}

/// The number of modes, `n` to `most`, with frequencies below `highest` (rad/s) whose waves keep at
/// least `share` of their amplitude on the way over `way` spans and back.
int returning_modes(const Case& the_case, int n, double highest, int most = most_judged,
                    double way = 1.0, double share = 0.05) {
  const TautString<double> string = string_of(the_case);
  for (double omega; n < most; ++n)
    if ((omega = string.angular_frequency(n)) >= highest ||
        std::exp(-2.0 * pi<double> * n * way * bare_damping_of(the_case, omega)) < share)
      break;
  return n;
}

/// The number of single modes of a case. A force that jumps at samples excites waves above half the
/// sampling rate. Returning waves may destabilise the loop up to five times absorber frequency.
int chosen_modes(const Case& the_case) {
  const int most = is_cable(the_case) ? most_modes_of_cable : most_modes_of_string;
  constexpr double sharpness = 5.0, decisive = 5.0, hardly = 0.1;
  const double place = the_case.absorber.position / the_case.conductor.span;
  const int n = returning_modes(the_case, fewest_modes, sharpness * seen_frequency(the_case), most,
                                std::min(place, 1.0 - place), hardly);
  if (is_cable(the_case) || !has_absorber(the_case)) return n;
  const auto& plant = the_case.plant;
  return returning_modes(the_case, n,
                         decisive * std::sqrt(plant.absorber_stiffness / plant.absorber_mass));
}

/// Number of bars needed: phase (rad) of the fastest relevant wave over the span, less for damping.
double radians_of(const Case& the_case, int apart) {
  const TautString<double> string = string_of(the_case);
  const double omega = std::max(seen_frequency(the_case), string.angular_frequency(2.0 * apart));
  const double damped = std::sqrt(std::hypot(1.0, 2.0 * bare_damping_of(the_case, omega)));
  return omega / string.wave_speed() * string.span / damped;
}

/// Number of bars, in steps of 50: a small change of the case changes answers smoothly.
int bars_of(const Case& the_case, int apart) {
  const double needed = 50.0 * std::ceil(radians_of(the_case, apart) / 50.0);
  return static_cast<int>(std::clamp(needed, fewest_bars, most_bars));
}

ConductorModes all_modes_of_cable(const Case& the_case, int apart, int bars) {
  // One of two Lanczos steps gives a mode, the other one a bundle.
  CablePlaceModes found = chain_modes_of(the_case, bars, std::min(2 * apart, 2 * (bars - 1)));
  if (found.outcome != EquilibriumOutcome::converged)
    throw NoAnswer("found no static equilibrium of the cable: check [conductor] and [absorber]");
  return damped(the_case, std::move(found.modes), found.apart, bars);
}

ConductorModes all_modes_of_string(const Case& the_case, int apart) {
  const TautString<double> string = undamped_string_of(the_case);
  // Faster waves have no effect at the clamp: they pass it many times within a sample.
  const double highest =
      std::max(100.0 / the_case.control.sampling_period, 10.0 * string.angular_frequency(apart));
  return damped(the_case, bundled_string_modes(string, the_case.absorber.position, apart, highest),
                apart, 0);
}

/// The only mode of a mass on a spring and a dashpot, or of a string without ends.
ConductorModes one_mode_of(const Case& the_case) {
  if (is_infinite(the_case)) {
    require_keys(the_case, {"control.sampling_period"});
    return {{infinite_string_mode(string_of(the_case).wave_impedance(),
                                  the_case.absorber.clamp_mass, the_case.control.sampling_period)},
            1};
  }
  const TwoMass<double> plant = plant_of(the_case);
  const double omega = std::sqrt(plant.conductor_stiffness / plant.conductor_mass);
  return {{{omega, plant.conductor_damping / (2.0 * omega * plant.conductor_mass), 1.0,
            plant.conductor_mass}},
          1};
}

}  // namespace

double ConductorModes::highest_frequency() const {
  return modes[static_cast<std::size_t>(apart) - 1].angular_frequency / (2.0 * pi<double>);
}

TautString<double> string_of(const Case& the_case) {
  require_keys(the_case, {"conductor.mass_per_length", "conductor.span", "conductor.sag"});
  const auto& conductor = the_case.conductor;
  const double ratio = std::isnan(conductor.damping_ratio) ? 0.0 : conductor.damping_ratio;
  TautString<double> string{
      std::isfinite(conductor.tension) ? conductor.tension : parabolic_tension_of(the_case),
      conductor.mass_per_length, conductor.span, ratio};
  string.bending_stiffness = is_cable(the_case) ? 0.0 : the_case.conductor.bending_stiffness;
  return string;
}

double bare_damping_of(const Case& the_case, double angular_frequency) {
  const auto& conductor = the_case.conductor;
  const bool rayleigh =
      conductor.damping == "rayleigh" || (conductor.damping == "chosen" && is_cable(the_case));
  const double ratio = damping_ratio_of(the_case);
  if (!rayleigh) return ratio;
  const auto& [first, second] = conductor.rayleigh_frequencies;
  return rayleigh_damping(ratio, first, second).damping_ratio(angular_frequency);
}

ConductorModes all_conductor_modes_of(const Case& the_case, int apart) {
  if (is_two_masses(the_case) || is_infinite(the_case)) return one_mode_of(the_case);
  require_all(the_case);
  return is_cable(the_case) ? all_modes_of_cable(the_case, apart, bars_of(the_case, apart))
                            : all_modes_of_string(the_case, apart);
}

ConductorModes coarser_modes_of(const Case& the_case, const ConductorModes& conductor) {
  if (conductor.apart == 1) return conductor;
  const int half = (conductor.apart + 1) / 2;
  constexpr double coarser = 0.7;
  return is_cable(the_case)
             ? all_modes_of_cable(the_case, half, static_cast<int>(coarser * conductor.bars))
             : all_modes_of_string(the_case, half);
}

ConductorModes judged_modes_of(const Case& the_case) {
  return all_modes_of_string(
      the_case, returning_modes(the_case, chosen_modes(the_case), twice_the_rate_of(the_case)));
}

ConductorModes cut_modes_of(const Case& the_case) {
  const TautString<double> string = undamped_string_of(the_case);
  int n = 1;
  while (n < most_judged && string.angular_frequency(n + 1) < twice_the_rate_of(the_case)) ++n;
  return damped(the_case, string_modes(string, the_case.absorber.position, n), n, 0);
}

ConductorModes conductor_modes_of(const Case& the_case) {
  if (is_two_masses(the_case) || is_infinite(the_case)) return one_mode_of(the_case);
  require_all(the_case);
  if (!std::isfinite(the_case.plant.modes))
    return all_conductor_modes_of(the_case, chosen_modes(the_case));
  const int modes = static_cast<int>(the_case.plant.modes);
  if (!is_cable(the_case)) {
    const TautString<double> string = undamped_string_of(the_case);
    return damped(the_case, string_modes(string, the_case.absorber.position, modes), modes, 0);
  }
  ConductorModes found = all_modes_of_cable(the_case, modes + 10, bars_of(the_case, modes + 10));
  if (found.apart < modes)
    throw NoAnswer("the cable, modelled by " + std::to_string(found.bars) + " bars, has only " +
                   std::to_string(found.apart) +
                   " modes that move the absorber: lower plant.modes to this number or less");
  found.modes.resize(static_cast<std::size_t>(modes));
  found.apart = modes;
  return found;
}

bool lacks_bars(const Case& the_case) {
  return is_cable(the_case) && radians_of(the_case, 0) > most_bars;
}

}  // namespace holdfast::program
