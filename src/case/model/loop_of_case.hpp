#pragma once

#include <optional>
#include <string>

#include "case/case.hpp"
#include "case/model/plant_of_case.hpp"
#include "holdfast/motion/ideal_loop.hpp"
#include "holdfast/motion/implemented_loop.hpp"
#include "holdfast/motion/sampled_motion.hpp"

namespace holdfast::program {

/// Model options of a motion: when the drive's contact switches, and whether the controller acts.
struct MotionChoice {
  Switching switching = Switching::sampled;
  bool controlled = true;
};

/// The loop of a case in the paper's model: plant, sampling, gains, force and backlash.
IdealLoop<double> ideal_loop_of(const Case& the_case);

/// The loop, an IdealLoop or a ModalLoop, with P = D = 0 and a drive without backlash.
template <class Loop>
Loop uncontrolled(Loop loop) {
  loop.gains = {0.0, 0.0};
  loop.backlash_width = 0.0;
  return loop;
}

/// Quanta of the readings, source of the velocity and largest force of the computer.
ControllerLimits controller_limits_of(const Case& the_case);

/// Whether the computer has no quanta, no velocity by difference, no force limit and no jitter.
bool has_ideal_computer(const Case& the_case);

/// Model by which a motion is computed. `…_masses`: two masses, delay at most a sampling period;
/// `…_modes` and `…_plant`: a conductor by its modes, or a filter, drive lag, longer delay or user-
/// defined part. `sampled_…`: the paper's model (IdealLoop): contact switches at samples, backlash
/// law "kollar" or "none", one harmonic, ideal computer. `built_…`: all else, from event to event.
enum class MotionKind { sampled_masses, built_masses, sampled_modes, built_plant };
MotionKind motion_kind_of(const Case& the_case, Switching switching);

constexpr bool is_sampled(MotionKind kind) {
  return kind == MotionKind::sampled_masses || kind == MotionKind::sampled_modes;
}
constexpr bool is_of_masses(MotionKind kind) {
  return kind == MotionKind::sampled_masses || kind == MotionKind::built_masses;
}

/// Whether the linear loop has closed forms (order 4 + 1): a `…_masses` kind, measured velocity.
bool has_closed_forms(const Case& the_case);

/// The paper's loop for exact switching of the contact. nullopt unless the case has two masses, one
/// harmonic, an ideal computer, and a backlash law other than "dead_zone".
std::optional<IdealLoop<double>> exactly_switched_loop_of(const Case& the_case);

/// Throws MissingKeys for missing keys of the loop and its motion. A long job calls it first.
void require_loop_keys(const Case& the_case);

/// The loop of two masses with all features of the case.
ImplementedLoop implemented_loop_of(const Case& the_case, Switching switching);

/// The loop with P = D = 0 and a drive without backlash.
template <class Plant>
ImplementedLoopOf<Plant> uncontrolled(ImplementedLoopOf<Plant> loop) {
  loop.digital.gains = {0.0, 0.0};
  loop.backlash = {ContactLaw::none};
  return loop;
}

/// Size (m, m/s) that no bounded motion of the case reaches, even after a displacement `kick` (m).
double divergence_bound(const Case& the_case, double kick);

/// A warning that a motion diverges: its size exceeds divergence_bound(), or the loop is unstable
/// and neither play, a largest force nor quanta bound its growth. Empty otherwise.
/// @param controlled  false: without control
/// @param kick        displacement (m) applied once during the motion; 0: none
/// @param size        size (m, m/s) that the motion has reached at `time` (s)
std::string divergence_warning(const Case& the_case, bool controlled, double kick, double time,
                               double size);

}  // namespace holdfast::program
