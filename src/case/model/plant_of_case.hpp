#pragma once

#include <cstdint>

#include "case/case.hpp"
#include "holdfast/control/gains.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/excitation/harmonic_excitation.hpp"
#include "holdfast/excitation/harmonic_input.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "holdfast/stability/chart/loop_chart.hpp"

namespace holdfast::program {

/// The library's objects for what a case file says of plant, control and excitation. Each throws
/// MissingKeys where the case does not say it.
TwoMass<double> plant_of(const Case& the_case);
PdGains<double> gains_of(const Case& the_case);
Sampling<double> sampling_of(const Case& the_case);
/// The exact discretisation of the loop, and what its stability depends on.
SampledLoop<double> loop_of(const Case& the_case);
OperatingPoint operating_point_of(const Case& the_case);
HarmonicExcitation<double> excitation_of(const Case& the_case);
/// Excitation of a motion, which can do without: where the case has neither amplitude nor frequency
/// it is no force, with the period of a sample for want of another.
HarmonicExcitation<double> motion_excitation_of(const Case& the_case);
ForceHold force_hold_of(const Case& the_case);
Vector<double, 4> initial_state_of(const Case& the_case);

/// Seconds that the case's force lasts: to the last row of its record; infinite without one.
double end_of_force(const Case& the_case);

/// Throws NoAnswer where motions have more samples than are followed, 10¹⁰.
void require_bearable(double samples);

/// Number of samples of a motion of the case at t = 0, τ, … up to the last one not after
/// `duration`, s. Throws WrongInput where the recorded force of the case ends before, NoAnswer
/// where they are not bearable.
std::int64_t samples_of(const Case& the_case, double duration);

}  // namespace holdfast::program
