#pragma once

#include <toml++/toml.h>
#include <string>
#include <string_view>
#include <vector>

#include "case/case.hpp"

namespace holdfast::program {

/// A key of a case and the numbers that it may have.
struct UncertainRange {
  std::string key;
  double lowest;
  double highest;
};

/// The ranges of [uncertain], those about a key's value made from it. Throws WrongInput, naming the
/// key, where a range leaves what the key admits, or the case has no value to be about.
std::vector<UncertainRange> uncertain_ranges(const Case& the_case);

/// A value of [uncertain]: [lowest, highest], "± 5 %", "+- 0.001" or "± 2 mm". Throws WrongInput,
/// which begins with the place.
case_tables::Uncertain read_uncertain(const std::string& key, const toml::node& node,
                                      const std::string& place);

/// The value of an override, under "value": a list, or a text with or without quotes. Throws
/// WrongInput, which begins with the place.
toml::table uncertain_override(std::string_view value, const std::string& place);

/// As a file would have it.
std::string uncertain_to_toml(const case_tables::Uncertain& uncertain);

}  // namespace holdfast::program
