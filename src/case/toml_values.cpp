#include "case/toml_values.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <locale>
#include <sstream>

#include "case/toml_depth.hpp"
#include "case/units.hpp"
#include "process/errors.hpp"
#include "text/text.hpp"

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
    return "; a number stands alone, in the unit that `holdfast case --check` gives for its key, "
           "or "
           "with another one in quotes: \"28.2 kN\"";
  return "";
}

/// What to say behind a refusal: the nearest word, where a word was given and some are admissible.
std::string suggested_word(const std::vector<std::string>& words, const toml::node& node) {
  const auto word = node.value_exact<std::string>();
  if (!word || words.empty()) return "";
  return "; did you mean \"" + nearest_name(words, *word) + "\"?";
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

ValueForm form_of(const CaseKey& key) {
  if (key.number != nullptr) return ValueForm::number;
  return key.file != nullptr || key.conductor != nullptr ? ValueForm::name : ValueForm::other;
}

toml::table parse_override_value(ValueForm form, const std::string& admissible,
                                 std::string_view value, const std::string& place) {
  if (const auto excess = toml_excess(value)) throw WrongInput(place + ": " + excess->message);
  try {
    toml::table parsed = toml::parse("value = " + std::string(value));
    if (parsed.size() == 1) return parsed;
  } catch (const toml::parse_error&) {
    const bool has_unit = form == ValueForm::number && written_quantity(value).has_value();
    if (form == ValueForm::name || is_bare_word(value) || has_unit)
      return toml::table{{"value", std::string(value)}};
  }
  const std::string guess = guess_of_value(value);
  const std::string plain = form == ValueForm::number ? ", a plain number such as 0.01" : "";
  throw WrongInput(place + ": admissible is " + admissible + (guess.empty() ? plain : guess));
}

std::optional<double> number_in(const toml::node& node, const std::string& unit,
                                const std::string& place) {
  if (node.is_number()) return node.value<double>().value_or(std::nan(""));
  const auto text = node.value_exact<std::string>();
  const auto written = text ? written_quantity(*text) : std::nullopt;
  if (!written) return std::nullopt;
  if (const auto value = in_own_unit(*written, unit)) return value;
  const std::string known = units_in_words(unit);
  throw WrongInput(place + ": " + shortened(written->unit, 20) + " is no unit of it: " +
                   (known.empty() ? "it is a number without unit" : "it may be in " + known));
}

double read_number(const toml::node& node, const AdmissibleRange& range,
                   const Admissible& admissible, const std::string& place) {
  const auto number = number_in(node, admissible.unit, place);
  if (!number)
    throw WrongInput(place + ": must be a number; admissible is " + admissible.text +
                     suggested_word(admissible.words, node));
  const double value = *number;
  if (!std::isfinite(value))
    throw WrongInput(place + ": must be finite; admissible is " + admissible.text);
  if (!range.contains(value)) throw WrongInput(place + ": admissible is " + admissible.text);
  return value + 0.0;  // a negative zero is zero
}

std::vector<double> read_numbers(const toml::node& node, const AdmissibleRange& range,
                                 const Admissible& admissible, const std::string& place) {
  const toml::array* list = node.as_array();
  if (list == nullptr) throw WrongInput(place + ": must be " + admissible.text);
  std::vector<double> values;
  for (const toml::node& one : *list) {
    const auto value = number_in(one, admissible.unit, place);
    if (!value || !range.contains(*value))
      throw WrongInput(place + ": " + value_text(one) + " must be as in " + admissible.text);
    values.push_back(*value + 0.0);
  }
  return values;
}

std::string read_word(const toml::node& node, const Admissible& admissible,
                      const std::string& place) {
  const auto word = node.value_exact<std::string>();
  const auto& words = admissible.words;
  if (!word || std::find(words.begin(), words.end(), *word) == words.end())
    throw WrongInput(place + ": must be " + admissible.text + suggested_word(words, node));
  return *word;
}

std::string read_file_name(const toml::node& node, const std::string& admissible,
                           const std::string& place) {
  const auto name = node.value_exact<std::string>();
  // The system's names of files end at a zero, and a case file is UTF-8.
  const bool is_name = name && name->find('\0') == std::string::npos && is_utf8(*name);
  if (!is_name) throw WrongInput(place + ": must be " + admissible);
  return *name;
}

std::string value_text(const toml::node& node) {
  constexpr std::size_t longest = 60;
  return shortened(toml_text(node), longest);
}

std::string toml_number(double value) {
  std::string text = format_number(value);
  const bool whole = text.find_first_of(".e") == std::string::npos;
  return whole ? text + ".0" : text;
}

std::string toml_numbers(const std::vector<double>& values) {
  std::string list;
  for (const double value : values) list += (list.empty() ? "" : ", ") + toml_number(value);
  return "[" + list + "]";
}

std::string toml_string(std::string_view text) {
  constexpr std::string_view hexadecimal = "0123456789abcdef";
  std::string quoted = "\"";
  for (const char character : text) {
    const auto code = static_cast<unsigned char>(character);
    if (code < 0x20 || code == 0x7f) {
      quoted.append("\\u00").append({hexadecimal[code / 16U], hexadecimal[code % 16U]});
      continue;
    }
    if (character == '"' || character == '\\') quoted += '\\';
    quoted += character;
  }
  return quoted + "\"";
}

std::string commented(std::string assignment, const std::string& comment) {
  constexpr std::size_t comment_column = 32;
  assignment.resize(std::max(assignment.size() + 1, comment_column), ' ');
  return assignment + "# " + comment + "\n";
}

}  // namespace holdfast::program
