#pragma once

#include <cstdint>
#include <string>

#include "case/case.hpp"
#include "compiled_once/sampled_loop.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/excitation/harmonic_excitation.hpp"
#include "holdfast/excitation/harmonic_input.hpp"
#include "holdfast/motion/forced_loop.hpp"
#include "holdfast/motion/real_loop.hpp"
#include "holdfast/motion/sampled_motion.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "holdfast/stability/chart/operating_point.hpp"

namespace holdfast::program {

/// The library's objects for what a case file says.
TwoDof<double> plant_of(const Case& the_case);
PdGains<double> gains_of(const Case& the_case);
Sampling<double> sampling_of(const Case& the_case);
SampledLoop<double> loop_of(const Case& the_case);
LoopPoint loop_point_of(const Case& the_case);
HarmonicExcitation<double> excitation_of(const Case& the_case);
ForceHold force_hold_of(const Case& the_case);
Vector<double, 4> initial_state_of(const Case& the_case);

/// All that a motion depends on beside its initial state.
ForcedLoop<double> forced_loop_of(const Case& the_case);

/// The same with one number of the case changed, by its key. Throws WrongInput where the key or the
/// value is not admissible.
ForcedLoop<double> forced_loop_with(const Case& the_case, const std::string& key, double value);

/// The loop with P = D = 0 and a drive without backlash.
ForcedLoop<double> uncontrolled(ForcedLoop<double> loop);

/// Whether the motion is one of the paper's model, which ForcedLoop describes: switching at
/// samples, the paper's backlash or none, one harmonic, an ideal computer.
bool is_of_the_paper(const Case& the_case, Switching switching);

/// Seconds that the case's force lasts: to the last row of its record; infinite without one.
double end_of_force(const Case& the_case);

/// Number of samples of a motion of the case at t = 0, τ, … up to the last one not after
/// `duration`, s. Throws WrongInput where the recorded force of the case ends before.
std::int64_t samples_of(const Case& the_case, double duration);

/// The motion of the paper's model from the case's initial state.
SampledMotion<double> motion_of(const Case& the_case);

/// The loop with all that the case says of it.
RealLoop real_loop_of(const Case& the_case, Switching switching);

/// The same with one number of the case changed, by its key. Throws WrongInput where the key or the
/// value is not admissible.
RealLoop real_loop_with(const Case& the_case, const std::string& key, double value,
                        Switching switching);

/// The loop with P = D = 0 and a drive without backlash.
RealLoop uncontrolled(RealLoop loop);

}  // namespace holdfast::program
