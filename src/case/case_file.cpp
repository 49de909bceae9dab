#include "case/case_file.hpp"

#include <toml++/toml.h>
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <locale>
#include <optional>
#include <sstream>

#include "case/builtin_case.hpp"
#include "case/model/cable_of_case.hpp"
#include "io/file/input.hpp"
#include "io/text/text.hpp"
#include "process/errors.hpp"

namespace holdfast::program {
namespace {

/// Who gave a value; a later layer goes over an earlier one.
enum class Layer { builtin, file, override };

/// A value as it was given, and where, in the words of a message.
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

/// As a file would have it; numbers with their shortest digits.
std::string toml_text(const toml::node& node) {
  if (const auto number = node.value_exact<double>()) return format_number(*number);
  if (const toml::array* list = node.as_array()) {
    std::string text;
    for (const toml::node& one : *list) text += (text.empty() ? "" : ", ") + toml_text(one);
    return "[" + text + "]";
  }
  std::ostringstream stream;
  stream.imbue(std::locale::classic());
  node.visit([&](const auto& value) { stream << value; });
  return one_line(stream.str());
}

std::string value_text(const toml::node& node) {
  constexpr std::size_t longest = 60;
  return shortened(toml_text(node), longest);
}

bool is_bare_word(std::string_view text) {
  const auto fits = [](char character) {
    const auto code = static_cast<unsigned char>(character);
    return std::isalnum(code) != 0 || character == '_' || character == '-';
  };
  return !text.empty() && std::isalpha(static_cast<unsigned char>(text.front())) != 0 &&
         std::all_of(text.begin(), text.end(), fits);
}

bool is_case_table(std::string_view name) {
  const auto& keys = case_keys();
  return std::any_of(keys.begin(), keys.end(),
                     [&](const CaseKey& key) { return key.table() == name; });
}

std::string unknown_key(std::string_view name) {
  if (name.size() >= 7 && name.substr(name.size() - 7) == "tension")
    return "unknown key: a tension H is given by the sag that it leaves, "
           "conductor.sag = mass_per_length gravity span^2 / (8 H)";
  const CaseKey& nearest = nearest_case_key(name);
  return "unknown key: did you mean " + nearest.name + " (" + nearest.admissible() + ")?";
}

WrongInput unknown_table(const std::string& file, std::size_t line, const std::string& table) {
  return WrongInput(file + ":" + std::to_string(line) + ": [" + table +
                    "]: unknown table: did you mean [" + nearest_case_table(table) + "]?");
}

/// Puts layers of values one over another and sees to it that each is fit.
class CaseReader {
 public:
  void read_text(std::string_view text, const std::string& name, Layer layer);
  void read_override(const std::string& text);
  Case finish();

 private:
  std::vector<Entry> entries(const toml::table& root, const std::string& name) const;
  void set(const std::string& name, const toml::node& node, const std::string& place, Layer layer);
  void set_number(const CaseKey& key, const toml::node& node, const std::string& place);
  void set_word(const CaseKey& key, const toml::node& node, const std::string& place);
  void set_file(const CaseKey& key, const toml::node& node, const std::string& place);
  void begin_wind(const std::string& place, Layer layer);
  void note_user(const CaseKey& key);
  const Given* last_given(const std::vector<std::string>& keys) const;
  void check_wind() const;
  void settle_frequencies();
  void check_faults() const;

