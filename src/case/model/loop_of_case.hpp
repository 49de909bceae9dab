#pragma once

#include <optional>
#include <string>

#include "case/case.hpp"
#include "case/model/plant_of_case.hpp"
#include "holdfast/motion/ideal_loop.hpp"
#include "holdfast/motion/implemented_loop.hpp"
#include "holdfast/motion/sampled_motion.hpp"

namespace holdfast::program {

/// A case as the motion sees it, with the switching that was asked for and with or without control.
struct MotionChoice {
  Switching switching = Switching::sampled;
  bool controlled = true;
};

/// All that a motion depends on beside its initial state.
IdealLoop<double> ideal_loop_of(const Case& the_case);

/// The loop, an IdealLoop or a ModalLoop, with P = D = 0 and a drive without backlash.
template <class Loop>
Loop uncontrolled(Loop loop) {
  loop.gains = {0.0, 0.0};
  loop.backlash_width = 0.0;
  return loop;
}

/// Quanta, differences and limits of the computer.
ControllerLimits controller_limits_of(const Case& the_case);

/// Whether the computer reads and commands without quanta, differences, limits and jitter.
bool has_ideal_computer(const Case& the_case);

/// The four ways in which a case moves. Masses are two, alone with a computer whose force comes
/// within the sample; a conductor itself, a filter, a lag, a later force and all that is the user's
/// own are followed by natural motions. Sampled is the paper's model, which IdealLoop describes:
/// switching at samples, the paper's backlash or none, one harmonic, an ideal computer; all else is
/// built, and goes from event to event.
enum class MotionKind { sampled_masses, built_masses, sampled_modes, built_plant };
MotionKind motion_kind_of(const Case& the_case, Switching switching);

constexpr bool is_sampled(MotionKind kind) {
  return kind == MotionKind::sampled_masses || kind == MotionKind::sampled_modes;
}
constexpr bool is_of_masses(MotionKind kind) {
  return kind == MotionKind::sampled_masses || kind == MotionKind::built_masses;
}

/// Whether the linear loop is of order 4 + 1, of which there are closed forms: masses with a
/// measured velocity.
bool has_closed_forms(const Case& the_case);

/// The loop of a drive that switches when it happens, where that is all there is to the case beside
/// the paper's model: exact play or none, one harmonic, an ideal computer. Nothing of any other.
std::optional<IdealLoop<double>> exactly_switched_loop_of(const Case& the_case);

/// Throws MissingKeys for what a loop of the case needs, its motion too, and the case has not; a
/// job that computes for long asks first.
void require_loop_keys(const Case& the_case);

/// The loop with all that the case says of it.
ImplementedLoop implemented_loop_of(const Case& the_case, Switching switching);

/// The loop with P = D = 0 and a drive without backlash.
template <class Plant>
ImplementedLoopOf<Plant> uncontrolled(ImplementedLoopOf<Plant> loop) {
  loop.digital.gains = {0.0, 0.0};
  loop.backlash = {ContactLaw::none};
  return loop;
}

/// A size (m, m/s) that no bounded motion of the case reaches, from its initial state or displaced
/// by `kick`, m, on its way.
double divergence_bound(const Case& the_case, double kick);

/// That a motion diverges: it has passed its divergence_bound(), or nothing bounds the growth of an
/// unstable loop, neither a play nor a largest force nor a step of the readings. Empty otherwise.
/// @param controlled  else without control
/// @param kick        displacement on its way, m
/// @param size        that it has reached at `time` (s), m and m/s
std::string divergence_warning(const Case& the_case, bool controlled, double kick, double time,
                               double size);

}  // namespace holdfast::program
