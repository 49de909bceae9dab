#pragma once

#include <toml++/toml.h>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "case/case_keys.hpp"

namespace holdfast::program {

/// The tables of a case file. Throws WrongInput with file and line and, where there is a guess,
/// what is probably wrong.
toml::table parse_case_text(std::string_view text, const std::string& name);

/// What a value may be that stands without quotes on a command line.
enum class ValueForm {
  number,
  name,  ///< of a file or a conductor: any text
  other
};
ValueForm form_of(const CaseKey& key);

/// The value of an override, under "value": TOML, or a word or a name without quotes.
/// Throws WrongInput, which begins with the place.
toml::table parse_override_value(ValueForm form, const std::string& admissible,
                                 std::string_view value, const std::string& place);

/// What is admissible, in words, the words among it, and the unit of a number.
struct Admissible {
  std::string text;
  const std::vector<std::string>& words;
  std::string unit;
};

/// A number, or a text of one with a unit, in the own unit; nothing where the node is neither, NaN
/// where it is a number of some other kind. Throws WrongInput, which begins with the place and
/// names the units that would do, for a unit of something else.
std::optional<double> number_in(const toml::node& node, const std::string& unit,
                                const std::string& place);

/// What a node holds. Each throws WrongInput, which begins with the place, where it is something
/// else, or a number that is out of range.
double read_number(const toml::node& node, const AdmissibleRange& range,
                   const Admissible& admissible, const std::string& place);
std::vector<double> read_numbers(const toml::node& node, const AdmissibleRange& range,
                                 const Admissible& admissible, const std::string& place);
std::string read_word(const toml::node& node, const Admissible& admissible,
                      const std::string& place);
/// As it stands there; "" where that is given.
std::string read_file_name(const toml::node& node, const std::string& admissible,
                           const std::string& place);

/// As a file would have it, numbers with their shortest digits; the beginning where it is long.
std::string value_text(const toml::node& node);

/// A TOML float: digits alone would be an integer, of which TOML has only 64 bits.
std::string toml_number(double value);
std::string toml_numbers(const std::vector<double>& values);

/// A TOML string: quotes, backslashes and control characters are escaped.
std::string toml_string(std::string_view text);

/// A line of a case file: `assignment  # comment`.
std::string commented(std::string assignment, const std::string& comment);

}  // namespace holdfast::program
