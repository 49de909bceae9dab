#pragma once

#include <toml++/toml.h>
#include <string>
#include <string_view>
#include <vector>

#include "case/case.hpp"

namespace holdfast::program {

/// Uncertainty range of a key of a case, in the key's unit.
struct UncertainRange {
  std::string key;
  double lowest;
  double highest;
};

/// The ranges of [uncertain]; "± ..." is centred on the value in the case. Throws WrongInput,
/// naming the key, if the key does not admit an end of the range or the case has no value for it.
std::vector<UncertainRange> uncertain_ranges(const Case& the_case);

/// Parses a value of [uncertain]: [lowest, highest], "± 5 %", "+- 0.001" or "± 2 mm". Throws
/// WrongInput, whose message begins with the place.
case_tables::Uncertain read_uncertain(const std::string& key, const toml::node& node,
                                      const std::string& place);

/// Parses an override of [uncertain], a list or a text with or without quotes, into a table with
/// the key "value". Throws WrongInput, whose message begins with the place.
toml::table uncertain_override(std::string_view value, const std::string& place);

/// An entry of [uncertain] as a line of a case file.
std::string uncertain_to_toml(const case_tables::Uncertain& uncertain);

}  // namespace holdfast::program
