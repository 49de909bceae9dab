#pragma once

#include <string>
#include <vector>

#include "case/case.hpp"
#include "holdfast/span/wind/wind_history.hpp"
#include "jobs/span/aeolian_amplitudes.hpp"

namespace holdfast::program {

/// The case's span in a wind that sheds its vortices at a frequency (Hz), with a wake at every
/// place along it, the turbulence of the site and self-damping by the first law that is known; from
/// rest but for a hundredth of the diameter in the mode nearest to the shedding. Throws WrongInput
/// for a conductor without diameter, and for a frequency or duration (s) that would take hours.
WindHistory wind_history_of(const Case& the_case, bool controlled, double frequency,
                            double duration);

/// What the history says beside the energy balance, in one sentence.
std::string history_text(const WindHistory& history, const std::vector<AeolianRow>& balance,
                         double diameter);

}  // namespace holdfast::program