  Case case_, builtin_;
  std::filesystem::path folder_;  // of what is being read; empty: the working folder
  std::vector<Given> given_;
  std::string wind_place_;
  Layer wind_layer_ = Layer::builtin;
};

bool is_word_of(const CaseKey& key, const std::string& word) {
  return std::find(key.words.begin(), key.words.end(), word) != key.words.end();
}

/// What to say behind a refusal: the nearest word, where a word was given and some are admissible.
std::string suggested_word(const CaseKey& key, const toml::node& node) {
  const auto word = node.value_exact<std::string>();
  if (!word || key.words.empty()) return "";
  return "; did you mean \"" + nearest_name(key.words, *word) + "\"?";
}

/// [amplitude, frequency, phase], of which the last may be left out; nothing where it is not that.
std::optional<std::array<double, 3>> harmonic_of(const toml::node& node) {
  const toml::array* numbers = node.as_array();
  const auto& parts = harmonic_parts();
  if (numbers == nullptr || (numbers->size() != 2 && numbers->size() != parts.size())) return {};
  std::array<double, 3> harmonic{};
  for (std::size_t k = 0; k < numbers->size(); ++k) {
    const toml::node& number = (*numbers)[k];
    if (!number.is_number()) return {};
    harmonic[k] = number.value<double>().value_or(std::nan(""));
    if (!parts[k].range.contains(harmonic[k])) return {};
  }
  return harmonic;
}

std::vector<std::array<double, 3>> harmonics_of(const CaseKey& key, const toml::node& node,
                                                const std::string& place) {
  const toml::array* list = node.as_array();
  if (list == nullptr) throw WrongInput(place + ": must be " + key.admissible());
  std::vector<std::array<double, 3>> harmonics;
  for (const toml::node& one : *list) {
    const auto harmonic = harmonic_of(one);
    if (!harmonic) {
      throw WrongInput(place + ": the harmonic " + value_text(one) + " must be as in " +
                       key.admissible());
    }
    harmonics.push_back(*harmonic);
  }
  return harmonics;
}

bool is_digit(char character) { return std::isdigit(static_cast<unsigned char>(character)) != 0; }

bool has_decimal_comma(std::string_view text) {
  for (std::size_t k = 1; k + 1 < text.size(); ++k)
    if (text[k] == ',' && is_digit(text[k - 1]) && is_digit(text[k + 1])) return true;
  return false;
}

/// A line's value, without what follows a #.
std::string_view value_of_line(std::string_view text, std::size_t line) {
  const auto lines = split(text, '\n');
  const std::string_view all = line >= 1 && line <= lines.size() ? lines[line - 1] : "";
  const std::string_view uncommented = all.substr(0, all.find('#'));
  const std::size_t equals = uncommented.find('=');
  return equals == std::string_view::npos ? "" : trimmed(uncommented.substr(equals + 1));
}

/// What is probably wrong with a value that no TOML can be read from; empty where there is no
/// guess.
std::string guess_of_value(std::string_view value) {
  if (value.empty() || value.front() == '[' || value.front() == '"') return "";
  if (has_decimal_comma(value)) return "; a number has a decimal point, not a comma: 0.5";
  const std::size_t blank = value.find_first_of(" \t");
  const bool number_first = parse_number(value.substr(0, blank)).has_value();
  if (number_first && blank != std::string_view::npos)
    return "; a number stands alone, in the unit that `holdfast case --check` gives for its key";
  return "";
}

toml::table parse_file(std::string_view text, const std::string& name) {
  try {
    return toml::parse(text, name);
  } catch (const toml::parse_error& error) {
    const std::size_t line = error.source().begin.line;
    throw WrongInput(name + ":" + std::to_string(line) + ": " + std::string(error.description()) +
                     guess_of_value(value_of_line(text, line)));
  }
}

void CaseReader::read_text(std::string_view text, const std::string& name, Layer layer) {
  const toml::table root = parse_file(text, name);
  folder_ = std::filesystem::path(name).parent_path();
  if (const toml::node* wind = root.get("wind"); wind != nullptr && wind->is_table()) {
    begin_wind(name + ":" + std::to_string(line_of(*wind)) + ": [wind]", layer);
  }
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
  for (const auto& [table_key, node] : root) {
    const std::string table(table_key.str());
    const toml::table* keys = node.as_table();
    if (keys == nullptr) {
      found.push_back({table, &node, line_of(node)});
      continue;
    }
    if (!is_case_table(table)) {
      throw unknown_table(name, line_of(node), table);
    }
    for (const auto& [key, value] : *keys) {
      std::string full_name = table + ".";
      full_name += key.str();
      found.push_back({full_name, &value, line_of(value)});
    }
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Entry& a, const Entry& b) { return a.line < b.line; });
  return found;
}

/// The value of an override: TOML, or a word or the name of a file without quotes.
toml::table parse_override_value(const CaseKey& key, std::string_view value,
                                 const std::string& place) {
  try {
    toml::table parsed = toml::parse("value = " + std::string(value));
    if (parsed.size() == 1) return parsed;
  } catch (const toml::parse_error&) {
    const bool is_text = key.file != nullptr || is_bare_word(value);
    if (is_text) return toml::table{{"value", std::string(value)}};
  }
  const std::string guess = guess_of_value(value);
  const std::string form = key.number != nullptr ? ", a plain number such as 0.01" : "";
  throw WrongInput(place + ": admissible is " + key.admissible() + (guess.empty() ? form : guess));
}

void CaseReader::read_override(const std::string& text) {
  const std::string place = "--set " + text;
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) throw WrongInput(place + ": expected key=value");
  const std::string name(trimmed(std::string_view(text).substr(0, equals)));
  const std::string_view value = trimmed(std::string_view(text).substr(equals + 1));
  if (is_case_table(name))
    throw WrongInput(place + ": [" + name + "] is a table; set one of its keys, " + name + ".KEY");
  const CaseKey* key = find_case_key(name);
  if (key == nullptr) throw WrongInput(place + ": " + unknown_key(name));
  if (value.empty()) throw WrongInput(place + ": expected key=value");
  const toml::table parsed = parse_override_value(*key, value, place);
  if (name.rfind("wind.", 0) == 0) begin_wind(place, Layer::override);
  folder_.clear();
  set(name, *parsed.get("value"), place, Layer::override);
}

