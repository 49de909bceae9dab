#include "case/toml_values.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <locale>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>

#include "case/library/conductor_library.hpp"
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

/// The value on a line of a file, without the comment after #.
std::string_view value_of_line(std::string_view text, std::size_t line) {
  const auto lines = split(text, '\n');
  const std::string_view all = line >= 1 && line <= lines.size() ? lines[line - 1] : "";
  const std::string_view uncommented = all.substr(0, all.find('#'));
  const std::size_t equals = uncommented.find('=');
  return equals == std::string_view::npos ? "" : trimmed(uncommented.substr(equals + 1));
}

/// Guess at the mistake in a value that is not TOML; empty without a guess.
std::string guess_of_value(std::string_view value) {
  if (value.empty() || value.front() == '[' || value.front() == '"') return "";
  if (has_decimal_comma(value)) return "; write a decimal point, not a comma, as in 0.5";
  const std::size_t blank = value.find_first_of(" \t");
  const bool number_first = parse_number(value.substr(0, blank)).has_value();
  if (number_first && blank != std::string_view::npos)
    return "; write the number alone, in the key's unit (`holdfast case --check` shows it), or "
           "with another unit in quotes: \"28.2 kN\"";
  if (std::isalpha(static_cast<unsigned char>(value.front())) == 0) return "";
  return "; put a text in quotes: \"" + std::string(value) + "\"";
}

/// Hint of an error message: the admissible word nearest to a given word; else empty.
std::string suggested_word(const std::vector<std::string>& words, const toml::node& node) {
  const auto word = node.value_exact<std::string>();
  if (!word || words.empty()) return "";
  return "; did you mean \"" + nearest_name(words, *word) + "\"?";
}

double read_number(const KeyForm& key, const toml::node& node, const std::string& place) {
  const auto number = number_in(node, key.unit, place);
  if (!number)
    throw WrongInput(place + ": must be a number: " + key.admissible() +
                     suggested_word(key.words, node));
  if (!std::isfinite(*number)) throw WrongInput(place + ": must be finite: " + key.admissible());
  if (!key.range.contains(*number)) throw WrongInput(place + ": must be " + key.admissible());
  return *number + 0.0;  // a negative zero is zero
}

std::string read_word(const KeyForm& key, const toml::node& node, const std::string& place) {
  const auto word = node.value_exact<std::string>();
  if (!word || std::find(key.words.begin(), key.words.end(), *word) == key.words.end())
    throw WrongInput(place + ": must be " + key.admissible() + suggested_word(key.words, node));
  return *word;
}

std::string read_file_name(const KeyForm& key, const toml::node& node, const std::string& place,
                           const std::filesystem::path& folder) {
  const auto name = node.value_exact<std::string>();
  // A file name of the system contains no zero byte, and a case file is UTF-8.
  const bool is_name = name && name->find('\0') == std::string::npos && is_utf8(*name);
  if (!is_name || (name->empty() && !key.may_be_none))
    throw WrongInput(place + ": must be " + key.admissible());
  return name->empty() ? "" : (folder / *name).string();
}

std::string read_conductor(const KeyForm& key, const toml::node& node, const std::string& place) {
  const auto name = node.value_exact<std::string>();
  const LibraryConductor* found = name ? find_conductor(*name) : nullptr;
  if (found != nullptr) return found->name;
  if (name && name->empty()) return "";
  throw WrongInput(place + ": must be " + key.admissible() +
                   (name ? "; did you mean " + nearest_conductors(*name) + "?" : ""));
}

std::array<double, 2> read_interval(const KeyForm& key, const toml::node& node,
                                    const std::string& place) {
  const toml::array* list = node.as_array();
  std::array<double, 2> ends{};
  bool fine = list != nullptr && list->size() == ends.size();
  for (std::size_t k = 0; fine && k < ends.size(); ++k) {
    ends[k] = number_in((*list)[k], key.unit, place).value_or(std::nan(""));
    fine = key.range.contains(ends[k]);
  }
  if (!fine || !(ends[0] < ends[1])) throw WrongInput(place + ": must be " + key.admissible());
  return ends;
}

std::vector<double> read_numbers(const KeyForm& key, const toml::node& node,
                                 const std::string& place) {
  const toml::array* list = node.as_array();
  if (list == nullptr || (list->empty() && !key.may_be_none))
    throw WrongInput(place + ": must be " + key.admissible());
  std::vector<double> values;
  for (const toml::node& one : *list) {
    const auto value = number_in(one, key.unit, place);
    if (!value || !key.range.contains(*value))
      throw WrongInput(place + ": " + value_text(one) + " is not admissible: must be " +
                       key.admissible());
    values.push_back(*value + 0.0);
  }
  return values;
}

