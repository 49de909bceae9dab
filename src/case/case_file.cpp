#include "case/case_file.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "case/device/device_keys.hpp"
#include "case/library/conductor_library.hpp"
#include "case/model/cable_of_case.hpp"
#include "case/plausibility/doubts.hpp"
#include "case/toml_values.hpp"
#include "case/uncertain.hpp"
#include "io/file/whole_file.hpp"
#include "process/errors.hpp"
#include "text/text.hpp"

namespace holdfast::program {
namespace {

/// Source of a value. A later layer overrides an earlier one.
enum class Layer { builtin, file, override };

/// A key that was given, with its place as a message quotes it.
struct Given {
  std::string key;
  std::string place;  // "case.toml:3: control.width = 1" or "--set control.width=1"
  Layer layer;
};

/// One value found in a file.
struct Entry {
  std::string key;
  const toml::node* node;
  std::size_t line;
};

std::size_t line_of(const toml::node& node) { return node.source().begin.line; }

bool is_case_table(std::string_view name) {
  const auto& keys = case_keys();
  return std::any_of(keys.begin(), keys.end(),
                     [&](const CaseKey& key) { return key.table() == name; });
}

constexpr std::string_view device_table = "device";
constexpr std::string_view uncertain_table = "uncertain";
constexpr std::string_view of_uncertain = "uncertain.";

bool is_uncertain(std::string_view name) { return name.rfind(of_uncertain, 0) == 0; }

std::string in_brackets(const std::string& table, bool is_list) {
  return is_list ? "[[" + table + "]]" : "[" + table + "]";
}

/// Whether a name, or its part before the dot, is "device" but for one edit at most.
bool is_like_device(std::string_view name) {
  return edit_distance(name.substr(0, name.find('.')), device_table) <= 1;
}

std::string unknown_table(const std::string& table, const std::string& place, bool is_list) {
  const bool device = is_list || is_like_device(table);
  return place + ": " + in_brackets(table, is_list) + ": unknown table: did you mean " +
         (device ? "[[device]]" : in_brackets(nearest_case_table(table), false)) + "?";
}

/// Reads the layers of a case in order and checks every value.
class CaseReader {
 public:
  /// Begins with the built-in case.
  CaseReader() { read_text(builtin_case_text, "built-in case", Layer::builtin); }

  void read_text(std::string_view text, const std::string& name, Layer layer);
  Case finish(const std::vector<std::string>& overrides);

 private:
  void read_override(const std::string& text);
  void stand_alone();
  std::vector<Entry> entries(const toml::table& root, const std::string& name) const;
  void set(const std::string& name, const toml::node& node, const std::string& place, Layer layer);
  void set_value(const CaseKey& key, const toml::node& node, const std::string& place);
  void set_device(const DeviceKeyName& name, const toml::node& node, const std::string& place);
  void set_uncertain(const std::string& key, const toml::node& node, const std::string& place);
  void begin_wind(const std::string& place, Layer layer);
  void begin_devices(const toml::node& list, const std::string& name, Layer layer);
  void begin_device(const std::string& place, Layer layer);
  const Given* last_given(const std::vector<std::string>& keys) const;
  const Given* blamed(const std::vector<std::string>& keys) const;
  void fill_from_library();
  void check_wind() const;
  void check_devices();
  void settle_frequencies();
  void settle_own();
  bool given_by_user(const std::string& key) const;
  void check_faults() const;

