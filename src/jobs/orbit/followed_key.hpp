#pragma once

#include <string>
#include <utility>

#include "case/axes/axis.hpp"
#include "case/case.hpp"

namespace holdfast::program {

/// KEY=MIN:MAX, given to an option (`--follow`). Throws WrongInput for another form.
std::pair<std::string, Range> parse_key_range(const std::string& option, const std::string& text);

/// Whether a key changes how sampling and excitation coincide.
bool moves_the_coincidence(const std::string& key);

/// The case's value of a key along which an orbit can be followed within a range.
/// Throws WrongInput, naming option, key and range, where there is none.
/// @param text       as it was given, KEY=MIN:MAX
/// @param own_ratio  keys that move the coincidence of sampling and excitation go too
double followed_value(const Case& the_case, const std::string& option, const std::string& text,
                      const std::string& key, const Range& range, bool own_ratio);

}  // namespace holdfast::program