/// A harmonic [amplitude, frequency, phase], the phase optional; none if the node is not one.
std::optional<std::array<double, 3>> harmonic_of(const toml::node& node, const std::string& place) {
  const toml::array* numbers = node.as_array();
  const auto& parts = harmonic_parts();
  if (numbers == nullptr || (numbers->size() != 2 && numbers->size() != parts.size())) return {};
  std::array<double, 3> harmonic{};
  for (std::size_t k = 0; k < numbers->size(); ++k) {
    harmonic[k] = number_in((*numbers)[k], parts[k].unit, place).value_or(std::nan(""));
    if (!parts[k].range.contains(harmonic[k])) return {};
  }
  return harmonic;
}

std::vector<std::array<double, 3>> read_harmonics(const KeyForm& key, const toml::node& node,
                                                  const std::string& place) {
  const toml::array* list = node.as_array();
  if (list == nullptr) throw WrongInput(place + ": must be " + key.admissible());
  std::vector<std::array<double, 3>> harmonics;
  for (const toml::node& one : *list) {
    const auto harmonic = harmonic_of(one, place);
    if (!harmonic) {
      throw WrongInput(place + ": the harmonic " + value_text(one) +
                       " is not admissible: must be " + key.admissible());
    }
    harmonics.push_back(*harmonic);
  }
  return harmonics;
}

std::string in_toml(const std::string& text) { return toml_string(text); }

/// TOML text of a number, with a point or exponent, since a TOML integer has only 64 bits.
std::string in_toml(double value) {
  std::string text = format_number(value);
  const bool whole = text.find_first_of(".e") == std::string::npos;
  return whole ? text + ".0" : text;
}

template <class List>
std::string in_toml(const List& list) {
  std::string text;
  for (const auto& one : list) text += (text.empty() ? "" : ", ") + in_toml(one);
  return "[" + text + "]";
}

std::int64_t whole_number(const ValuePlace& value) {
  return static_cast<std::int64_t>(*std::get<double*>(value));
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

toml::table parse_override_value(const KeyForm& key, std::string_view value,
                                 const std::string& place) {
  if (const auto excess = toml_excess(value)) throw WrongInput(place + ": " + excess->message);
  try {
    toml::table parsed = toml::parse("value = " + std::string(value));
    if (parsed.size() == 1) return parsed;
  } catch (const toml::parse_error&) {
    const bool is_name = key.kind == ValueKind::file || key.kind == ValueKind::conductor;
    const bool has_unit = key.is_number() && written_quantity(value).has_value();
    if (is_name || is_bare_word(value) || has_unit)
      return toml::table{{"value", std::string(value)}};
  }
  const std::string guess = guess_of_value(value);
  const std::string plain = key.is_number() ? ", a plain number such as 0.01" : "";
  throw WrongInput(place + ": must be " + key.admissible() + (guess.empty() ? plain : guess));
}

std::optional<double> number_in(const toml::node& node, const std::string& unit,
                                const std::string& place) {
  if (node.is_number()) return node.value<double>().value_or(std::nan(""));
  const auto text = node.value_exact<std::string>();
  const auto written = text ? written_quantity(*text) : std::nullopt;
  if (!written) return std::nullopt;
  if (const auto value = in_own_unit(*written, unit)) return value;
  const std::string known = units_in_words(unit);
  throw WrongInput(place + ": " + shortened(written->unit, 20) + " is not a unit of this key: " +
                   (known.empty() ? "write a number without unit" : "use " + known));
}

void read_value(const KeyForm& key, const ValuePlace& value, const toml::node& node,
                const std::string& place, const std::filesystem::path& folder) {
  const auto give = [&](auto read) { *std::get<decltype(read)*>(value) = std::move(read); };
  switch (key.kind) {
    case ValueKind::number:
      return give(read_number(key, node, place));
    case ValueKind::word:
      return give(read_word(key, node, place));
    case ValueKind::file:
      return give(read_file_name(key, node, place, folder));
    case ValueKind::conductor:
      return give(read_conductor(key, node, place));
    case ValueKind::interval:
      return give(read_interval(key, node, place));
    case ValueKind::numbers:
      return give(read_numbers(key, node, place));
    case ValueKind::harmonics:
      return give(read_harmonics(key, node, place));
  }
}

std::string toml_value(const KeyForm& key, const ValuePlace& value) {
  if (key.range.whole) return std::to_string(whole_number(value));
  return std::visit([](const auto* of) { return in_toml(*of); }, value);
}

nlohmann::ordered_json json_value(const KeyForm& key, const ValuePlace& value) {
  if (key.range.whole) return whole_number(value);
  return std::visit([](const auto* of) -> nlohmann::ordered_json { return *of; }, value);
}

std::string value_text(const toml::node& node) {
  constexpr std::size_t longest = 60;
  return shortened(toml_text(node), longest);
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

std::string toml_line(const KeyForm& key, const std::string& name, const std::string& value) {
  constexpr std::size_t comment_column = 32;
  std::string line = name + " = " + value;
  line.resize(std::max(line.size() + 1, comment_column), ' ');
  return line + "# " + (key.unit.empty() ? "" : key.unit + ", ") + key.description +
         (key.kind == ValueKind::word ? ": " + key.admissible() : "") + "\n";
}

}  // namespace holdfast::program
