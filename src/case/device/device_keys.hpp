#pragma once

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "case/case_keys.hpp"

namespace holdfast::program {

/// One key of a table [[device]], "damping".
struct DeviceKey : KeyForm {
  ValuePlace (*place)(case_tables::Device&) = nullptr;
};

/// Every key, in the order in which a device is written.
const std::vector<DeviceKey>& device_keys();

/// The key of that name, or null.
const DeviceKey* find_device_key(std::string_view name);

/// The known key closest to a name that is not known (fewest edits).
const DeviceKey& nearest_device_key(std::string_view name);

/// A key of a device as it is called outside of its table: `device.2.damping`.
struct DeviceKeyName {
  std::size_t number;  // from 1
  std::string key;
};

/// Empty where the name is no such.
std::optional<DeviceKeyName> device_key_name(std::string_view name);
std::string device_key_text(std::size_t number, std::string_view key);

/// The keys that say what a device is, in their order: those that its kind uses, but for one that
/// another stands in place of, and its mass where nothing hangs on it.
std::vector<const DeviceKey*> standing_keys(case_tables::Device device);

/// Gives a device the `to` of its kind, where nobody gives it.
void settle_device(case_tables::Device& device, const std::set<std::string>& given);

/// Fault of one device by itself, of which those keys were given; its keys are `damping`, none
/// where one is missing.
CaseFault device_fault(const case_tables::Device& device, const std::set<std::string>& given);

/// Fault between the devices of a case and its conductor.
CaseFault devices_fault(const Case& the_case);

}  // namespace holdfast::program
