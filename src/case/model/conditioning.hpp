#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "case/case.hpp"
#include "holdfast/chaos/lyapunov_run.hpp"

namespace holdfast::program {

/// Warnings of results that are sensitive to small changes of the case, or that differ because the
/// force is held between samples. Each warning is one line, or empty.

/// Warns of a reduction near its double solution, where k2 and m1 are very sensitive.
std::string sensitive_reduction_warning(const Case& the_case);

/// Warns of an orbit near a switching surface.
/// @param border_share  distance / size of the orbit, from PeriodicOrbit or EventOrbit
std::string near_border_warning(double border_share);

/// Warns of an orbit with copies shifted in time: motions may settle on different copies and never
/// approach each other, though each copy is asymptotically stable.
/// @param period       period of the orbit (samples)
/// @param coincidence  samples after which the force repeats at the samples, 1 … period
std::string shifted_copies_warning(std::int64_t period, std::int64_t coincidence);

/// Warns of a largest Lyapunov exponent whose sign is uncertain.
std::string open_sign_warning(const LyapunovResult& result);

/// Warns of Lyapunov exponents with quantised readings, whose derivative is 0 between steps.
std::string stepped_reading_warning(const Case& the_case);

/// Warns of Lyapunov exponents averaged over fewer than 20 forcing periods.
/// @param averaged  duration of the average (s)
std::string short_average_warning(const Case& the_case, double averaged);

/// Time (s) in which the slowest natural motion of a stable loop decays to a twentieth.
/// @param radius  spectral radius of the loop, below 1
double settling_time(double radius, double sampling_period);

/// Warns that motions of a conductor do not settle within half of a duration (s).
std::string transient_warning(const Case& the_case, double duration);

/// Ratio of the amplitudes without control under the force held over a sampling period τ (s) and
/// under the true force, at f (Hz); 1 if the case integrates the force exactly or has none.
double held_share(const Case& the_case, double sampling_period, double frequency);

/// Warns of a held_share() that differs from 1 by more than 2 %; empty otherwise.
/// @param shown  end of the warning, after a semicolon: "ratios are to the true one"
std::string held_force_warning(const Case& the_case, double sampling_period, double frequency,
                               const std::string& shown);
/// Warns of the held force at the case's own τ and f.
std::string held_force_warning(const Case& the_case, const std::string& shown);

}  // namespace holdfast::program
