#pragma once

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "case/case_keys.hpp"

namespace holdfast::program {

/// A key of a table [[device]], such as "damping".
struct DeviceKey : KeyForm {
  ValuePlace (*place)(case_tables::Device&) = nullptr;
};

/// All keys of a device, in the order of a written case file.
const std::vector<DeviceKey>& device_keys();

/// The key of a device with the given name; null if there is none.
const DeviceKey* find_device_key(std::string_view name);

/// The known key of a device most similar to an unknown name (fewest edits).
const DeviceKey& nearest_device_key(std::string_view name);

/// Number of a device and name of its key, which make the full name `device.2.damping`.
struct DeviceKeyName {
  std::size_t number;  // from 1
  std::string key;
};

/// The parts of a full name `device.2.damping`; none for any other name.
std::optional<DeviceKeyName> device_key_name(std::string_view name);
std::string device_key_text(std::size_t number, std::string_view key);

/// Keys that define a device, in the order of a written case file: all keys that its kind uses,
/// except those that another key replaces, empty lists, and the mass with to = "ground".
std::vector<const DeviceKey*> standing_keys(case_tables::Device device);

/// Sets the key `to` of a device to its kind's default unless the keys `given` contain it.
void settle_device(case_tables::Device& device, const std::set<std::string>& given);

/// Fault of one device, found without the rest of the case. `given` has the names of its given
/// keys. The keys of the fault are short names (`damping`); none if a key is missing.
CaseFault device_fault(const case_tables::Device& device, const std::set<std::string>& given);

/// Fault of a device whose position is not within the span of the conductor.
CaseFault devices_fault(const Case& the_case);

}  // namespace holdfast::program
