#include <algorithm>

#include "builtin_case.hpp"
#include "case_file.hpp"
#include "text.hpp"

namespace holdfast::program {
namespace {

/// A TOML float: digits alone would be an integer, of which TOML has only 64 bits.
std::string toml_number(double value) {
  std::string text = format_number(value);
  const bool whole = text.find_first_of(".e") == std::string::npos;
  return whole ? text + ".0" : text;
}

bool is_tuned(const CaseKey& key, Case& the_case) {
  return key.tuned != nullptr && *key.tuned(the_case);
}

std::string toml_value(const CaseKey& key, Case& the_case) {
  if (key.word != nullptr) return "\"" + *key.word(the_case) + "\"";
  if (is_tuned(key, the_case)) return "\"" + key.words.front() + "\"";
  return toml_number(*key.number(the_case));
}

/// What stands for a case's key: nothing for [wind] without wind, and for what wind replaces.
bool is_in_force(const CaseKey& key, const Case& the_case) {
  if (key.table() == "wind") return the_case.wind.has_value();
  const bool replaced = key.table() == "excitation" && key.number != nullptr;
  return !(replaced && the_case.wind);
}

std::string toml_line(const CaseKey& key, Case& the_case) {
  std::string line = key.short_name() + " = " + toml_value(key, the_case);
  constexpr std::size_t comment_column = 32;
  line.resize(std::max(line.size() + 1, comment_column), ' ');
  line += "# ";
  if (!key.unit.empty()) line += key.unit + ", ";
  line += key.description;
  if (key.word != nullptr) line += ": " + key.admissible();
  return line + "\n";
}

}  // namespace

std::string case_default(const CaseKey& key) {
  if (key.required) return "";
  Case builtin = load_case(std::nullopt, {});
  if (!builtin.wind) builtin.wind.emplace();
  return toml_value(key, builtin);
}

std::string case_to_toml(const Case& the_case) {
  Case copy = the_case;
  std::string text = "# A case of holdfast, SI units.\n";
  std::string table;
  for (const CaseKey& key : case_keys()) {
    if (!is_in_force(key, the_case)) continue;
    if (key.table() != table) {
      table = key.table();
      text += "\n[" + table + "]\n";
    }
    text += toml_line(key, copy);
  }
  return text;
}

nlohmann::ordered_json case_to_json(const Case& the_case) {
  Case copy = the_case;
  nlohmann::ordered_json json;
  for (const CaseKey& key : case_keys()) {
    if (!is_in_force(key, the_case)) continue;
    nlohmann::ordered_json& place = json[key.table()][key.short_name()];
    if (key.word != nullptr) {
      place = *key.word(copy);
    } else if (is_tuned(key, copy)) {
      place = key.words.front();
    } else {
      place = *key.number(copy);
    }
  }
  return json;
}

}  // namespace holdfast::program
