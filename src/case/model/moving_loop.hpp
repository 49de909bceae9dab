#pragma once

#include <variant>
#include <vector>

#include "case/case.hpp"
#include "case/model/loop_of_case.hpp"
#include "holdfast/control/controlled_plant.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/motion/ideal_loop.hpp"
#include "holdfast/motion/implemented_loop.hpp"
#include "holdfast/motion/modal/modal_motion.hpp"
#include "holdfast/motion/sampled_motion.hpp"
#include "holdfast/plant/plant_poles.hpp"

namespace holdfast::program {

/// Two masses in the paper's model (IdealLoop), with the motion computed from sample to sample.
struct SampledMasses {
  static constexpr bool by_events = false;
  IdealLoop<double> loop;
  Vector<double, 4> state;  ///< initial [z1, v1, z2, v2] (m, m/s)
};

/// Two masses with all features of a case, computed from event to event (sample, contact change).
struct BuiltMasses {
  static constexpr bool by_events = true;
  ImplementedLoop loop;
  Vector<double, 4> state;  ///< initial [z1, v1, z2, v2] (m, m/s)
};

/// A conductor given by its modes in the paper's model, computed from sample to sample.
struct SampledModes {
  static constexpr bool by_events = false;
  ModalLoop loop;
  ModalMotion::Full state;       ///< initial state of the modes and the absorber
  std::vector<PlantPole> poles;  ///< poles of conductor and absorber
};

/// A conductor's or user-defined plant of any order, with all features of a case, by events.
struct BuiltPlant {
  static constexpr bool by_events = true;
  ImplementedLoopOf<ControlledPlant> loop;
  Vector<double, Eigen::Dynamic> state;
};

/// Control loop with its initial state, in one of the four models of MotionKind. Jobs handle it by
/// an overload for each model, or by a visitor of `loop` and `state`.
using MovingLoop = std::variant<SampledMasses, BuiltMasses, SampledModes, BuiltPlant>;

/// The moving loops that are computed from event to event.
using BuiltLoop = std::variant<BuiltMasses, BuiltPlant>;

/// Loop and initial state of a case, in the model that motion_kind_of() gives.
/// @throws MissingKeys, WrongInput, NoAnswer or InvalidParameter where the case has no such motion
MovingLoop moving_loop_of(const Case& the_case, const MotionChoice& choice);

/// The loop with all features of the case, computed by events even if the paper's model would do.
BuiltLoop built_loop_of(const Case& the_case, const MotionChoice& choice);

/// The two masses of a case in the paper's model; its other features are ignored.
SampledMasses sampled_masses_of(const Case& the_case);

/// The moving loop of a case for orbits, basins, exponents and verdicts, which need derivatives.
/// @throws WrongInput for a BuiltPlant with quanta, a largest force or a velocity by difference
MovingLoop smooth_loop_of(const Case& the_case, Switching switching);

/// The motion of a moving loop from its initial state.
SampledMotion<double> motion_of(const SampledMasses& moving);
EventMotion<> motion_of(const BuiltMasses& moving);
ModalMotion motion_of(const SampledModes& moving);
EventMotion<DriveContact<ControlledPlant>> motion_of(const BuiltPlant& moving);

/// The member with `hold` and `sampling`: `loop.digital` if by events, otherwise `loop`.
template <class Moving>
auto& clock_of(Moving& moving) {
  if constexpr (Moving::by_events)
    return moving.loop.digital;
  else
    return moving.loop;
}

/// The sampling period τ (s) of a moving loop.
double period_of(const MovingLoop& moving);

/// A size (m, m/s) that no bounded motion of a moving loop reaches.
double divergence_bound(const MovingLoop& moving);

/// Loop for the motion without control: P = D = 0, no backlash, a force that is not held, and a
/// sampling period short enough to show the peaks. Of [control] and [backlash] only the sampling
/// period is used, to choose the conductor's modes.
/// @param duration  duration of the motion (s)
MovingLoop motion_without_control(const Case& the_case, double duration);

}  // namespace holdfast::program