  Case case_, builtin_;
  std::filesystem::path folder_;  // of the file being read; empty: the working folder
  std::vector<Given> given_;
  std::string wind_place_;
  Layer wind_layer_ = Layer::builtin;
};

std::string short_place(const std::string& place) {
  return place.rfind("--set", 0) == 0 ? place : place.substr(0, place.find(": "));
}

std::string unknown_device_key(const DeviceKeyName& name) {
  const DeviceKey& nearest = nearest_device_key(name.key);
  return "unknown key: did you mean " + device_key_text(name.number, nearest.name) + " (" +
         nearest.admissible() + ")?";
}

std::string no_device(const DeviceKeyName& name, std::size_t devices) {
  const std::string next = std::to_string(devices + 1);
  return "there is no device " + std::to_string(name.number) + ": the case has " +
         (devices == 0 ? "none" : std::to_string(devices)) + "; give device." + next +
         ".kind to add device " + next;
}

void require_value(std::string_view value, const std::string& place) {
  if (value.empty()) throw WrongInput(place + ": expected key=value, but there is no value");
}

toml::table case_override(const std::string& name, std::string_view value,
                          const std::string& place) {
  const CaseKey* key = find_case_key(name);
  if (key == nullptr) throw WrongInput(place + ": " + unknown_key(name));
  require_value(value, place);
  return parse_override_value(*key, value, place);
}

/// Parses an override of a key of an existing device, or of the kind of a new one.
toml::table device_override(const std::string& text, std::string_view value,
                            const std::string& place, std::size_t devices) {
  const auto name = device_key_name(text);
  if (!name)
    throw WrongInput(place +
                     ": write the key of a device as device.NUMBER.KEY, such as device.1.damping");
  const DeviceKey* key = find_device_key(name->key);
  if (key == nullptr) throw WrongInput(place + ": " + unknown_device_key(*name));
  const bool adds = name->number == devices + 1 && name->key == "kind";
  if (name->number > devices && !adds) throw WrongInput(place + ": " + no_device(*name, devices));
  require_value(value, place);
  return parse_override_value(*key, value, place);
}

/// Whether a table gives a key a value other than "" or "sag", which mean none.
bool gives(const toml::table& table, const char* key) {
  const toml::node* node = table.get(key);
  const auto word = node == nullptr ? std::nullopt : node->value_exact<std::string>();
  return node != nullptr && word != "" && word != "sag";
}

/// Whether a case file describes its own cable, or the whole plant of two masses.
bool describes_its_own(const toml::table& root) {
  const toml::table* conductor = root["conductor"].as_table();
  for (const char* key : {"name", "mass_per_length", "span", "tension", "sag"})
    if (conductor != nullptr && gives(*conductor, key)) return true;
  const toml::table* plant = root["plant"].as_table();
  const auto& keys = case_keys();
  return plant != nullptr && std::all_of(keys.begin(), keys.end(), [&](const CaseKey& key) {
           return key.table() != "plant" || key.beyond_two_masses ||
                  plant->contains(key.short_name());
         });
}

/// Discards all built-in values except constants of nature and numerical methods.
void CaseReader::stand_alone() {
  case_ = Case{};
  case_.stands_alone = true;
  given_.clear();
}

void CaseReader::read_text(std::string_view text, const std::string& name, Layer layer) {
  const toml::table root = parse_case_text(text, name);
  if (layer == Layer::file && describes_its_own(root)) stand_alone();
  folder_ = std::filesystem::path(name).parent_path();
  if (const toml::node* wind = root.get("wind"); wind != nullptr && wind->is_table()) {
    begin_wind(name + ":" + std::to_string(line_of(*wind)) + ": [wind]", layer);
  }
  if (const toml::node* devices = root.get(device_table)) begin_devices(*devices, name, layer);
  for (const Entry& entry : entries(root, name)) {
    const std::string place = name + ":" + std::to_string(entry.line) + ": " + entry.key + " = " +
                              value_text(*entry.node);
    set(entry.key, *entry.node, place, layer);
  }
  if (layer == Layer::builtin) builtin_ = case_;
}

/// The file's values in the order of its lines, so that the first mistake is the one reported.
std::vector<Entry> CaseReader::entries(const toml::table& root, const std::string& name) const {
  std::vector<Entry> found;
  const auto append = [&](const std::string& table, const toml::table& keys) {
    for (const auto& [key, value] : keys)
      found.push_back({(table + ".").append(key.str()), &value, line_of(value)});
  };
  for (const auto& [table_key, node] : root) {
    const std::string table(table_key.str());
    if (table == device_table) {
      std::size_t number = 0;
      for (const toml::node& device : *node.as_array())
        append("device." + std::to_string(++number), *device.as_table());
      continue;
    }
    if (table == uncertain_table && node.is_table()) {
      append(table, *node.as_table());
      continue;
    }
    const bool is_list = node.is_array_of_tables() && !is_case_table(table);
    const toml::table* keys = node.as_table();
    if (keys == nullptr && !is_list) {
      found.push_back({table, &node, line_of(node)});
      continue;
    }
    if (!is_case_table(table))
      throw WrongInput(unknown_table(table, name + ":" + std::to_string(line_of(node)), is_list));
    append(table, *keys);
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Entry& a, const Entry& b) { return a.line < b.line; });
  return found;
}

void CaseReader::read_override(const std::string& text) {
  const std::string place = "--set " + text;
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) throw WrongInput(place + ": expected key=value");
  const std::string name(trimmed(std::string_view(text).substr(0, equals)));
  const std::string_view value = trimmed(std::string_view(text).substr(equals + 1));
  if (is_case_table(name))
    throw WrongInput(place + ": [" + name + "] is a table; set one of its keys, " + name + ".KEY");
  const bool is_device = is_like_device(name);
  const toml::table parsed = is_uncertain(name) ? uncertain_override(value, place)
                             : is_device ? device_override(name, value, place, case_.devices.size())
                                         : case_override(name, value, place);
  if (name.rfind("wind.", 0) == 0) begin_wind(place, Layer::override);
  if (is_device && device_key_name(name)->number > case_.devices.size())
    begin_device(place, Layer::override);
  folder_.clear();
  set(name, *parsed.get("value"), place, Layer::override);
}

