#include "case/device/device_keys.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "text/names.hpp"
#include "text/text.hpp"

namespace holdfast::program {
namespace {

using case_tables::Device;

constexpr AdmissibleRange positive{0.0, std::numeric_limits<double>::infinity(), true};
constexpr AdmissibleRange not_negative{0.0};
constexpr AdmissibleRange any_number{};
constexpr AdmissibleRange inside_one{0.0, 1.0, true, true};

template <auto Member>
ValuePlace where(Device& device) {
  return &(device.*Member);
}

DeviceKey key(ValueKind kind, const char* name, ValuePlace (*place)(Device&), const char* unit,
              const AdmissibleRange& range, const char* description,
              std::vector<std::string> words = {}) {
  return {{name, unit, description, range, std::move(words), kind, false}, place};
}

const std::vector<DeviceKey> listed_keys = {
    key(ValueKind::word, "kind", where<&Device::kind>, "", {}, "kind of the device",
        {"dashpot", "tuned_mass", "stockbridge", "measured", "inerter", "stiffness"}),
    key(ValueKind::number, "position", where<&Device::position>, "m", positive,
        "distance from the left support, inside the span"),
    key(ValueKind::word, "to", where<&Device::to>, "", {},
        "body that the device acts against: the ground, or a mass that hangs on the conductor",
        {"ground", "conductor"}),
    key(ValueKind::number, "damping", where<&Device::damping>, "N s/m", not_negative,
        "damping of the device, force over velocity"),
    key(ValueKind::number, "stiffness", where<&Device::stiffness>, "N/m", any_number,
        "stiffness of the device, force over displacement; below 0 only for kind stiffness"),
    key(ValueKind::number, "inertance", where<&Device::inertance>, "kg", not_negative,
        "inertance of the device, force over acceleration"),
    key(ValueKind::number, "mass", where<&Device::mass>, "kg", positive,
        "mass that the device hangs on the conductor; for a stockbridge the sum of its weights"),
    key(ValueKind::number, "clamp_mass", where<&Device::clamp_mass>, "kg", not_negative,
        "mass of the part of the device that moves with the conductor"),
    key(ValueKind::numbers, "frequencies", where<&Device::frequencies>, "Hz", positive,
        "resonances, ascending: two for a stockbridge, one for a tuned_mass in place of "
        "stiffness"),
    key(ValueKind::numbers, "damping_ratios", where<&Device::damping_ratios>, "", not_negative,
        "damping ratio of each resonance; for a tuned_mass in place of damping"),
    key(ValueKind::number, "mass_share", where<&Device::mass_share>, "", inside_one,
        "share of a stockbridge's mass that swings at the first of its frequencies"),
    key(ValueKind::file, "file", where<&Device::file>, "", {},
        "CSV file of impedance: columns frequency_Hz, magnitude_N_s_per_m and phase_deg"),
};

/// Keys that a kind of device takes beside kind, position, to and clamp_mass.
struct Kind {
  std::string_view name;
  std::vector<std::string_view> required, optional;
  std::size_t resonances = 0;
  bool has_own_mass = false;  // always hangs on the conductor

