#pragma once

#include <toml++/toml.h>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "case/device/device_keys.hpp"

namespace holdfast::program {

/// Gives a device a value that was read; a relative name of a file is one to the folder. Throws
/// WrongInput, which begins with the place.
void set_device_value(case_tables::Device& device, const DeviceKey& key, const toml::node& node,
                      const std::string& place, const std::filesystem::path& folder);

/// The value that a key has of a device, as TOML.
std::string device_value_text(const DeviceKey& key, const case_tables::Device& device);

/// A commented table [[device]] for each; empty for none.
std::string devices_to_toml(const std::vector<case_tables::Device>& devices);

/// A JSON object for each.
nlohmann::ordered_json devices_to_json(const std::vector<case_tables::Device>& devices);

}  // namespace holdfast::program
