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
  double value;  ///< value of the key in the case
};

/// Key, range and case value of an option (`--follow` or `--map`). Throws WrongInput, naming
/// option, key and range, where the orbit cannot be followed along the key. `--map` also admits
/// control.sampling_period and excitation.frequency.
/// @param text  KEY=MIN:MAX
FollowedKey followed_key(const Case& the_case, const std::string& option, const std::string& text);

/// Writes the border of the region, in the plane of two keys, in which the case's periodic motion
/// exists and is stable. Each piece of the border has the name of the event that ends the motion.
/// If a key is the sampling period τ or excitation frequency f, the other varies with constant f τ.
/// Throws WrongInput where the motion cannot be followed along the keys, NoAnswer where it has no
/// certified orbit.
/// @param axes            two texts KEY=MIN:MAX
/// @param largest_period  longest period of the orbit, samples
void write_motion_borders(const JobContext& context, const std::vector<std::string>& axes,
                          std::int64_t largest_period, Switching switching);

}  // namespace holdfast::program
