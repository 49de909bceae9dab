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

/// Throws WrongInput if the conductor has no absorber, MissingKeys if its mass is not known.
void require_absorber(const Case& the_case);

/// The absorber with its clamp mass. Throws WrongInput if there is none.
Absorber<double> absorber_of(const Case& the_case);

/// Measurement filter, drive lag and velocity sensor of a case.
LoopHardware hardware_of(const Case& the_case);

/// The linear plant of a modal case, with filter and drive.
LinearPlant<double> modal_plant_of(const Case& the_case);

/// The conductor with absorber, filter and drive, and the poles of conductor and absorber; the last
/// poles found are cached. Throws NoAnswer if two poles nearly coincide.
ConductorWithAbsorber conductor_with_absorber_of(const Case& the_case);

/// The poles from command to readings, with filter and drive. Throws NoAnswer if two coincide.
std::vector<PlantPole> loop_poles_of(const Case& the_case);

/// The response of the readings to the command, as a sum over poles, for any case.
ModalResponse<double> command_response_of(const Case& the_case);

/// The characteristic root of largest modulus of a modal case's loop; NaN if roots were not found.
std::complex<double> largest_root_of(const Case& the_case, const PdGains<double>& gains);

/// Whether the gains of a case are stable with another clamp mass (kg), for all modes of the
/// conductor: 60 single ones and bundles.
bool is_stable_with_clamp(const Case& the_case, double clamp_mass);

/// The loop with other modes of the same conductor, to show how far a result depends on the modes.
struct OtherModes {
  UnitCircleCrossings<double> circle;
  std::string words;  ///< description of the modes: "with all modes"

  bool is_stable(const PdGains<double>& gains) const { return circle.roots_outside(gains) == 0; }
};

/// The loop with all modes if the case gives plant.modes; else with more single modes by
/// `judged_modes_of`, or with fewer by `coarser_modes_of` where there are no more.
OtherModes other_modes_of(const Case& the_case);

/// The loop of a case's absorber and computer for the test of its stability: on the taut string
/// with all devices and the modes of `judged_modes_of`, whatever plant.model and plant.modes are.
struct JudgedLoop {
  UnitCircleCrossings<double> circle;
  int modes;       ///< number of single modes; faster modes are bundled
  double highest;  ///< frequency of the last single mode (Hz)

  bool is_stable(const PdGains<double>& gains) const { return circle.roots_outside(gains) == 0; }
};

/// The JudgedLoop of a case. Throws WrongInput for a measured device, NoAnswer if poles coincide.
JudgedLoop judged_loop_of(const Case& the_case);

/// The JudgedLoop of a case without its modes above twice the sampling rate, for comparison.
JudgedLoop cut_loop_of(const Case& the_case);

/// Whether plant.model is "string" and the program chooses the number of modes.
bool has_chosen_modes(const Case& the_case);

/// A warning if the loop is stable with the modes of the case, but unstable by `judged_loop_of`;
/// empty if both agree, and if !has_chosen_modes().
std::string judged_otherwise(const Case& the_case);

/// The steady response of the loop of any plant at ω (rad/s), and the amplitude without control per
/// newton of the true force (m/N).
SteadyResponse<double> steady_response_of(const Case& the_case, const Sampling<double>& sampling,
                                          ForceHold hold, double angular_frequency);
double true_amplitude_of(const Case& the_case, double angular_frequency);

/// The loop of a modal case with all its features. The plant includes the controller, whose memory
/// is the delayed commands. Throws WrongInput for a string without ends and without clamp mass.
ImplementedLoopOf<ControlledPlant> conductor_loop_of(const Case& the_case,
                                                     const MotionChoice& choice);

/// The initial state of `conductor_loop_of` for given `seen` = [z1, v1, z2, v2] (m, m/s). The
/// conductor is deflected to z1 by a static force at the absorber's place and has the velocities of
/// an impulse there. Drive and commands are 0; the filter is settled.
Vector<double, Eigen::Dynamic> modal_state_of(const Case& the_case, const Vector<double, 4>& seen);

}  // namespace holdfast::program
