#include "case/model/loop_of_case.hpp"

#include <cmath>

#include "case/model/cable_of_case.hpp"
#include "case/model/linear_loop.hpp"
#include "case/model/modal/modal_plant_of_case.hpp"
#include "case/model/moving_loop.hpp"
#include "case/needed.hpp"
#include "holdfast/excitation/band_limited_noise.hpp"
#include "text/text.hpp"

namespace holdfast::program {
namespace {

ContactLaw law_of(const std::string& word) {
  if (word == "immediate") return ContactLaw::immediate;
  if (word == "play") return ContactLaw::play;
  if (word == "dead_zone") return ContactLaw::dead_zone;
  return word == "none" ? ContactLaw::none : ContactLaw::kollar;
}

/// Force of a case: the main harmonic first, then the additional harmonics, then the noise.
MultiHarmonicForce force_of(const Case& the_case) {
  const auto given = effective_excitation(the_case);
  MultiHarmonicForce force = multi_harmonic_force(motion_excitation_of(the_case));
  for (const auto& [amplitude, frequency, phase] : given.harmonics)
    force.harmonics.push_back({amplitude, frequency, phase});
  if (given.noise_rms > 0.0) {
    const auto lines = band_limited_noise({given.noise_rms, given.noise_lowest, given.noise_highest,
                                           static_cast<int>(given.noise_lines),
                                           static_cast<std::uint64_t>(given.noise_seed)});
    force.harmonics.insert(force.harmonics.end(), lines.begin(), lines.end());
  }
  force.record = the_case.force_record;
  return force;
}

}  // namespace

ControllerLimits controller_limits_of(const Case& the_case) {
  const auto& control = the_case.control;
  return {
      control.displacement_quantum, control.velocity_quantum,
      control.velocity == "difference" ? VelocitySensing::difference : VelocitySensing::measured,
      control.largest_force};
}

IdealLoop<double> ideal_loop_of(const Case& the_case) {
  const double width = the_case.backlash.law == "none" ? 0.0 : the_case.backlash.width;
  return {plant_of(the_case),
          sampling_of(the_case),
          gains_of(the_case),
          motion_excitation_of(the_case),
          width,
          force_hold_of(the_case)};
}

void require_loop_keys(const Case& the_case) {
  if (has_own_plant(the_case)) return;
  plant_of(the_case);
  require_absorber(the_case);
  if (!is_two_masses(the_case)) {
    if (is_cable(the_case)) conductor_of(the_case);
    string_of(the_case);
    damping_ratio_of(the_case);
    if (!is_infinite(the_case)) require_keys(the_case, {"absorber.position"});
  }
  gains_of(the_case);
  sampling_of(the_case);
  motion_excitation_of(the_case);
}

bool has_ideal_computer(const Case& the_case) {
  return is_ideal(controller_limits_of(the_case)) && the_case.control.jitter == 0.0;
}

MotionKind motion_kind_of(const Case& the_case, Switching switching) {
  const auto excitation = effective_excitation(the_case);
  const ContactLaw law = law_of(the_case.backlash.law);
  const bool prompt = the_case.own == nullptr && !has_hardware(the_case) &&
                      !(the_case.control.processing_delay > the_case.control.sampling_period);
  const bool sampled = prompt && switching == Switching::sampled && has_ideal_computer(the_case) &&
                       the_case.force_record == nullptr && excitation.harmonics.empty() &&
                       !(excitation.noise_rms > 0.0) &&
                       (law == ContactLaw::none || law == ContactLaw::kollar);
  if (prompt && is_two_masses(the_case))
    return sampled ? MotionKind::sampled_masses : MotionKind::built_masses;
  return sampled ? MotionKind::sampled_modes : MotionKind::built_plant;
}

bool has_closed_forms(const Case& the_case) {
  return is_of_masses(motion_kind_of(the_case, Switching::sampled)) &&
         the_case.control.velocity == "measured";
}

ImplementedLoop implemented_loop_of(const Case& the_case, Switching switching) {
  const auto& control = the_case.control;
  const auto& backlash = the_case.backlash;
  const Jitter jitter{control.jitter, static_cast<std::uint64_t>(control.jitter_seed)};
  return {
      plant_of(the_case),
      {sampling_of(the_case), gains_of(the_case), force_of(the_case), force_hold_of(the_case),
       controller_limits_of(the_case), jitter},
      {law_of(backlash.law), backlash.width, backlash.contact_stiffness, backlash.contact_damping},
      switching};
}

std::optional<IdealLoop<double>> exactly_switched_loop_of(const Case& the_case) {
  if (!is_of_masses(motion_kind_of(the_case, Switching::exact))) return std::nullopt;
  ImplementedLoop loop = implemented_loop_of(the_case, Switching::sampled);
  const ContactLaw law = loop.backlash.law;
  // With exact switching these laws are the same as kollar.
  if (law == ContactLaw::immediate || law == ContactLaw::play)
    loop.backlash.law = ContactLaw::kollar;
  return ideal_loop(loop);
}

double divergence_bound(const Case& the_case, double kick) {
  Case kicked = the_case;
  kicked.initial.z1 = std::abs(kicked.initial.z1) + std::abs(kick);
  return divergence_bound(moving_loop_of(kicked, {}));
}

std::string divergence_warning(const Case& the_case, bool controlled, double kick, double time,
                               double size) {
  const std::string grown = "the motion diverges: by t = " + format_rounded(time) +
                            " s it has grown to " + format_rounded(size) + " (m, m/s)";
  if (!(size < divergence_bound(the_case, kick)))
    return grown + ", more than any bounded motion of this loop reaches";
  const bool has_play =
      law_of(the_case.backlash.law) != ContactLaw::none && the_case.backlash.width > 0.0;
  if (!controlled || has_play || !has_ideal_computer(the_case) || size == 0.0) return "";
  const double radius = LinearLoop(the_case).radius(gains_of(the_case));
  if (!(radius > 1.0 + 1e-9)) return "";
  return grown + ", and nothing bounds it: the loop is unstable with the spectral radius " +
         format_number(std::round(radius * 1e9) / 1e9);
}

}  // namespace holdfast::program
