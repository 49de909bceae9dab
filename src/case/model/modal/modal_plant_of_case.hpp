#pragma once

#include <complex>
#include <string>
#include <vector>

#include "case/case.hpp"
#include "case/model/loop_of_case.hpp"
#include "case/model/modal/conductor_modes.hpp"
#include "case/model/plant_of_case.hpp"
#include "holdfast/control/controlled_plant.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/motion/implemented_loop.hpp"
#include "holdfast/motion/modal/modal_motion.hpp"
#include "holdfast/plant/conductor_with_absorber.hpp"
#include "holdfast/plant/linear_plant.hpp"
#include "holdfast/plant/loop_hardware.hpp"
#include "holdfast/plant/plant_poles.hpp"
#include "holdfast/stability/boundary/unit_circle_crossings.hpp"
#include "holdfast/stability/response/response.hpp"

namespace holdfast::program {

/// Throws WrongInput where no absorber hangs on the conductor.
void require_absorber(const Case& the_case);

/// The absorber with what of it moves with the conductor. Throws WrongInput where there is none.
Absorber<double> absorber_of(const Case& the_case);

/// Measurement filter and drive.
LoopHardware hardware_of(const Case& the_case);

/// The plant of a modal case, with filter and drive.
LinearPlant<double> modal_plant_of(const Case& the_case);

/// That plant with the poles of conductor and absorber; those found last are remembered. Throws
/// NoAnswer where two natural motions of it cannot be told apart.
ConductorWithAbsorber conductor_with_absorber_of(const Case& the_case);

/// The poles from the command to the readings, those of filter and drive too. Throws as above.
std::vector<PlantPole> loop_poles_of(const Case& the_case);

/// The readings by the command, of any case, as a sum over those poles. Throws as above.
ModalResponse<double> command_response_of(const Case& the_case);

/// The root of a modal case's loop of largest modulus; NaN where the roots were not found.
std::complex<double> largest_root_of(const Case& the_case, const PdGains<double>& gains);

/// Whether the gains of a case on all modes would be stable with another clamp mass (kg), judged by
/// 60 modes kept apart.
bool is_stable_with_clamp(const Case& the_case, double clamp_mass);

/// Other modes of the same conductor, to show how far an answer depends on those kept.
struct OtherModes {
  UnitCircleCrossings<double> circle;
  std::string words;  ///< "with all modes"

  bool is_stable(const PdGains<double>& gains) const { return circle.roots_outside(gains) == 0; }
};

/// With all modes where the case gives how many; else those of the judge (below), or half as many
/// where it has no more, and of a cable with fewer bars.
OtherModes other_modes_of(const Case& the_case);

/// The loop of a case's absorber and computer as the one judge of its stability sees it: on the
/// taut string with all devices, by all modes that the sampling can excite (`judged_modes_of`),
/// whatever plant.model and plant.modes say.
struct JudgedLoop {
  UnitCircleCrossings<double> circle;
  int modes;       ///< so many one by one, the faster ones bundled
  double highest;  ///< Hz, of the last of them

  bool is_stable(const PdGains<double>& gains) const { return circle.roots_outside(gains) == 0; }
};

/// Throws what `conductor_with_absorber_of` does, and WrongInput for a measured device.
JudgedLoop judged_loop_of(const Case& the_case);

/// Its loop without the modes above twice the sampling rate, which is not how a string is.
JudgedLoop cut_loop_of(const Case& the_case);

/// Whether a case is of a string whose modes the program chooses, of which the judge has more.
bool has_chosen_modes(const Case& the_case);

/// Objection of the judge to a loop that is stable by the modes that a case is computed with; empty
/// where it agrees, and without chosen modes.
std::string judged_otherwise(const Case& the_case);

/// The steady response of the loop of either kind of plant at ω (rad/s), and its amplitude without
/// control under the true force, m/N.
SteadyResponse<double> steady_response_of(const Case& the_case, const Sampling<double>& sampling,
                                          ForceHold hold, double angular_frequency);
double true_amplitude_of(const Case& the_case, double angular_frequency);

/// The loop of a modal case with all that the case says of it, its controller being one of the
/// plant's own, whose memory are the commands on their way. Throws WrongInput for a string without
/// ends that nothing is clamped to.
ImplementedLoopOf<ControlledPlant> conductor_loop_of(const Case& the_case,
                                                     const MotionChoice& choice);

/// The initial state of a modal case under all that is built, from what is seen of it, [z1, v1, z2,
/// v2]: the conductor as a force at the absorber's place bends it to z1, with the velocities that a
/// blow there gives it to have v1; drive and commands at 0, the filter settled.
Vector<double, Eigen::Dynamic> modal_state_of(const Case& the_case, const Vector<double, 4>& seen);

}  // namespace holdfast::program
