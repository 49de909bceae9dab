#pragma once

#include <string>

#include "case/case.hpp"

namespace holdfast::program {

/// The amplitude without control under the force as the case holds it over a sampling period τ (s),
/// as a share of that under the true force at f (Hz); 1 where the case integrates the force
/// exactly.
double held_share(const Case& the_case, double sampling_period, double frequency);

/// A warning where the two differ by more than 2 %, with what is shown; empty elsewhere.
/// @param shown  behind a semicolon: "ratios are to the true one"
std::string held_force_warning(const Case& the_case, double sampling_period, double frequency,
                               const std::string& shown);
/// The same at the case's own τ and f.
std::string held_force_warning(const Case& the_case, const std::string& shown);

}  // namespace holdfast::program
