#include "case/toml_values.hpp"

#include <algorithm>
#include <cctype>
#include <locale>
#include <sstream>

#include "case/toml_depth.hpp"
#include "io/text/text.hpp"
#include "process/errors.hpp"

namespace holdfast::program {
namespace {

std::string toml_text(const toml::node& node) {
  if (const auto number = node.value_exact<double>()) return format_number(*number);
  if (const toml::array* list = node.as_array()) {
    std::string text;
    for (const toml::node& one : *list) text += (text.empty() ? "" : ", ") + toml_text(one);
    return "[" + text + "]";
  }
  std::ostringstream stream;
  stream.imbue(std::locale::classic());
  node.visit([&](const auto& value) { stream << value; });
  return one_line(stream.str());
}

bool is_bare_word(std::string_view text) {
  const auto fits = [](char character) {
    const auto code = static_cast<unsigned char>(character);
    return std::isalnum(code) != 0 || character == '_' || character == '-';
  };
  return !text.empty() && std::isalpha(static_cast<unsigned char>(text.front())) != 0 &&
         std::all_of(text.begin(), text.end(), fits);
}

bool has_decimal_comma(std::string_view text) {
  const auto is_digit = [](char character) { return character >= '0' && character <= '9'; };
  for (std::size_t k = 1; k + 1 < text.size(); ++k)
    if (text[k] == ',' && is_digit(text[k - 1]) && is_digit(text[k + 1])) return true;
  return false;
}

/// A line's value, without what follows a #.
std::string_view value_of_line(std::string_view text, std::size_t line) {
  const auto lines = split(text, '\n');
  const std::string_view all = line >= 1 && line <= lines.size() ? lines[line - 1] : "";
  const std::string_view uncommented = all.substr(0, all.find('#'));
  const std::size_t equals = uncommented.find('=');
  return equals == std::string_view::npos ? "" : trimmed(uncommented.substr(equals + 1));
}

/// What is probably wrong with a value that no TOML can be read from; empty where there is no
/// guess.
std::string guess_of_value(std::string_view value) {
  if (value.empty() || value.front() == '[' || value.front() == '"') return "";
  if (has_decimal_comma(value)) return "; a number has a decimal point, not a comma: 0.5";
  const std::size_t blank = value.find_first_of(" \t");
  const bool number_first = parse_number(value.substr(0, blank)).has_value();
  if (number_first && blank != std::string_view::npos)
    return "; a number stands alone, in the unit that `holdfast case --check` gives for its key";
  return "";
}

}  // namespace

toml::table parse_case_text(std::string_view text, const std::string& name) {
  if (const auto excess = toml_excess(text))
    throw WrongInput(name + ":" + std::to_string(excess->line) + ": " + excess->message);
  try {
    return toml::parse(text, name);
  } catch (const toml::parse_error& error) {
    const std::size_t line = error.source().begin.line;
    throw WrongInput(name + ":" + std::to_string(line) + ": " + std::string(error.description()) +
                     guess_of_value(value_of_line(text, line)));
  }
}

toml::table parse_override_value(const CaseKey& key, std::string_view value,
                                 const std::string& place) {
  if (const auto excess = toml_excess(value)) throw WrongInput(place + ": " + excess->message);
  try {
    toml::table parsed = toml::parse("value = " + std::string(value));
    if (parsed.size() == 1) return parsed;
  } catch (const toml::parse_error&) {
    const bool is_text = key.file != nullptr || key.conductor != nullptr || is_bare_word(value);
    if (is_text) return toml::table{{"value", std::string(value)}};
  }
  const std::string guess = guess_of_value(value);
  const std::string form = key.number != nullptr ? ", a plain number such as 0.01" : "";
  throw WrongInput(place + ": admissible is " + key.admissible() + (guess.empty() ? form : guess));
}

std::string value_text(const toml::node& node) {
  constexpr std::size_t longest = 60;
  return shortened(toml_text(node), longest);
}

}  // namespace holdfast::program
