#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "case/case.hpp"
#include "holdfast/chaos/lyapunov_run.hpp"

namespace holdfast::program {

/// Texts of warnings about results that are sensitive to small changes of the case, or that the
/// hold of the force between samples changes. Each is one line; empty: nothing to warn about.

/// Warning about a reduction near its double solution, where k2 and m1 are very sensitive.
std::string sensitive_reduction_warning(const Case& the_case);

/// Warning about an orbit near a switching surface.
/// @param border_share  distance to the surface / size of the orbit, see PeriodicOrbit, EventOrbit
std::string near_border_warning(double border_share);

/// Warning about an orbit with copies shifted in time: motions may settle on different copies and
/// never approach each other, though each copy is asymptotically stable.
/// @param period       period of the orbit (samples)
/// @param coincidence  samples after which the force repeats at the samples, 1 … period
std::string shifted_copies_warning(std::int64_t period, std::int64_t coincidence);

/// Warning about a largest Lyapunov exponent whose sign is uncertain.
std::string open_sign_warning(const LyapunovResult& result);

/// Warning about Lyapunov exponents with quantised readings, whose derivative is 0 between steps.
std::string stepped_reading_warning(const Case& the_case);

/// Warning about Lyapunov exponents averaged over fewer than 20 forcing periods.
/// @param averaged  duration of the average (s)
std::string short_average_warning(const Case& the_case, double averaged);

/// Time (s) in which the slowest natural motion of a stable loop decays to a twentieth.
/// @param radius  spectral radius of the loop, below 1
double settling_time(double radius, double sampling_period);

/// Warning that motions of a modal conductor do not settle within half of a duration (s).
std::string transient_warning(const Case& the_case, double duration);

/// Amplitude without control under the force held over a sampling period (s), divided by that under
/// the continuous force, at a frequency (Hz); 1 for excitation.hold = "exact" or without a force.
double held_share(const Case& the_case, double sampling_period, double frequency);

/// Warning about a held_share() that differs from 1 by more than 2 %; empty otherwise.
/// @param shown  end of the warning, after a semicolon: "ratios are to the true one"
std::string held_force_warning(const Case& the_case, double sampling_period, double frequency,
                               const std::string& shown);
/// Warning about the held force at the case's own sampling period and excitation frequency.
std::string held_force_warning(const Case& the_case, const std::string& shown);

}  // namespace holdfast::program
