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

/// Two masses in the paper's model, from one sampling period to the next.
struct SampledMasses {
  static constexpr bool by_events = false;
  IdealLoop<double> loop;
  Vector<double, 4> state;  ///< the initial one, as below
};

/// Two masses with all that is built, from one event to the next.
struct BuiltMasses {
  static constexpr bool by_events = true;
  ImplementedLoop loop;
  Vector<double, 4> state;
};

/// A conductor by its modes in the paper's model.
struct SampledModes {
  static constexpr bool by_events = false;
  ModalLoop loop;
  ModalMotion::Full state;
  std::vector<PlantPole> poles;  ///< of conductor and absorber
};

/// A plant of any order, a conductor's or one of the user's own, with all that is built.
struct BuiltPlant {
  static constexpr bool by_events = true;
  ImplementedLoopOf<ControlledPlant> loop;
  Vector<double, Eigen::Dynamic> state;
};

/// The loop of a case as its motion sees it: the one place that decides by which of the library's
/// motions a case moves. What a job asks of it is an overload for each, or a visitor of `loop` and
/// `state`.
using MovingLoop = std::variant<SampledMasses, BuiltMasses, SampledModes, BuiltPlant>;

/// The moving loops that go from event to event.
using BuiltLoop = std::variant<BuiltMasses, BuiltPlant>;

/// The moving loop of a case.
/// @throws MissingKeys, WrongInput, NoAnswer or InvalidParameter where there is no such motion
MovingLoop moving_loop_of(const Case& the_case, const MotionChoice& choice);

/// The loop with all that the case says of it, also where the paper's model is all there is to it.
BuiltLoop built_loop_of(const Case& the_case, const MotionChoice& choice);

/// Two masses in the paper's model, whatever else the case says.
SampledMasses sampled_masses_of(const Case& the_case);

/// `moving_loop_of` for orbits, basins, exponents and verdicts, which need tangents.
/// @throws WrongInput for a plant of any order whose computer limits force or reading
MovingLoop smooth_loop_of(const Case& the_case, Switching switching);

/// The motion of a moving loop from its initial state.
SampledMotion<double> motion_of(const SampledMasses& moving);
EventMotion<> motion_of(const BuiltMasses& moving);
ModalMotion motion_of(const SampledModes& moving);
EventMotion<DriveContact<ControlledPlant>> motion_of(const BuiltPlant& moving);

/// Hold and sampling of a moving loop: members of its loop, or of the computer of that.
template <class Moving>
auto& clock_of(Moving& moving) {
  if constexpr (Moving::by_events)
    return moving.loop.digital;
  else
    return moving.loop;
}

/// τ, s.
double period_of(const MovingLoop& moving);

/// A size (m, m/s) that no bounded motion of a moving loop reaches.
double divergence_bound(const MovingLoop& moving);

/// The plant alone under the force that acts on it, which no computer holds: P = D = 0, a drive
/// without backlash, and samples that show the peaks of the motion; in the paper's model where the
/// force has one harmonic. Nothing of backlash and computer counts but the sampling period, by
/// which the modes of a conductor may be chosen.
/// @param duration  s, of the motion
MovingLoop motion_without_control(const Case& the_case, double duration);

}  // namespace holdfast::program