void CaseReader::set(const std::string& name, const toml::node& node, const std::string& place,
                     Layer layer) {
  const CaseKey* key = find_case_key(name);
  if (key == nullptr && is_case_table(name)) {
    throw WrongInput(place + ": must be a table, [" + name + "]");
  }
  if (key == nullptr) throw WrongInput(place + ": " + unknown_key(name));
  if (key->word != nullptr) {
    set_word(*key, node, place);
  } else if (key->file != nullptr) {
    set_file(*key, node, place);
  } else if (key->harmonics != nullptr) {
    *key->harmonics(case_) = harmonics_of(*key, node, place);
  } else {
    set_number(*key, node, place);
  }
  given_.push_back({name, place, layer});
  if (layer == Layer::builtin) return;
  case_.places[name] = place.rfind("--set", 0) == 0 ? place : place.substr(0, place.find(": "));
  note_user(*key);
}

void CaseReader::set_number(const CaseKey& key, const toml::node& node, const std::string& place) {
  const auto word = node.value_exact<std::string>();
  if (word && is_word_of(key, *word)) {
    key.give_word(case_);
    return;
  }
  if (!node.is_number())
    throw WrongInput(place + ": must be a number; admissible is " + key.admissible() +
                     suggested_word(key, node));
  const double value = node.value<double>().value_or(std::nan(""));
  if (!std::isfinite(value)) {
    throw WrongInput(place + ": must be finite; admissible is " + key.admissible());
  }
  if (!key.range.contains(value)) throw WrongInput(place + ": admissible is " + key.admissible());
  *key.number(case_) = value + 0.0;  // a negative zero is zero
  if (key.tuned != nullptr) *key.tuned(case_) = false;
}

void CaseReader::set_word(const CaseKey& key, const toml::node& node, const std::string& place) {
  const auto word = node.value_exact<std::string>();
  if (!word || !is_word_of(key, *word))
    throw WrongInput(place + ": must be " + key.admissible() + suggested_word(key, node));
  *key.word(case_) = *word;
}

void CaseReader::set_file(const CaseKey& key, const toml::node& node, const std::string& place) {
  const auto name = node.value_exact<std::string>();
  // The system's names of files end at a zero, and a case file is UTF-8.
  const bool is_name = name && name->find('\0') == std::string::npos && is_utf8(*name);
  if (!is_name) throw WrongInput(place + ": must be " + key.admissible());
  *key.file(case_) = name->empty() ? "" : (folder_ / *name).string();
}

