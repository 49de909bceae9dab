#include "case/uncertain.hpp"

#include <array>
#include <cmath>

#include "case/case_keys.hpp"
#include "case/toml_values.hpp"
#include "case/units.hpp"
#include "process/errors.hpp"
#include "text/text.hpp"

namespace holdfast::program {
namespace {

/// Admissible forms of a range, for messages.
constexpr const char* forms = "[lowest, highest], \"± 5 %\" or \"± 0.001\"";

/// The text after a leading ±, +- or +/-; none without such a sign.
std::optional<std::string_view> behind_sign(std::string_view text) {
  for (const std::string_view sign : {"\u00b1", "+-", "+/-"})
    if (text.substr(0, sign.size()) == sign) return trimmed(text.substr(sign.size()));
  return std::nullopt;
}

}  // namespace

case_tables::Uncertain read_uncertain(const std::string& key, const toml::node& node,
                                      const std::string& place) {
  const CaseKey* known = find_case_key(key);
  if (known == nullptr) throw WrongInput(place + ": " + unknown_key(key));
  if (!known->is_number()) throw WrongInput(place + ": only a key with a number can be uncertain");
  const auto refuse = [&] { throw WrongInput(place + ": must be " + forms); };
  if (const toml::array* ends = node.as_array(); ends != nullptr && ends->size() == 2) {
    std::array<double, 2> value{};
    for (std::size_t k = 0; k < value.size(); ++k)
      value[k] = number_in((*ends)[k], known->unit, place).value_or(std::nan(""));
    if (!(value[0] < value[1]) || !std::isfinite(value[1] - value[0])) refuse();
    return {key, case_tables::Uncertain::Form::interval, value[0], value[1]};
  }
  const auto text = node.value_exact<std::string>();
  const auto size = text ? behind_sign(trimmed(*text)) : std::nullopt;
  if (!size) refuse();
  if (const auto number = parse_number(*size); number && *number > 0.0)
    return {key, case_tables::Uncertain::Form::absolute, *number, *number};
  const auto quantity = written_quantity(*size);
  if (!quantity || !(quantity->value > 0.0)) refuse();
  if (quantity->unit == "%")
    return {key, case_tables::Uncertain::Form::relative, quantity->value / 100.0,
            quantity->value / 100.0};
  const auto value = in_own_unit(*quantity, known->unit);
  if (!value)
    throw WrongInput(place + ": " + quantity->unit + " is not a unit of this key: use %" +
                     (known->unit.empty() ? "" : ", " + units_in_words(known->unit)));
  return {key, case_tables::Uncertain::Form::absolute, *value, *value};
}

toml::table uncertain_override(std::string_view value, const std::string& place) {
  if (value.empty() || (value.front() != '[' && value.front() != '"'))
    return toml::table{{"value", std::string(value)}};
  try {
    return toml::parse("value = " + std::string(value));
  } catch (const toml::parse_error&) {
    throw WrongInput(place + ": must be " + forms +
                     "; write a number with a unit in quotes: [\"1 ms\", \"2 ms\"]");
  }
}

std::vector<UncertainRange> uncertain_ranges(const Case& the_case) {
  using Form = case_tables::Uncertain::Form;
  std::vector<UncertainRange> ranges;
  for (const case_tables::Uncertain& one : the_case.uncertain) {
    UncertainRange range{one.key, one.below, one.above};
    if (one.form != Form::interval) {
      const double value = case_value(the_case, one.key);
      if (!std::isfinite(value))
        throw WrongInput("uncertain." + one.key + ": the case has no value of " + one.key +
                         " to vary: give [lowest, highest]");
      const double scale = one.form == Form::relative ? std::abs(value) : 1.0;
      range.lowest = value - one.below * scale;
      range.highest = value + one.above * scale;
    }
    if (!(range.lowest < range.highest))
      throw WrongInput("uncertain." + one.key +
                       ": a percentage of the value 0 is no range: give [lowest, highest]");
    const CaseKey& key = *find_case_key(one.key);
    for (const double end : {range.lowest, range.highest})
      if (!key.range.contains(end))
        throw WrongInput("uncertain." + one.key + ": end " + format_rounded(end) + " " + key.unit +
                         " of the range is not admissible: must be " + key.admissible());
    ranges.push_back(range);
  }
  return ranges;
}

std::string uncertain_to_toml(const case_tables::Uncertain& uncertain) {
  using Form = case_tables::Uncertain::Form;
  const std::string below = format_number(uncertain.below);
  const std::string value =
      uncertain.form == Form::interval ? "[" + below + ", " + format_number(uncertain.above) + "]"
      : uncertain.form == Form::relative
          ? toml_string("\u00b1 " + format_number(100.0 * uncertain.below) + " %")
          : toml_string("\u00b1 " + below);
  return "\"" + uncertain.key + "\" = " + value + "\n";
}

}  // namespace holdfast::program
