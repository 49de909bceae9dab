#include "case/case_keys.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <utility>

#include "case/model/own/own_parts.hpp"
#include "process/errors.hpp"
#include "text/names.hpp"
#include "text/text.hpp"

namespace holdfast::program {
namespace {

using Keys = std::vector<CaseKey>;

std::string harmonics_in_words() {
  std::string parts;
  for (const HarmonicPart& part : harmonic_parts()) {
    parts +=
        (parts.empty() ? "" : ", ") + std::string(part.name) + " " + part.range.in_words(part.unit);
  }
  return "[[amplitude, frequency, phase], ...]: " + parts + " (the phase may be left out)";
}

/// A symbol of the equations or another word for a key.
struct OtherName {
  std::string_view word;
  std::string_view key;
};

constexpr std::array<OtherName, 27> other_names = {{
    {"span_length", "conductor.span"},
    {"m1", "plant.conductor_mass"},
    {"k1", "plant.conductor_stiffness"},
    {"c1", "plant.conductor_damping"},
    {"m2", "plant.absorber_mass"},
    {"k2", "plant.absorber_stiffness"},
    {"c2", "plant.absorber_damping"},
    {"p", "control.proportional_gain"},
    {"kp", "control.proportional_gain"},
    {"d", "control.differential_gain"},
    {"kd", "control.differential_gain"},
    {"tau", "control.sampling_period"},
    {"dt", "control.sampling_period"},
    {"delta", "control.processing_delay"},
    {"delay", "control.processing_delay"},
    {"r0", "backlash.width"},
    {"play", "backlash.width"},
    {"gap", "backlash.width"},
    {"f", "excitation.frequency"},
    {"fm", "excitation.amplitude"},
    {"force", "excitation.amplitude"},
    {"l", "conductor.span"},
    {"length", "conductor.span"},
    {"e", "conductor.youngs_modulus"},
    {"zeta", "conductor.damping_ratio"},
    {"f1", "reduction.first_frequency"},
    {"f2", "reduction.second_frequency"},
}};

std::string_view after_table(std::string_view name) {
  const std::size_t dot = name.rfind('.');
  return dot == std::string_view::npos ? name : name.substr(dot + 1);
}

/// The key that a symbol or another word stands for; null if there is none.
const CaseKey* key_by_other_name(std::string_view name) {
  std::string word(after_table(name));
  std::transform(word.begin(), word.end(), word.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  const auto found = std::find_if(other_names.begin(), other_names.end(),
                                  [&](const OtherName& other) { return other.word == word; });
  return found == other_names.end() ? nullptr : find_case_key(found->key);
}

std::size_t distance_to(std::string_view name, const CaseKey& key) {
  // A key without its table, or in the wrong table, is also similar.
  const std::size_t dot = name.rfind('.');
  const std::string_view last = after_table(name);
  const std::size_t elsewhere = dot == std::string_view::npos ? 1 : 2;
  return std::min(edit_distance(name, key.name), edit_distance(last, key.short_name()) + elsewhere);
}

const CaseKey& number_key_named(std::string_view name) {
  const CaseKey* key = find_case_key(name);
  if (key == nullptr) throw WrongInput(std::string(name) + ": " + unknown_key(name));
  if (!key->is_number()) {
    throw WrongInput(key->name + ": give a key with a number; the value of this key is " +
                     (key->kind == ValueKind::word ? "a word: " : "") + key->admissible());
  }
  return *key;
}

}  // namespace

bool AdmissibleRange::contains(double value) const {
  if (!std::isfinite(value)) return false;
  const bool above = lowest_open ? value > lowest : value >= lowest;
  const bool below = highest_open ? value < highest : value <= highest;
  return above && below && !(whole && value != std::trunc(value));
}

std::string AdmissibleRange::in_words(const std::string& unit) const {
  std::string words;
  if (std::isfinite(lowest)) {
    words = (lowest_open ? "greater than " : "at least ") + format_number(lowest);
  }
  if (std::isfinite(highest)) {
    words += words.empty() ? "" : " and ";
    words += (highest_open ? "less than " : "at most ") + format_number(highest);
  }
  if (words.empty()) words = "any finite number";
  if (!unit.empty()) words += " " + unit;
  return whole ? "a whole number, " + words : words;
}

std::string KeyForm::admissible() const {
  const auto or_none = [&](std::string text, const char* none) {
    return may_be_none ? std::move(text) + ", or " + none + " for none" : text;
  };
  if (kind == ValueKind::file) return or_none("the name of a file in quotes", "\"\"");
  if (kind == ValueKind::conductor)
    return or_none("the name of a conductor (holdfast conductors lists them)", "\"\"");
  if (kind == ValueKind::harmonics) return harmonics_in_words();
  if (kind == ValueKind::numbers)
    return or_none("[number, ...], each " + range.in_words(unit), "[]");
  if (kind == ValueKind::interval) return "[lower, higher], each " + range.in_words(unit);
  std::string text = is_number() ? range.in_words(unit) : "";
  for (const std::string& one : words) text += (text.empty() ? "\"" : " or \"") + one + "\"";
  return text;
}

std::string CaseKey::table() const { return name.substr(0, name.find('.')); }

std::string CaseKey::short_name() const { return name.substr(name.find('.') + 1); }

double* CaseKey::number(Case& the_case) const {
  return is_number() ? std::get<double*>(place(the_case)) : nullptr;
}

bool CaseKey::bears_word(Case& the_case) const {
  if (!is_number() || words.empty()) return false;
  return tuned != nullptr ? *tuned(the_case) : std::isinf(*number(the_case));
}

void CaseKey::give_word(Case& the_case) const {
  if (tuned != nullptr) {
    *tuned(the_case) = true;
  } else {
    *number(the_case) = std::numeric_limits<double>::infinity();
  }
}

const std::array<HarmonicPart, 3>& harmonic_parts() {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  static const std::array<HarmonicPart, 3> parts = {{{"amplitude", "N", {0.0}},
                                                     {"frequency", "Hz", {0.0, infinity, true}},
                                                     {"phase", "rad", {}}}};
  return parts;
}

const CaseKey* find_case_key(std::string_view name) { return find_named(case_keys(), name); }

const CaseKey& nearest_case_key(std::string_view name) {
  if (const CaseKey* key = key_by_other_name(name)) return *key;
  const Keys& keys = case_keys();
  return *std::min_element(keys.begin(), keys.end(), [&](const CaseKey& a, const CaseKey& b) {
    return distance_to(name, a) < distance_to(name, b);
  });
}

std::string nearest_case_table(std::string_view name) {
  std::vector<std::string> tables;
  for (const CaseKey& key : case_keys()) tables.push_back(key.table());
  return nearest_name(tables, name);
}

std::string unknown_key(std::string_view name) {
  const CaseKey& nearest = nearest_case_key(name);
  return "unknown key: did you mean " + nearest.name + " (" + nearest.admissible() + ")?";
}

void require_in_force(const Case& the_case, const CaseKey& key) {
  if (key.table() == "wind" && !the_case.wind)
    throw WrongInput(key.name + ": the case has no [wind]; add this table");
  if (key.replaced_by_wind && the_case.wind)
    throw WrongInput(key.name +
                     ": [wind] replaces this key; use a key of [wind], or remove [wind]");
}

void require_admissible(const std::string& option, std::string_view key, double min, double max) {
  const CaseKey& known = number_key_named(key);
  if (!known.range.contains(min) || !known.range.contains(max))
    throw WrongInput(option + ": " + known.name + " must be " + known.admissible());
}

void set_case_value(Case& the_case, std::string_view name, double value) {
  const CaseKey& key = number_key_named(name);
  if (!key.range.contains(value)) {
    throw WrongInput(key.name + " = " + format_number(value) + ": must be " + key.admissible());
  }
  require_in_force(the_case, key);
  *key.number(the_case) = value + 0.0;  // a negative zero is zero
  settle_tension(the_case);
  if (key.name == "conductor.tension") settle_sag(the_case);
  if (key.name == "conductor.diameter") settle_wind(the_case);
  if (key.tuned != nullptr) *key.tuned(the_case) = false;
}

Case case_with(Case the_case, std::string_view name, double value) {
  require_counts(the_case, name);
  set_case_value(the_case, name, value);
  check_case(the_case);
  return the_case;
}

double case_value(const Case& the_case, std::string_view name) {
  const CaseKey& key = number_key_named(name);
  if (key.tuned != nullptr) return resolved_proportional_gain(the_case);
  Case copy = the_case;
  const double* value = key.number(copy);
  if (value == nullptr) throw WrongInput(key.name + ": the case has no [wind]; add this table");
  return *value;
}

}  // namespace holdfast::program
