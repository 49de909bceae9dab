#include "case/axes/axis.hpp"

#include <charconv>
#include <cmath>
#include <utility>

#include "case/case_keys.hpp"
#include "process/errors.hpp"
#include "text/text.hpp"

namespace holdfast::program {
namespace {

constexpr std::int64_t most_points = 1'000'000'000;

/// The text of an option and its expected form, which error messages quote.
class OptionText {
 public:
  OptionText(std::string_view option, std::string_view text, std::string_view form)
      : option_(option), text_(text), form_(form) {}

  [[noreturn]] void refuse(const std::string& why) const {
    throw WrongInput(std::string(option_) + " " + std::string(text_) + ": " + why + "; expected " +
                     std::string(form_));
  }

  std::vector<std::string_view> parts(std::string_view text, char separator,
                                      std::size_t count) const {
    std::vector<std::string_view> found = split(text, separator);
    if (found.size() != count) {
      refuse("has " + std::to_string(found.size()) + (found.size() == 1 ? " part" : " parts"));
    }
    return found;
  }

  double number(std::string_view part) const {
    const auto value = parse_number(trimmed(part));
    if (!value) refuse("\"" + std::string(part) + "\" is not a number");
    if (!std::isfinite(*value)) refuse("\"" + std::string(part) + "\" is not finite");
    return *value + 0.0;  // a negative zero is zero
  }

  Range range(std::string_view lower, std::string_view upper) const {
    const Range result{number(lower), number(upper)};
    if (result.min > result.max) refuse("the minimum is above the maximum");
    return result;
  }

  std::int64_t count(std::string_view part) const {
    const std::string_view digits = trimmed(part);
    std::int64_t value = 0;
    const auto result = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    const bool whole = result.ec == std::errc() && result.ptr == digits.data() + digits.size();
    if (!whole || value < 1 || value > most_points) {
      refuse("\"" + std::string(part) + "\" is not a count from 1 to " +
             std::to_string(most_points));
    }
    return value;
  }

  /// The key and the value of a text KEY=VALUE; the key is not empty.
  std::pair<std::string, std::string_view> assignment(std::string_view text) const {
    const std::size_t equals = text.find('=');
    if (equals == std::string_view::npos) refuse("has no \"=\"");
    const std::string_view key = trimmed(text.substr(0, equals));
    if (key.empty()) refuse("there is no key before \"=\"");
    return {std::string(key), text.substr(equals + 1)};
  }

  std::vector<double> list(std::string_view text) const {
    std::vector<double> values;
    for (const std::string_view part : split(text, ',')) values.push_back(number(part));
    return values;
  }

  Axis axis(std::string_view text) const {
    const auto found = parts(text, ':', 3);
    const Range ends = range(found[0], found[1]);
    const std::int64_t points = count(found[2]);
    // Axis::at() multiplies the ends by whole numbers up to the count.
    const double largest = std::max(std::abs(ends.min), std::abs(ends.max));
    if (!std::isfinite(2.0 * largest * static_cast<double>(points))) refuse("range is too large");
    return {ends.min, ends.max, points};
  }