void CaseReader::begin_wind(const std::string& place, Layer layer) {
  if (case_.wind) return;
  case_.wind.emplace();
  wind_place_ = place;
  wind_layer_ = layer;
}

void CaseReader::note_user(const CaseKey& key) {
  const std::string table = key.table();
  if (table == "plant") case_.plant_given = true;
  const bool conductor = table == "conductor" || table == "absorber" || table == "reduction";
  if (conductor) case_.conductor_given = true;
}

const Given* CaseReader::last_given(const std::vector<std::string>& keys) const {
  const auto involved = [&](const Given& given) {
    return std::find(keys.begin(), keys.end(), given.key) != keys.end();
  };
  const auto found = std::find_if(given_.rbegin(), given_.rend(), involved);
  return found == given_.rend() ? nullptr : &*found;
}

void CaseReader::check_wind() const {
  if (!case_.wind) return;
  for (const CaseKey& key : case_keys()) {
    if (!key.required || last_given({key.name}) != nullptr) continue;
    throw WrongInput(wind_place_ + ": " + key.name + " is missing; admissible is " +
                     key.admissible());
  }
  // An excitation below the layer that brought the wind is replaced; one beside it or above it
  // would be passed over without a word.
  const Given* force = last_given({"excitation.amplitude", "excitation.frequency"});
  if (force == nullptr || force->layer < wind_layer_) return;
  throw WrongInput(force->place + ": [wind] stands in place of [excitation]; give one of them (" +
                   wind_place_ + ")");
}

/// The built-in frequencies of [reduction] belong to the built-in conductor and the absorber's
/// place on it; another one's are computed where they are not given.
void CaseReader::settle_frequencies() {
  const auto& keys = case_keys();
  const bool another = std::any_of(keys.begin(), keys.end(), [this](const CaseKey& key) {
    const bool shapes = key.name == "absorber.position" ||
                        (key.table() == "conductor" && key.name != "conductor.damping_ratio");
    return shapes && *key.number(case_) != *key.number(builtin_);
  });
  if (!another || !conductor_fault(case_).message.empty()) return;
  const auto given_by_user = [this](const std::string& key) {
    const Given* given = last_given({key});
    return given != nullptr && given->layer != Layer::builtin;
  };
  const auto [first, second] = default_frequencies(case_);
  case_.first_frequency_computed = !given_by_user("reduction.first_frequency");
  case_.second_frequency_computed = !given_by_user("reduction.second_frequency");
  if (case_.first_frequency_computed) case_.reduction.first_frequency = first;
  if (case_.second_frequency_computed) case_.reduction.second_frequency = second;
}

void CaseReader::check_faults() const {
  const CaseFault fault = first_fault(case_);
  if (fault.message.empty()) return;
  const Given* given = last_given(fault.keys);
  throw WrongInput(given == nullptr ? fault.message : given->place + ": " + fault.message);
}

Case CaseReader::finish() {
  check_wind();
  settle_frequencies();
  check_faults();
  return case_;
}

Case finish_with(CaseReader& reader, const std::vector<std::string>& overrides) {
  for (const std::string& text : overrides) reader.read_override(text);
  return reader.finish();
}

CaseReader reader_of_builtin() {
  CaseReader reader;
  reader.read_text(builtin_case_text, "built-in case", Layer::builtin);
  return reader;
}

}  // namespace

Case load_case(const std::optional<std::filesystem::path>& file,
               const std::vector<std::string>& overrides) {
  if (file) return load_case_text(read_input(*file), file->string(), overrides);
  CaseReader reader = reader_of_builtin();
  return finish_with(reader, overrides);
}

Case load_case_text(const std::string& text, const std::string& name,
                    const std::vector<std::string>& overrides) {
  CaseReader reader = reader_of_builtin();
  reader.read_text(text, name, Layer::file);
  return finish_with(reader, overrides);
}

}  // namespace holdfast::program
