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

/// Plant of a case: two masses. This and the next eight functions convert parts of a case into
/// library objects; each throws MissingKeys if the case lacks a key that it needs.
TwoMass<double> plant_of(const Case& the_case);
PdGains<double> gains_of(const Case& the_case);
Sampling<double> sampling_of(const Case& the_case);
/// Exact discretisation of the two-mass loop; operating_point_of() gives its parameters.
SampledLoop<double> loop_of(const Case& the_case);
OperatingPoint operating_point_of(const Case& the_case);
HarmonicExcitation<double> excitation_of(const Case& the_case);
/// Excitation of a motion. If the case gives neither amplitude nor frequency: 0 N, 1/τ (Hz).
HarmonicExcitation<double> motion_excitation_of(const Case& the_case);
ForceHold force_hold_of(const Case& the_case);
Vector<double, 4> initial_state_of(const Case& the_case);

/// Duration (s) of the case's recorded force, up to its last row; infinite without a record.
double end_of_force(const Case& the_case);

/// Throws NoAnswer if a number of samples, the sum over all motions of a job, exceeds 10¹⁰.
void require_bearable(double samples);

/// Number of samples of a motion of the case: t = 0, τ, … up to `duration` (s). Throws WrongInput
/// if the recorded force ends earlier, NoAnswer for more than 10¹⁰ samples.
std::int64_t samples_of(const Case& the_case, double duration);

}  // namespace holdfast::program
