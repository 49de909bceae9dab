#include "case/model/modal/modes_warning.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "case/model/loop_of_case.hpp"
#include "case/model/modal/conductor_modes.hpp"
#include "text/text.hpp"

namespace holdfast::program {
namespace {

/// The sum Σ φ²/M (1/kg): acceleration per newton of the absorber's place without its clamp.
double mobility_of(const std::vector<PlaceMode<double>>& modes) {
  double sum = 0.0;
  for (const PlaceMode<double>& mode : modes) sum += mode.shape * mode.shape / mode.mass;
  return sum;
}

/// A warning of given keys that have no effect on the case's plant.
std::string idle_keys_warning(const Case& the_case) {
  const bool masses = is_two_masses(the_case), cable = is_cable(the_case);
  const bool endless = is_infinite(the_case), string = !masses && !cable && !endless;
  std::string names;
  const auto add = [&](bool counts, const char* name) {
    if (counts) names += (names.empty() ? "" : ", ") + std::string(name);
  };
  const bool plane = the_case.absorber.motion == "plane";
  // A named conductor has a bending stiffness from the library, not from the user.
  const bool bends = the_case.conductor.bending_stiffness > 0.0 && the_case.conductor.name.empty();
  const bool of_modes = the_case.absorber.clamp_mass > 0.0 || std::isfinite(the_case.plant.modes) ||
                        the_case.conductor.damping != "chosen";
  add(masses && the_case.absorber.clamp_mass > 0.0, "absorber.clamp_mass");
  add(!cable && plane, "absorber.motion");
  add(!string && bends, "conductor.bending_stiffness");
  add((masses || endless) && the_case.conductor.damping != "chosen", "conductor.damping");
  add((masses || endless) && std::isfinite(the_case.plant.modes), "plant.modes");
  if (names.empty()) return "";
  const char* const who = masses    ? "the two masses"
                          : endless ? "the string without ends"
                          : string  ? "the string"
                                    : "the cable";
  const char* const other = plane && !cable && !of_modes && !bends ? "\"cable\"" : "\"string\"";
  return names + ": not used by " + who + "; used with plant.model = " + other;
}

/// Text about the single modes, and about a force faster than these.
struct KeptModes {
  std::string words, faster;
};

KeptModes kept_modes(const Case& the_case, const ConductorModes& conductor) {
  const double end = conductor.highest_frequency();
  const double force = effective_excitation(the_case).frequency;
  return {std::to_string(conductor.apart) + " modes of the conductor, up to " +
              format_rounded(end) + " Hz, ",
          force > end ? "; the force, " + format_rounded(force) + " Hz, is faster than these" : ""};
}

/// A warning that bundles of faster modes lack returning waves; empty if these are negligible.
std::string bundles_warning(const Case& the_case, const ConductorModes& conductor) {
  const auto& last = conductor.modes[static_cast<std::size_t>(conductor.apart) - 1];
  // Number of half-waves of a string mode of that frequency.
  const double half_waves = last.angular_frequency / string_of(the_case).angular_frequency(1.0);
  const double returned =
      std::exp(-2.0 * pi<double> * bare_damping_of(the_case, last.angular_frequency) * half_waves);
  const KeptModes kept = kept_modes(the_case, conductor);
  if (returned < 0.05 && (kept.faster.empty() || is_cable(the_case))) return "";
  return kept.words +
         "are computed singly, faster modes in groups without waves returning from the supports" +
         (returned < 0.05 ? ""
                          : "; with the damping of the case up to " +
                                format_rounded(100.0 * returned) + " % of such a wave returns") +
         kept.faster;
}

/// A warning that faster modes are left out; empty if these are negligible.
std::string cut_warning(const Case& the_case, const ConductorModes& conductor) {
  const double cut_mass = 1.0 / mobility_of(conductor.modes);
  const double felt_mass =
      std::max(the_case.absorber.clamp_mass,
               (the_case.plant.absorber_damping + 2.0 * string_of(the_case).wave_impedance()) *
                   the_case.control.sampling_period / 2.0);
  const double half_rate = 0.5 / the_case.control.sampling_period;
  const KeptModes kept = kept_modes(the_case, conductor);
  if (cut_mass < 0.02 * felt_mass && conductor.highest_frequency() > half_rate &&
      kept.faster.empty())
    return "";
  return kept.words + "are included and faster modes left out, which acts like " +
         format_rounded(1e3 * cut_mass) +
         " g more mass at the clamp: gains may seem stable far beyond the true limit; remove "
         "plant.modes to include all modes" +
         kept.faster;
}

/// A warning that Rayleigh damping, chosen by default, is far from the damping ratio at a
/// frequency.
std::string rayleigh_warning(const Case& the_case) {
  const auto& conductor = the_case.conductor;
  if (!is_cable(the_case) || conductor.damping != "chosen" ||
      conductor.rayleigh_frequencies != case_tables::Conductor().rayleigh_frequencies)
    return "";
  const auto& plant = the_case.plant;
  const double own =
      has_absorber(the_case) ? std::sqrt(plant.absorber_stiffness / plant.absorber_mass) : 0.0;
  const double omega = std::max(own, 2.0 * pi<double> * effective_excitation(the_case).frequency);
  const double times = bare_damping_of(the_case, omega) / the_case.conductor.damping_ratio;
  if (!(times > 3.0)) return "";
  return "Rayleigh damping, the default on a cable, is " + format_rounded(times) +
         " times conductor.damping_ratio at " + format_rounded(omega / (2.0 * pi<double>)) +
         " Hz: set conductor.damping = \"ratio\" or conductor.rayleigh_frequencies";
}

}  // namespace

std::string modes_warning(const Case& the_case) {
  std::string said = idle_keys_warning(the_case);
  if (std::isfinite(the_case.control.drive_damping) &&
      !std::isfinite(the_case.control.drive_bandwidth))
    said += (said.empty() ? "" : "; ") +
            std::string("control.drive_damping needs control.drive_bandwidth: give both");
  if (is_two_masses(the_case) || is_infinite(the_case)) return said;
  const ConductorModes conductor = conductor_modes_of(the_case);
  const auto warning = std::isfinite(the_case.plant.modes) ? cut_warning : bundles_warning;
  for (const std::string& more :
       {rayleigh_warning(the_case), warning(the_case, conductor),
        lacks_bars(the_case) ? std::to_string(conductor.bars) +
                                   " bars of the cable are too few for the waves at half the "
                                   "sampling rate: results for gains are not converged"
                             : ""})
    said += (said.empty() || more.empty() ? "" : "; ") + more;
  return said;
}

std::string drift_warning(const Case& the_case) {
  if (!is_infinite(the_case)) return "";
  return "nothing brings a string without ends back to its mean position: the largest displacement "
         "includes the drift from the start; holdfast response gives the amplitude without drift";
}

std::string dense_work_warning(const Case& the_case, Switching switching) {
  if (motion_kind_of(the_case, switching) != MotionKind::built_plant || has_own_plant(the_case))
    return "";
  const std::size_t modes = conductor_modes_of(the_case).modes.size();
  constexpr std::size_t soon = 50;
  if (modes <= soon) return "";
  return std::to_string(modes) +
         " modes and groups of modes take minutes to compute; set plant.modes = 40 to compute in "
         "seconds, but without the faster modes";
}

}  // namespace holdfast::program
