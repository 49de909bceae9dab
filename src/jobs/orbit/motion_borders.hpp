#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "case/axes/axis.hpp"
#include "case/job_context.hpp"
#include "holdfast/contact/contact.hpp"

namespace holdfast::program {

/// A key along which an orbit is followed.
struct FollowedKey {
  std::string name;
  Range range;
  double value;  ///< of the case
};

/// The key that an option (`--follow`, `--map`) asks for. Throws WrongInput, naming option, key and
/// range, where the orbit cannot be followed along it; on a map keys that move the coincidence of
/// sampling and excitation go too.
/// @param text  KEY=MIN:MAX
FollowedKey followed_key(const Case& the_case, const std::string& option, const std::string& text);

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