void CaseReader::set(const std::string& name, const toml::node& node, const std::string& place,
                     Layer layer) {
  if (is_uncertain(name)) return set_uncertain(name.substr(of_uncertain.size()), node, place);
  const auto of_device = device_key_name(name);
  const CaseKey* key = of_device ? nullptr : find_case_key(name);
  if (of_device)
    set_device(*of_device, node, place);
  else if (key != nullptr)
    set_value(*key, node, place);
  else
    throw WrongInput(place + ": " +
                     (is_case_table(name) ? "must be a table: write [" + name + "] above its keys"
                                          : unknown_key(name)));
  given_.push_back({name, place, layer});
  if (layer == Layer::builtin) return;
  case_.places[name] = short_place(place);
  if (key == nullptr || key->beyond_two_masses) return;
  const std::string table = key->table();
  case_.plant_given |= table == "plant";
  case_.conductor_given |= table == "conductor" || table == "absorber" || table == "reduction" ||
                           table == "stringing" || table == "weather";
}

void CaseReader::set_value(const CaseKey& key, const toml::node& node, const std::string& place) {
  const auto word = node.value_exact<std::string>();
  if (key.is_number() && word && !key.words.empty() && *word == key.words.front())
    return key.give_word(case_);
  read_value(key, key.place(case_), node, place, folder_);
  if (key.tuned != nullptr) *key.tuned(case_) = false;
}

void CaseReader::set_device(const DeviceKeyName& name, const toml::node& node,
                            const std::string& place) {
  if (name.number > case_.devices.size())
    throw WrongInput(place + ": " + no_device(name, case_.devices.size()));
  const DeviceKey* key = find_device_key(name.key);
  if (key == nullptr) throw WrongInput(place + ": " + unknown_device_key(name));
  read_value(*key, key->place(case_.devices[name.number - 1]), node, place, folder_);
}

void CaseReader::set_uncertain(const std::string& key, const toml::node& node,
                               const std::string& place) {
  if (node.is_table())
    throw WrongInput(place + ": write the key in quotes: \"" + key + ".KEY\" = [lowest, highest]");
  auto& all = case_.uncertain;
  const auto same =
      std::find_if(all.begin(), all.end(), [&](const auto& one) { return one.key == key; });
  if (same == all.end())
    all.push_back(read_uncertain(key, node, place));
  else
    *same = read_uncertain(key, node, place);
}

