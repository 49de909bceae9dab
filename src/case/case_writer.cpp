#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "case/case_file.hpp"
#include "case/needed.hpp"
#include "case/toml_values.hpp"
#include "case/uncertain.hpp"

namespace holdfast::program {
namespace {

/// The value of a key as TOML, or its word in place of a number.
std::string text_of_key(const CaseKey& key, Case& the_case) {
  return key.bears_word(the_case) ? toml_string(key.words.front())
                                  : toml_value(key, key.place(the_case));
}

nlohmann::ordered_json json_of_key(const CaseKey& key, Case& the_case) {
  if (key.bears_word(the_case)) return key.words.front();
  return json_value(key, key.place(the_case));
}

/// Whether a key has a value and an effect in the case. A key of [wind] without wind, a key that
/// [wind] or [stringing] replaces, and [site] without any given key have none.
bool is_in_force(const CaseKey& key, const Case& the_case) {
  if (key.table() == "site") return has_site(the_case);
  if (key.table() == "stringing" || key.table() == "weather") {
    if (!has_stringing(the_case)) return false;
  } else if (has_stringing(the_case) &&
             (key.name == "conductor.tension" || key.name == "conductor.sag")) {
    return false;  // computed from [stringing]
  }
  if (is_absent(the_case, key)) return false;
  // A user-defined plant replaces the keys of these tables.
  if (has_own_plant(the_case))
    for (const char* table : {"conductor", "absorber", "reduction", "plant", "initial"})
      if (key.table() == table) return false;
  if (key.table() == "wind") return the_case.wind.has_value();
  return !(key.replaced_by_wind && the_case.wind);
}

/// Comment below the header of a table in a written case file; empty for most tables.
std::string table_comment(const std::string& table) {
  if (table == "conductor")
    return "# Give name, from the library (holdfast conductors), or the conductor's data. Give sag "
           "or tension;\n# the other one is computed. The plant is computed from this table, "
           "[absorber] and [reduction]\n# where [plant] does not give it.\n";
  if (table == "plant")
    return "# Values given here are used unchanged. Without them the plant is reduced from "
           "[conductor],\n# [absorber] and [reduction].\n";
  if (table == "reduction")
    return "# Give the natural frequencies that you measured; those left out are computed for "
           "the\n# conductor. The higher one should be near the frequency of the excitation.\n";
  if (table == "excitation")
    return "# In place of amplitude and frequency: a table [wind] with speed, diameter (of the\n"
           "# conductor) and effective_length.\n";
  return "";
}

constexpr const char* begun_head =
    "#\n# Remove the # before a key to give the key; the value shown is used as long as the # is "
    "there.\n# A file that gives conductor.name, mass_per_length, span, tension or sag, or every "
    "number of\n# [plant], describes a cable or plant of its own: then no value of the built-in "
    "case is used for keys\n# that are not given. Numbers are in the unit shown; or give another "
    "unit in quotes: \"28.2 kN\".\n";

/// Form of a key in a starting case file: a value if given, else a comment.
enum class Standing { left_out, comment, value };

Standing standing_of(const CaseKey& key, const Case& the_case, CaseForm form) {
  if (!is_in_force(key, the_case)) return Standing::left_out;
  const std::string table = key.table();
  const bool of_cable = table == "conductor" || table == "absorber" || table == "reduction";
  const bool is_given = the_case.is_given(key.name);
  if (of_cable && form == CaseForm::plant && !the_case.conductor_given) return Standing::left_out;
  if (table == "plant" && form == CaseForm::conductor && !is_given && !key.beyond_two_masses)
    return Standing::left_out;
  const bool of_new_wind = table == "wind" && key.required;
  return is_given || of_new_wind ? Standing::value : Standing::comment;
}

/// A commented table [[device]] for each device; empty without devices.
std::string devices_to_toml(const std::vector<case_tables::Device>& devices) {
  std::string text;
  for (const case_tables::Device& device : devices) {
    text += "\n[[device]]\n";
    for (const DeviceKey* key : standing_keys(device))
      text += toml_line(*key, key->name, device_value_text(*key, device));
  }
  return text;
}

/// A JSON array with an object for each device.
nlohmann::ordered_json devices_to_json(const std::vector<case_tables::Device>& devices) {
  auto list = nlohmann::ordered_json::array();
  for (case_tables::Device device : devices) {
    nlohmann::ordered_json json;
    for (const DeviceKey* key : standing_keys(device))
      json[key->name] = json_value(*key, key->place(device));
    list.push_back(json);
  }
  return list;
}

/// The case as a file; `standing` decides the form of each key.
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
    text += (stands == Standing::comment ? "# " : "") +
            toml_line(key, key.short_name(), text_of_key(key, the_case));
  }
  text += devices_to_toml(the_case.devices);
  if (!the_case.uncertain.empty()) text += "\n[uncertain]\n";
  for (const case_tables::Uncertain& one : the_case.uncertain) text += uncertain_to_toml(one);
  return text;
}

}  // namespace

std::string case_value_text(const CaseKey& key, const Case& the_case) {
  Case copy = the_case;
  return is_in_force(key, the_case) ? text_of_key(key, copy) : "";
}

std::string device_value_text(const DeviceKey& key, case_tables::Device device) {
  return toml_value(key, key.place(device));
}

std::string case_default(const CaseKey& key) {
  if (key.required) return "";
  Case builtin = load_case(std::nullopt, {});
  if (!builtin.wind) builtin.wind.emplace();
  return text_of_key(key, builtin);
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
    json[key.table()][key.short_name()] = json_of_key(key, copy);
  }
  if (!the_case.devices.empty()) json["device"] = devices_to_json(the_case.devices);
  return json;
}

}  // namespace holdfast::program
