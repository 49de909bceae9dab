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

/// Text of data/kollar2022.toml, the case that stands where no file is given. Its definition is
/// generated from that file when the program is built.
extern const std::string_view builtin_case_text;

/// The built-in case, then the file, then each override `key=value` in its order (the value is
/// TOML; a bare word counts as a string: `control.proportional_gain=tuned`).
/// A file that gives conductor.name, mass_per_length, span, tension or sag, or every key of the two
/// masses of [plant], stands alone, without the built-in case: what it does not give is absent, but
/// gains, play and force are 0, and gravity, Strouhal's number and methods as documented.
/// A number may be a text with a unit, "28.2 kN", of those in units.hpp.
/// conductor.name stands for what neither file nor override gives of that conductor.
/// [wind] takes the place of excitation.amplitude and excitation.frequency; the other keys of
/// [excitation] may stand beside it.
/// A relative excitation.record is one to the folder of the file that it stands in, in an override
/// to the working folder, where quotes about it may be left out. The case bears it as seen from the
/// working folder; nobody reads it here.
/// Throws WrongInput, one line with file and line or the override, the key, the value and what is
/// admissible: syntax, unknown key, wrong type, out of range, check_case(), unreadable file.
Case load_case(const std::optional<std::filesystem::path>& file,
               const std::vector<std::string>& overrides);

/// Loads a case from a text; `name` stands for the file in messages.
Case load_case_text(const std::string& text, const std::string& name,
                    const std::vector<std::string>& overrides);

/// The value that a key has in a case, as TOML; empty for [wind] without wind, and for what wind
/// replaces.
std::string case_value_text(const CaseKey& key, const Case& the_case);

/// The value that a key has of a device, as TOML.
std::string device_value_text(const DeviceKey& key, case_tables::Device device);

/// The value that a key has when nobody gives it, as TOML; empty when it must be given.
std::string case_default(const CaseKey& key);

/// The full case as a commented case file; load_case() of it gives the same case.
std::string case_to_toml(const Case& the_case);

/// Table that makes the plant in a case file to begin with.
enum class CaseForm {
  conductor,  ///< [conductor], [absorber] and [reduction]; of [plant] what was given beside them
  plant       ///< [plant], and what was given beside it
};

/// A commented case file to begin with: what was given, and of the rest a comment each with the
/// value that holds without, so that nothing of the built-in case becomes the user's.
std::string case_to_begin_with(const Case& the_case, CaseForm form);

/// The full case, a JSON object for each table.
nlohmann::ordered_json case_to_json(const Case& the_case);

}  // namespace holdfast::program
