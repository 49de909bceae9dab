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

/// Linear plant of a modal case, with filter and drive lag. Throws NoAnswer if it has devices.
LinearPlant<double> modal_plant_of(const Case& the_case);

/// Conductor with absorber, filter and drive, and the poles of conductor and absorber, which are
/// cached. Throws NoAnswer if two poles nearly coincide, WrongInput for a user-defined plant.
ConductorWithAbsorber conductor_with_absorber_of(const Case& the_case);

/// Poles from command to readings, with filter and drive. Throws NoAnswer if two nearly coincide.
std::vector<PlantPole> loop_poles_of(const Case& the_case);

/// The response of the readings to the command, as a sum over poles, for any case.
ModalResponse<double> command_response_of(const Case& the_case);

/// The characteristic root of largest modulus of a modal case's loop; NaN if roots were not found.
std::complex<double> largest_root_of(const Case& the_case, const PdGains<double>& gains);

/// Whether the loop of a case is stable with another clamp mass (kg), computed with 60 single modes
/// of the conductor and bundles of all faster modes.
bool is_stable_with_clamp(const Case& the_case, double clamp_mass);

/// Loop with another number of modes, to show how much a result depends on that number.
struct OtherModes {
  UnitCircleCrossings<double> circle;
  std::string words;  ///< description of the modes: "with all modes"

  bool is_stable(const PdGains<double>& gains) const { return circle.roots_outside(gains) == 0; }
};

/// Loop with another number of modes than the case: all modes if the case gives plant.modes; else
/// more single modes by `judged_modes_of`, or, if these are no more, fewer by `coarser_modes_of`.
OtherModes other_modes_of(const Case& the_case);

/// Reference loop for the test of stability: absorber and computer of a case on the taut string
/// with all devices and the modes of `judged_modes_of`. plant.model and plant.modes are ignored.
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

/// Message that a loop, known to be stable with the modes of the case, is unstable with more modes
/// by `judged_loop_of`. Empty if it is stable with these too, or if !has_chosen_modes().
std::string judged_otherwise(const Case& the_case);

/// Steady response of the loop of any plant at ω (rad/s). true_amplitude_of() is the amplitude
/// without control per newton of the continuous (not held) force (m/N).
SteadyResponse<double> steady_response_of(const Case& the_case, const Sampling<double>& sampling,
                                          ForceHold hold, double angular_frequency);
double true_amplitude_of(const Case& the_case, double angular_frequency);

/// Loop of a modal case with all its features. The plant's state includes the controller's memory
/// (delayed commands). Throws WrongInput for a string without ends and without clamp mass.
ImplementedLoopOf<ControlledPlant> conductor_loop_of(const Case& the_case,
                                                     const MotionChoice& choice);

/// Initial state of `conductor_loop_of` for given `seen` = [z1, v1, z2, v2] (m, m/s) at the
/// absorber's place. The conductor has the shape of a static force there and the velocities of an
/// impulse there. Drive and commands are 0; the filter is settled.
Vector<double, Eigen::Dynamic> modal_state_of(const Case& the_case, const Vector<double, 4>& seen);

}  // namespace holdfast::program