void CaseReader::begin_wind(const std::string& place, Layer layer) {
  if (case_.wind) return;
  case_.wind.emplace();
  wind_place_ = place;
  wind_layer_ = layer;
}

/// Adds the devices of the file, in its order, before any of their values is set.
void CaseReader::begin_devices(const toml::node& list, const std::string& name, Layer layer) {
  const auto place = [&](const toml::node& node) {
    return name + ":" + std::to_string(line_of(node)) + ": ";
  };
  const toml::array* devices = list.as_array();
  if (devices == nullptr)
    throw WrongInput(place(list) +
                     "device must be a list of tables: write [[device]] before each device");
  for (const toml::node& device : *devices) {
    if (!device.is_table())
      throw WrongInput(place(device) + "device = " + value_text(device) +
                       ": must be a list of tables: write [[device]] before each device");
    begin_device(place(device) + "[[device]]", layer);
  }
}

void CaseReader::begin_device(const std::string& place, Layer layer) {
  case_.devices.emplace_back();
  given_.push_back({"device." + std::to_string(case_.devices.size()), place, layer});
}

const Given* CaseReader::last_given(const std::vector<std::string>& keys) const {
  const auto found = std::find_if(given_.rbegin(), given_.rend(), [&](const Given& given) {
    return std::find(keys.begin(), keys.end(), given.key) != keys.end();
  });
  return found == given_.rend() ? nullptr : &*found;
}

/// The key that a fault's message names: the last override among `keys`, else the first key that
/// the file gives. The order of the lines in the file has no effect.
const Given* CaseReader::blamed(const std::vector<std::string>& keys) const {
  const Given* last = last_given(keys);
  if (last == nullptr || last->layer == Layer::override) return last;
  for (const std::string& key : keys) {
    const Given* given = last_given({key});
    if (given != nullptr && given->layer == last->layer) return given;
  }
  return last;
}

/// Fills in the data of the named conductor that the user does not give.
void CaseReader::fill_from_library() {
  const LibraryConductor* conductor = find_conductor(case_.conductor.name);
  if (conductor == nullptr) return;
  const Given* found = last_given({"conductor.name"});
  const Given name = *found;
  const auto behind_name = found - given_.data() + 1;
  for (const LibraryKey& key : library_keys()) {
    const std::string key_name(key.name);
    if (given_by_user(key_name)) continue;
    *find_case_key(key.name)->number(case_) = conductor->*key.value;
    given_.insert(given_.begin() + behind_name, {key_name, name.place, name.layer});
  }
  case_.conductor_given = true;
}

void CaseReader::check_wind() const {
  if (!case_.wind) return;
  for (const CaseKey& key : case_keys()) {
    const bool is_settled = key.name == "wind.diameter" && case_.wind->diameter > 0.0;
    if (!key.required || is_settled || last_given({key.name}) != nullptr) continue;
    throw WrongInput(wind_place_ + ": " + key.name + " is missing: " + key.description +
                     "; must be " + key.admissible() +
                     "; holdfast case --init FILE --wind writes a complete [wind]");
  }
  // An excitation of a layer below that of [wind] is replaced. In the same or a higher layer it is
  // refused, since it would be ignored silently.
  const Given* force = last_given({"excitation.amplitude", "excitation.frequency"});
  if (force == nullptr || force->layer < wind_layer_) return;
  throw WrongInput(force->place + ": [wind] replaces this key; remove this key or [wind] (" +
                   wind_place_ + ")");
}

void CaseReader::check_devices() {
  for (std::size_t k = 0; k < case_.devices.size(); ++k) {
    const std::string name = "device." + std::to_string(k + 1);
    std::set<std::string> given;
    for (const DeviceKey& key : device_keys())
      if (last_given({name + "." + key.name}) != nullptr) given.insert(key.name);
    settle_device(case_.devices[k], given);
    const CaseFault fault = device_fault(case_.devices[k], given);
    if (fault.message.empty()) continue;
    std::vector<std::string> keys = {name};
    if (!fault.keys.empty()) keys.clear();
    for (const std::string& key : fault.keys) keys.push_back(name + "." + key);
    const std::string of_device = fault.keys.empty() ? name + ": " : "";
    throw WrongInput(blamed(keys)->place + ": " + of_device + fault.message);
  }
}

