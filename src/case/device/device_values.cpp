#include "case/device/device_values.hpp"

#include <nlohmann/json.hpp>

#include "case/toml_values.hpp"
#include "process/errors.hpp"

namespace holdfast::program {
namespace {

using case_tables::Device;

nlohmann::ordered_json json_value(const DeviceKey& key, const Device& device) {
  if (key.word != nullptr) return device.*key.word;
  if (key.file != nullptr) return device.*key.file;
  if (key.numbers != nullptr) return device.*key.numbers;
  return device.*key.number;
}

}  // namespace

void set_device_value(Device& device, const DeviceKey& key, const toml::node& node,
                      const std::string& place, const std::filesystem::path& folder) {
  if (key.word != nullptr) {
    device.*key.word = read_word(node, {key.admissible(), key.words, ""}, place);
  } else if (key.file != nullptr) {
    const std::string name = read_file_name(node, key.admissible(), place);
    if (name.empty()) throw WrongInput(place + ": must be " + key.admissible());
    device.*key.file = (folder / name).string();
  } else if (key.numbers != nullptr) {
    device.*key.numbers =
        read_numbers(node, key.range, {key.admissible(), key.words, key.unit}, place);
    if ((device.*key.numbers).empty()) throw WrongInput(place + ": must be " + key.admissible());
  } else {
    device.*key.number =
        read_number(node, key.range, {key.admissible(), key.words, key.unit}, place);
  }
}

std::string device_value_text(const DeviceKey& key, const Device& device) {
  if (key.word != nullptr) return toml_string(device.*key.word);
  if (key.file != nullptr) return toml_string(device.*key.file);
  if (key.numbers != nullptr) return toml_numbers(device.*key.numbers);
  return toml_number(device.*key.number);
}

std::string devices_to_toml(const std::vector<Device>& devices) {
  std::string text;
  for (const Device& device : devices) {
    text += "\n[[device]]\n";
    for (const DeviceKey* key : standing_keys(device)) {
      std::string comment = (key->unit.empty() ? "" : key->unit + ", ") + key->description;
      if (key->word != nullptr) comment += ": " + key->admissible();
      text += commented(key->name + " = " + device_value_text(*key, device), comment);
    }
  }
  return text;
}

nlohmann::ordered_json devices_to_json(const std::vector<Device>& devices) {
  auto list = nlohmann::ordered_json::array();
  for (const Device& device : devices) {
    nlohmann::ordered_json json;
    for (const DeviceKey* key : standing_keys(device)) json[key->name] = json_value(*key, device);
    list.push_back(json);
  }
  return list;
}

}  // namespace holdfast::program
