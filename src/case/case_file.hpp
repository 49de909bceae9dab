#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "case/case.hpp"
#include "case/case_keys.hpp"
#include "case/device/device_keys.hpp"

namespace holdfast::program {

/// Text of the built-in case, data/kollar2022.toml, used if no file is given. Its definition is
/// generated from that file when the program is built.
extern const std::string_view builtin_case_text;

/// Loads the built-in case, then the file, then each override `key=value` in order. The value is
/// TOML; a bare word counts as a string: `control.proportional_gain=tuned`. A number may be a text
/// with a unit of units.hpp: "28.2 kN".
/// A file stands alone, without built-in values, if it gives conductor.name, mass_per_length, span,
/// tension or sag, or every key of the two masses of [plant]. Keys that it does not give are then
/// absent, except that gains, play and force are 0 and that gravity, Strouhal's number and methods
/// have documented defaults. conductor.name supplies those data of that conductor that neither file
/// nor override gives. [wind] replaces amplitude and frequency of [excitation], not its other keys.
/// File names in the case file are relative to its folder, in an override (without quotes) to the
/// working folder; in the case all are relative to the working folder. They are not read here.
/// Throws WrongInput, one line with file and line or the override, the key, the value and what is
/// admissible: syntax, unknown key, wrong type, out of range, check_case(), unreadable file.
Case load_case(const std::optional<std::filesystem::path>& file,
               const std::vector<std::string>& overrides);

/// Loads a case from a text; `name` is the file name in messages.
Case load_case_text(const std::string& text, const std::string& name,
                    const std::vector<std::string>& overrides);

/// The value of a key in a case, as TOML; empty for a key without value or effect.
std::string case_value_text(const CaseKey& key, const Case& the_case);

/// The value of a key of a device, as TOML.
std::string device_value_text(const DeviceKey& key, case_tables::Device device);

/// The value of a key in the built-in case, as TOML; empty for a key of [wind] that must be given.
std::string case_default(const CaseKey& key);

/// The full case as a commented case file; load_case() of it gives the same case.
std::string case_to_toml(const Case& the_case);

/// Table that defines the plant in a starting case file.
enum class CaseForm {
  conductor,  ///< [conductor], [absorber] and [reduction]; of [plant] only given keys
  plant       ///< [plant]; the other three only if the conductor was given
};

/// A case file to start from: given keys with their values, all others commented out with their
/// defaults, so that no default counts as given by the user.
std::string case_to_begin_with(const Case& the_case, CaseForm form);

/// The full case as JSON, an object for each table.
nlohmann::ordered_json case_to_json(const Case& the_case);

}  // namespace holdfast::program