bool CaseReader::given_by_user(const std::string& key) const {
  const Given* given = last_given({key});
  return given != nullptr && given->layer != Layer::builtin;
}

/// Whether a case has all values on which its natural frequencies depend.
bool can_have_frequencies(const Case& the_case) {
  const case_tables::Conductor& c = the_case.conductor;
  return std::isfinite(c.mass_per_length + c.span + c.sag + c.area + c.youngs_modulus +
                       the_case.absorber.position);
}

/// Completes a case without built-in values: a missing absorber.mass or plant.absorber_mass is
/// taken from the other one, and devices select the string.
void CaseReader::settle_own() {
  if (!case_.stands_alone) return;
  double &hung = case_.absorber.mass, &of_plant = case_.plant.absorber_mass;
  if (std::isnan(hung) && of_plant > 0.0) hung = of_plant;
  if (std::isnan(of_plant)) of_plant = hung;
  if (!case_.devices.empty() && !given_by_user("plant.model")) case_.plant.model = "string";
}

/// Computes the frequencies of [reduction] that are not given. The built-in frequencies remain if
/// the conductor and absorber.position have their built-in values.
void CaseReader::settle_frequencies() {
  const auto& keys = case_keys();
  const bool another = std::any_of(keys.begin(), keys.end(), [this](const CaseKey& key) {
    const bool shapes = key.name == "absorber.position" ||
                        (key.table() == "conductor" && key.name != "conductor.damping_ratio" &&
                         !key.beyond_two_masses);
    return shapes && *key.number(case_) != *key.number(builtin_);
  });
  const bool has_data = !case_.stands_alone || can_have_frequencies(case_);
  if (!(another || case_.stands_alone) || !has_data || !conductor_fault(case_).message.empty())
    return;
  const auto [first, second] = default_frequencies(case_);
  case_.first_frequency_computed = !given_by_user("reduction.first_frequency");
  case_.second_frequency_computed = !given_by_user("reduction.second_frequency");
  if (case_.first_frequency_computed) case_.reduction.first_frequency = first;
  if (case_.second_frequency_computed) case_.reduction.second_frequency = second;
}

void CaseReader::check_faults() const {
  const CaseFault fault = first_fault(case_);
  if (fault.message.empty()) return;
  const Given* last = last_given(fault.keys);
  std::vector<std::string> suspects = fault.keys;  // a last override is the only suspect
  if (last != nullptr && last->layer == Layer::override) suspects = {last->key};
  const UnitGuess guess = guessed_unit(case_, suspects, quantities_of_case());
  const Given* given = blamed(guess.keys.empty() ? fault.keys : guess.keys);
  throw WrongInput((given == nullptr ? "" : given->place + ": ") + fault.message + guess.text);
}

Case CaseReader::finish(const std::vector<std::string>& overrides) {
  for (const std::string& text : overrides) read_override(text);
  fill_from_library();
  settle_wind(case_);
  check_wind();
  check_devices();
  settle_tension(case_);
  if (!given_by_user("conductor.sag")) settle_sag(case_);
  settle_own();
  settle_frequencies();
  check_faults();
  return case_;
}

}  // namespace

Case load_case(const std::optional<std::filesystem::path>& file,
               const std::vector<std::string>& overrides) {
  if (file) return load_case_text(read_input(*file), file->string(), overrides);
  return CaseReader().finish(overrides);
}

Case load_case_text(const std::string& text, const std::string& name,
                    const std::vector<std::string>& overrides) {
  CaseReader reader;
  reader.read_text(text, name, Layer::file);
  return reader.finish(overrides);
}

}  // namespace holdfast::program