 private:
  std::string_view option_;
  std::string_view text_;
  std::string_view form_;
};

}  // namespace

Range parse_range(std::string_view option, std::string_view text) {
  const OptionText given(option, text, "MIN:MAX");
  const auto parts = given.parts(text, ':', 2);
  return given.range(parts[0], parts[1]);
}

Axis parse_axis(std::string_view option, std::string_view text) {
  const std::optional<double> single = parse_number(trimmed(text));
  if (single && std::isfinite(*single)) return {*single, *single, 1};
  return OptionText(option, text, "MIN:MAX:COUNT").axis(text);
}

KeyAxis parse_key_axis(std::string_view option, std::string_view text) {
  const OptionText given(option, text, "KEY=MIN:MAX:COUNT");
  const auto [key, values] = given.assignment(text);
  return {key, given.axis(values)};
}

KeyValues parse_key_values(std::string_view option, std::string_view text) {
  constexpr std::string_view logarithmic = "log:";
  const OptionText given(option, text,
                         "KEY=MIN:MAX:COUNT, KEY=log:MIN:MAX:COUNT or KEY=VALUE,VALUE,...");
  const auto [key, side] = given.assignment(text);
  const std::string_view values = trimmed(side);
  if (values.substr(0, logarithmic.size()) == logarithmic) {
    const Axis ends = given.axis(values.substr(logarithmic.size()));
    if (!(ends.min > 0.0)) given.refuse("MIN of a logarithmic axis must be greater than 0");
    return {key, LogAxis{ends.min, ends.max, ends.count}};
  }
  if (values.find(':') != std::string_view::npos) return {key, given.axis(values)};
  return {key, given.list(values)};
}

KickOption parse_kick(std::string_view option, std::string_view text) {
  const OptionText given(option, text, "TIME:DISPLACEMENT (s, m)");
  const auto parts = given.parts(text, ':', 2);
  const KickOption kick{given.number(parts[0]), given.number(parts[1])};
  if (kick.time < 0.0) given.refuse("the time is negative");
  return kick;
}

WindowOption parse_window(std::string_view option, std::string_view text) {
  const OptionText given(option, text, "Z1MIN:Z1MAX:V1MIN:V1MAX (m, m/s)");
  const auto parts = given.parts(text, ':', 4);
  const WindowOption window{given.range(parts[0], parts[1]), given.range(parts[2], parts[3])};
  const bool flat = window.displacement.min == window.displacement.max ||
                    window.velocity.min == window.velocity.max;
  if (flat) given.refuse("the window has no extent: each MIN and MAX must differ");
  return window;
}

std::vector<double> parse_list(std::string_view option, std::string_view text) {
  return OptionText(option, text, "numbers separated by commas").list(text);
}

void require_two_keys(const std::string& option, const std::vector<std::string>& texts,
                      const std::string& example) {
  if (texts.size() != 2)
    throw WrongInput(option + ": give two keys, not " + std::to_string(texts.size()) +
                     ", for example " + example);
  const std::string key = texts[0].substr(0, texts[0].find('='));
  if (key == texts[1].substr(0, texts[1].find('=')))
    throw WrongInput(option + ": both keys are " + key + ": change one");
}

KeyGrid key_grid(const std::string& option, const std::vector<std::string>& texts,
                 const std::string& example, std::int64_t most,
                 const std::function<KeyAxis(const std::string&)>& parse) {
  require_two_keys(option, texts, example);
  KeyGrid grid{parse(texts[0]), parse(texts[1])};
  const std::int64_t cells = grid.slow.axis.count * grid.fast.axis.count;
  if (cells > most)
    throw WrongInput(option + ": " + std::to_string(cells) + " cells are more than " +
                     std::to_string(most) + ": give smaller COUNTs in KEY=MIN:MAX:COUNT");
  return grid;
}

std::size_t GridAxis::count() const {
  if (const auto* list = std::get_if<std::vector<double>>(&values)) return list->size();
  if (const auto* ratios = std::get_if<LogAxis>(&values))
    return static_cast<std::size_t>(ratios->count);
  return static_cast<std::size_t>(std::get<Axis>(values).count);
}

double GridAxis::at(std::size_t index) const {
  if (const auto* list = std::get_if<std::vector<double>>(&values)) return (*list)[index];
  const auto number = static_cast<std::int64_t>(index);
  if (const auto* ratios = std::get_if<LogAxis>(&values)) return ratios->at(number);
  return std::get<Axis>(values).at(number);
}

std::size_t index_along(const std::vector<GridAxis>& axes, std::size_t axis, std::size_t cell) {
  for (std::size_t faster = axes.size() - 1; faster > axis; --faster) cell /= axes[faster].count();
  return cell % axes[axis].count();
}

GridAxis grid_axis(const CaseKey& key, const KeyValues& axis) {
  return {{key.name, replaced(key.unit, " ", "."), key.description}, axis.values};
}

GridAxis grid_axis(const KeyAxis& axis) {
  return grid_axis(*find_case_key(axis.key), {axis.key, axis.axis});
}

}  // namespace holdfast::program