  bool uses(std::string_view key) const {
    for (const std::string_view one : {"kind", "position", "to", "clamp_mass"})
      if (one == key) return true;
    const bool hung = key == "mass" && name != "measured";
    return hung || std::find(required.begin(), required.end(), key) != required.end() ||
           std::find(optional.begin(), optional.end(), key) != optional.end();
  }
};

const std::vector<Kind> kinds = {
    {"dashpot", {"damping"}, {}},
    {"tuned_mass", {"mass"}, {"stiffness", "damping", "frequencies", "damping_ratios"}, 1, true},
    {"stockbridge", {"mass", "frequencies", "damping_ratios"}, {"mass_share"}, 2, true},
    {"measured", {"file"}, {}},
    {"inerter", {"inertance"}, {"damping", "stiffness"}},
    {"stiffness", {"stiffness"}, {"damping"}},
};

/// The properties of the kind of a device; null if the kind is unknown.
const Kind* kind_of(const Device& device) { return find_named(kinds, device.kind); }

/// The key whose value a list of several values replaces in a tuned mass.
std::string_view replaced_by(std::string_view list) {
  return list == "frequencies" ? "stiffness" : list == "damping_ratios" ? "damping" : "";
}

bool has(const std::set<std::string>& given, std::string_view key) {
  return given.count(std::string(key)) > 0;
}

std::string with_article(const Device& device) {
  return (device.kind == "inerter" ? "an " : "a ") + device.kind +
         (device.kind == "measured" ? " device" : "");
}

/// The names of the keys that a kind uses, for a message: `position, to, damping, ...`.
std::string used_keys_text(const Kind& kind) {
  std::string text;
  for (const DeviceKey& key : listed_keys)
    if (kind.uses(key.name) && key.name != "kind") text += (text.empty() ? "" : ", ") + key.name;
  return text;
}

CaseFault missing(std::string_view key, const std::string& of_what) {
  const DeviceKey& known = *find_device_key(key);
  return {{},
          known.name + " is missing" + of_what + ": " + known.description + "; must be " +
              known.admissible()};
}

CaseFault missing_key_fault(const Device& device, const Kind& kind,
                            const std::set<std::string>& given) {
  const std::string of_kind = ", which " + with_article(device) + " needs";
  if (!has(given, "position")) return missing("position", "");
  for (const std::string_view key : kind.required)
    if (!has(given, key)) return missing(key, of_kind);
  if (device.kind == "tuned_mass" && !has(given, "stiffness") && !has(given, "frequencies"))
    return {{}, "stiffness or frequencies is missing: a tuned_mass needs one of them"};
  if (device.to == "conductor" && kind.uses("mass") && !has(given, "mass"))
    return missing("mass", ", needed with to = \"conductor\"");
  return {};
}

CaseFault unused_key_fault(const Device& device, const Kind& kind,
                           const std::set<std::string>& given) {
  for (const std::string& key : given)
    if (!kind.uses(key))
      return {{key},
              with_article(device) + " has no such key; its keys are " + used_keys_text(kind)};
  if (device.to == "ground" && kind.has_own_mass)
    return {{"to"}, "a " + device.kind + " hangs on the conductor: set to = \"conductor\""};
  if (device.to == "ground" && has(given, "mass"))
    return {{"mass", "to"},
            "mass is used only with to = \"conductor\"; with to = \"ground\" " +
                with_article(device) + " has no mass: remove mass, or set to = \"conductor\""};
  return {};
}

CaseFault contradiction_fault(const Device& device, const std::set<std::string>& given) {
  if (device.kind != "tuned_mass") return {};
  for (const std::string list : {"frequencies", "damping_ratios"}) {
    const std::string other(replaced_by(list));
    if (has(given, list) && has(given, other))
      return {{list, other}, list + " replaces " + other + ": give only one of them"};
  }
  return {};
}

CaseFault value_fault(const Device& device, const Kind& kind) {
  if (device.stiffness < 0.0 && device.kind != "stiffness")
    return {{"stiffness"}, "stiffness of " + with_article(device) + " must be at least 0 N/m"};
  if (device.kind == "tuned_mass" && device.frequencies.empty() && !(device.stiffness > 0.0))
    return {{"stiffness"}, "stiffness of a tuned_mass must be greater than 0 N/m"};
  for (const auto* list : {&device.frequencies, &device.damping_ratios}) {
    if (list->empty() || list->size() == kind.resonances) continue;
    const std::string name = list == &device.frequencies ? "frequencies" : "damping_ratios";
    return {{name},
            "a " + device.kind + " needs " + std::to_string(kind.resonances) + " " + name +
                ", not " + std::to_string(list->size())};
  }
  const auto& frequencies = device.frequencies;
  if (frequencies.size() == 2 && !(frequencies[0] < frequencies[1]))
    return {{"frequencies"}, "frequencies must ascend: give the lower one first"};
  return {};
}

}  // namespace

const std::vector<DeviceKey>& device_keys() { return listed_keys; }

const DeviceKey* find_device_key(std::string_view name) { return find_named(listed_keys, name); }

const DeviceKey& nearest_device_key(std::string_view name) {
  std::vector<std::string> names;
  names.reserve(listed_keys.size());
  for (const DeviceKey& key : listed_keys) names.push_back(key.name);
  return *find_device_key(nearest_name(names, name));
}

std::optional<DeviceKeyName> device_key_name(std::string_view name) {
  constexpr std::string_view table = "device.";
  constexpr std::size_t most_digits = 6;
  if (name.substr(0, table.size()) != table) return {};
  name.remove_prefix(table.size());
  const std::size_t dot = name.find('.');
  const std::string_view digits = name.substr(0, dot);
  const bool is_number = dot != std::string_view::npos && !digits.empty() &&
                         digits.size() <= most_digits && digits.front() != '0' &&
                         digits.find_first_not_of("0123456789") == std::string_view::npos;
  if (!is_number) return {};
  return DeviceKeyName{std::stoul(std::string(digits)), std::string(name.substr(dot + 1))};
}

std::string device_key_text(std::size_t number, std::string_view key) {
  return "device." + std::to_string(number) + "." + std::string(key);
}

std::vector<const DeviceKey*> standing_keys(Device device) {
  const Kind* kind = kind_of(device);
  std::vector<const DeviceKey*> standing;
  for (const DeviceKey& key : listed_keys) {
    const bool bare = key.name == "mass" && device.to == "ground";
    const bool empty = key.kind == ValueKind::numbers &&
                       std::get<std::vector<double>*>(key.place(device))->empty();
    const bool replaced = (key.name == "stiffness" && !device.frequencies.empty()) ||
                          (key.name == "damping" && !device.damping_ratios.empty());
    if (kind != nullptr && kind->uses(key.name) && !bare && !empty && !replaced)
      standing.push_back(&key);
  }
  return standing;
}

void settle_device(Device& device, const std::set<std::string>& given) {
  const Kind* kind = kind_of(device);
  if (kind == nullptr || has(given, "to")) return;
  const bool hangs = kind->has_own_mass || device.kind == "measured";
  device.to = hangs ? "conductor" : "ground";
}

CaseFault device_fault(const Device& device, const std::set<std::string>& given) {
  const Kind* kind = kind_of(device);
  if (kind == nullptr) return missing("kind", "");
  CaseFault fault = unused_key_fault(device, *kind, given);
  if (fault.message.empty()) fault = missing_key_fault(device, *kind, given);
  if (fault.message.empty()) fault = contradiction_fault(device, given);
  if (fault.message.empty()) fault = value_fault(device, *kind);
  return fault;
}

CaseFault devices_fault(const Case& the_case) {
  const double span = the_case.conductor.span;
  for (std::size_t k = 0; k < the_case.devices.size(); ++k) {
    const double position = the_case.devices[k].position;
    if (!(position >= span)) continue;
    const std::string key = device_key_text(k + 1, "position");
    return {{key, "conductor.span"},
            key + " = " + format_number(position) +
                " m must be less than conductor.span = " + format_number(span) + " m"};
  }
  return {};
}

}  // namespace holdfast::program
