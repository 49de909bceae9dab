#pragma once

#include <optional>
#include <string>

#include "case/case.hpp"
#include "case/model/plant_of_case.hpp"
#include "holdfast/motion/ideal_loop.hpp"
#include "holdfast/motion/implemented_loop.hpp"
#include "holdfast/motion/sampled_motion.hpp"

namespace holdfast::program {

/// Options of a motion of a case: its switching, and with or without control.
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

/// The four models of a motion. `masses`: two masses, delay at most one sampling period.
/// `modes` or `plant`: a conductor by its modes, or any filter, drive lag, longer delay or user-
/// defined part. `sampled`: the paper's model of IdealLoop: switching at samples, its backlash law
/// or none, one harmonic, ideal computer. `built`: all others, integrated from event to event.
enum class MotionKind { sampled_masses, built_masses, sampled_modes, built_plant };
MotionKind motion_kind_of(const Case& the_case, Switching switching);

constexpr bool is_sampled(MotionKind kind) {
  return kind == MotionKind::sampled_masses || kind == MotionKind::sampled_modes;
}
constexpr bool is_of_masses(MotionKind kind) {
  return kind == MotionKind::sampled_masses || kind == MotionKind::built_masses;
}

/// Whether the linear loop has closed forms (order 4 + 1): two masses with measured velocity.
bool has_closed_forms(const Case& the_case);

/// The loop of a case that differs from the paper's model only by exact switching: play or none,
/// one harmonic, an ideal computer. None for any other case.
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

/// Bound of the state (m, m/s) in bounded motions of the case, even if kicked by `kick` (m).
double divergence_bound(const Case& the_case, double kick);

/// A warning that a motion diverges: its size exceeds divergence_bound(), or the loop is unstable
/// and neither play, a largest force nor quanta bound its growth. Empty otherwise.
/// @param controlled  false: without control
/// @param kick        displacement (m) applied once during the motion; 0: none
/// @param size        size (m, m/s) that the motion has reached at `time` (s)
std::string divergence_warning(const Case& the_case, bool controlled, double kick, double time,
                               double size);

}  // namespace holdfast::program
