#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "case/case.hpp"
#include "holdfast/chaos/lyapunov_run.hpp"
#include "holdfast/stability/boundary/boundary_point.hpp"

namespace holdfast::program {

/// Warnings of an answer that a small change of the question would change much, or that is not of
/// the true force; empty where there is nothing. Each is one line.

/// Warns of a reduction near its double solution.
std::string sensitive_reduction_warning(const Case& the_case);

/// Warns of tangents of the boundary that are nearly a cusp.
std::string near_cusp_warning(const std::vector<BoundaryFeature<long double>>& features);

/// Warns of an orbit near a switching surface.
/// @param border_share  of PeriodicOrbit or EventOrbit
std::string near_border_warning(double border_share);

/// Warns of an orbit that has copies shifted in time: neighbours may come to different ones and
/// stay apart for good, though each is asymptotically stable.
/// @param period       of the orbit (samples)
/// @param coincidence  samples after which sampling and forcing meet again; 0 < coincidence ≤
/// period
std::string shifted_copies_warning(std::int64_t period, std::int64_t coincidence);

/// Warns of a largest exponent whose sign is not known.
std::string open_sign_warning(const LyapunovResult& result);

/// Warns of exponents along a motion whose reading has steps, between which its derivative is zero.
std::string stepped_reading_warning(const Case& the_case);

/// Warns of exponents averaged over few forcing periods.
/// @param averaged  s
std::string short_average_warning(const Case& the_case, double averaged);

/// The amplitude without control under the force as the case holds it over a sampling period τ (s),
/// as a share of that under the true force at f (Hz); 1 where the case integrates the force
/// exactly.
double held_share(const Case& the_case, double sampling_period, double frequency);

/// A warning where the two differ by more than 2 %, with what is shown; empty elsewhere.
/// @param shown  behind a semicolon: "ratios are to the true one"
std::string held_force_warning(const Case& the_case, double sampling_period, double frequency,
                               const std::string& shown);
/// Warning about the held force at the case's own τ and f.
std::string held_force_warning(const Case& the_case, const std::string& shown);

}  // namespace holdfast::program
