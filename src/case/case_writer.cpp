#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <utility>

#include "case/builtin_case.hpp"
#include "case/case_file.hpp"
#include "case/device/device_values.hpp"
#include "case/needed.hpp"
#include "case/toml_values.hpp"

namespace holdfast::program {
namespace {

std::string toml_harmonics(const std::vector<std::array<double, 3>>& harmonics) {
  std::string list;
  for (const auto& [amplitude, frequency, phase] : harmonics) {
    list += (list.empty() ? "[" : ", [") + toml_number(amplitude) + ", " + toml_number(frequency) +
            ", " + toml_number(phase) + "]";
  }
  return "[" + list + "]";
}

std::string toml_interval(const std::array<double, 2>& interval) {
  return "[" + toml_number(interval[0]) + ", " + toml_number(interval[1]) + "]";
}

std::int64_t whole(double value) { return static_cast<std::int64_t>(value); }

std::string toml_value(const CaseKey& key, Case& the_case) {
  if (key.word != nullptr) return toml_string(*key.word(the_case));
  if (key.file != nullptr) return toml_string(*key.file(the_case));
  if (key.conductor != nullptr) return toml_string(*key.conductor(the_case));
  if (key.numbers != nullptr) return toml_numbers(*key.numbers(the_case));
  if (key.interval != nullptr) return toml_interval(*key.interval(the_case));
  if (key.harmonics != nullptr) return toml_harmonics(*key.harmonics(the_case));
  if (key.bears_word(the_case)) return toml_string(key.words.front());
  const double number = *key.number(the_case);
  return key.range.whole ? std::to_string(whole(number)) : toml_number(number);
}

nlohmann::ordered_json json_value(const CaseKey& key, Case& the_case) {
  if (key.word != nullptr) return *key.word(the_case);
  if (key.file != nullptr) return *key.file(the_case);
  if (key.conductor != nullptr) return *key.conductor(the_case);
  if (key.numbers != nullptr) return *key.numbers(the_case);
  if (key.interval != nullptr) return *key.interval(the_case);
  if (key.harmonics != nullptr) return *key.harmonics(the_case);
  if (key.bears_word(the_case)) return key.words.front();
  const double number = *key.number(the_case);
  if (key.range.whole) return whole(number);
  return number;
}

/// What stands for a case's key: nothing for [wind] without wind, for what wind replaces, and for
/// [site] where nothing is said of it.
bool is_in_force(const CaseKey& key, const Case& the_case) {
  if (key.table() == "site") return has_site(the_case);
  if (is_absent(the_case, key)) return false;
  // What a plant of the user's own stands in place of is no part of the case.
  if (has_own_plant(the_case))
    for (const char* table : {"conductor", "absorber", "reduction", "plant", "initial"})
      if (key.table() == table) return false;
  if (key.table() == "wind") return the_case.wind.has_value();
  return !(key.replaced_by_wind && the_case.wind);
}

/// What a person should know of a table before changing it; empty for most.
std::string table_comment(const std::string& table) {
  if (table == "conductor")
    return "# name, from the library (holdfast conductors), or the conductor's data; sag or "
           "tension, "
           "of which\n"
           "# the other one is what it leaves. This table, [absorber] and [reduction] make the "
           "plant "
           "where\n"
           "# [plant] does not give it.\n";
  if (table == "plant")
    return "# What stands here is used as it is. Without it the plant is reduced from "
           "[conductor],\n"
           "# [absorber] and [reduction].\n";
  if (table == "reduction")
    return "# Without the frequencies they are computed for the conductor; give those that you "
           "measured: the\n"
           "# higher one should be near that of the excitation.\n";
  if (table == "excitation")
    return "# In place of amplitude and frequency: a table [wind] with speed, diameter (of the\n"
           "# conductor) and effective_length.\n";
  return "";
}

constexpr const char* begun_head =
    "#\n"
    "# Take the # away before a key to give it; what stands behind it now is what holds without.\n"
    "# A file that gives conductor.name, mass_per_length, span, tension or sag, or every number "
    "of\n"
    "# [plant], describes a cable or plant of its own: then nothing of the built-in case stands in "
    "for\n"
    "# what is not given. Numbers are in the unit that is told, or have another: \"28.2 kN\".\n";

/// How a key stands in a case file to begin with: what was given as a value, the rest as a comment.
enum class Standing { left_out, comment, value };

Standing standing_of(const CaseKey& key, const Case& the_case, CaseForm form) {
  if (!is_in_force(key, the_case)) return Standing::left_out;
  const std::string table = key.table();
  const bool of_cable = table == "conductor" || table == "absorber" || table == "reduction";
  const bool is_given = the_case.places.count(key.name) > 0;
  if (of_cable && form == CaseForm::plant && !the_case.conductor_given) return Standing::left_out;
  if (table == "plant" && form == CaseForm::conductor && !is_given && !key.beyond_two_masses)
    return Standing::left_out;
  const bool of_new_wind = table == "wind" && key.required;
  return is_given || of_new_wind ? Standing::value : Standing::comment;
}

std::string toml_line(const CaseKey& key, Case& the_case) {
  std::string line = key.short_name() + " = " + toml_value(key, the_case);
  std::string comment = (key.unit.empty() ? "" : key.unit + ", ") + key.description;
  if (key.word != nullptr) comment += ": " + key.admissible();
  return commented(std::move(line), comment);
}

/// The case, its keys standing as `standing` tells.
template <class StandingOf>
std::string written_case(Case the_case, const char* head, const StandingOf& standing) {
  std::string text = std::string("# A case of holdfast, SI units.\n") + head;
  std::string table;
  for (const CaseKey& key : case_keys()) {
    const Standing stands = standing(key);
    if (stands == Standing::left_out) continue;
    if (key.table() != table) {
      table = key.table();
      text += "\n[" + table + "]\n" + table_comment(table);
    }
    text += (stands == Standing::comment ? "# " : "") + toml_line(key, the_case);
  }
  return text + devices_to_toml(the_case.devices);
}

}  // namespace

std::string case_value_text(const CaseKey& key, const Case& the_case) {
  Case copy = the_case;
  return is_in_force(key, the_case) ? toml_value(key, copy) : "";
}

std::string case_default(const CaseKey& key) {
  if (key.required) return "";
  Case builtin = load_case(std::nullopt, {});
  if (!builtin.wind) builtin.wind.emplace();
  return toml_value(key, builtin);
}

std::string case_to_toml(const Case& the_case) {
  return written_case(the_case, "", [&](const CaseKey& key) {
    return is_in_force(key, the_case) ? Standing::value : Standing::left_out;
  });
}

std::string case_to_begin_with(const Case& the_case, CaseForm form) {
  return written_case(the_case, begun_head,
                      [&](const CaseKey& key) { return standing_of(key, the_case, form); });
}

nlohmann::ordered_json case_to_json(const Case& the_case) {
  Case copy = the_case;
  nlohmann::ordered_json json;
  for (const CaseKey& key : case_keys()) {
    if (!is_in_force(key, the_case)) continue;
    json[key.table()][key.short_name()] = json_value(key, copy);
  }
  if (!the_case.devices.empty()) json["device"] = devices_to_json(the_case.devices);
  return json;
}

}  // namespace holdfast::program
