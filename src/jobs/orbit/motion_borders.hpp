#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "case/job_context.hpp"
#include "holdfast/contact/contact.hpp"

namespace holdfast::program {

/// Writes the border of the region of two keys in which the case's periodic motion is and attracts,
/// in pieces, each named by what ends the motion there. With the sampling period or the frequency
/// of the excitation as a key f τ stays as it is.
/// Throws WrongInput where the keys or their ranges cannot be followed, NoAnswer where the motion
/// has no certified orbit.
/// @param axes            KEY=MIN:MAX, two
/// @param largest_period  of the orbit, samples
void write_motion_borders(const JobContext& context, const std::vector<std::string>& axes,
                          std::int64_t largest_period, Switching switching);

}  // namespace holdfast::program
