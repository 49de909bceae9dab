#pragma once

#include <array>
#include <limits>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "case/case.hpp"

namespace holdfast::program {

/// Range of numbers that a key admits. The ends belong to it unless open; infinity and NaN do not.
struct AdmissibleRange {
  double lowest = -std::numeric_limits<double>::infinity();
  double highest = std::numeric_limits<double>::infinity();
  bool lowest_open = false;
  bool highest_open = false;
  bool whole = false;  // only whole numbers

  bool contains(double value) const;
  /// The range in words: `greater than 0 s`, `any finite number rad`.
  std::string in_words(const std::string& unit) const;
};

/// Name, unit and range of one number of an additional harmonic of the excitation.
struct HarmonicPart {
  const char* name;
  const char* unit;
  AdmissibleRange range;
};

/// The numbers of an additional harmonic: amplitude, frequency, phase; the phase may be left out.
const std::array<HarmonicPart, 3>& harmonic_parts();

/// Kind of the value of a key.
enum class ValueKind {
  number,
  word,
  file,       ///< the name of a file
  conductor,  ///< a name in the conductor library
  interval,   ///< two numbers, ascending
  numbers,    ///< a list of numbers
  harmonics   ///< a list of [amplitude, frequency, phase]
};

/// Pointer to the value of a key in a case. The kind of the key selects the type.
using ValuePlace = std::variant<double*, std::string*, std::array<double, 2>*, std::vector<double>*,
                                std::vector<std::array<double, 3>>*>;

/// Name, unit, range and description of a key of a case or of a device.
struct KeyForm {
  std::string name;  // with the table, except a device's: "control.sampling_period"
  std::string unit;  // "": dimensionless
  std::string description;
  AdmissibleRange range;  // of a number, of both ends of an interval, of each number of a list
  std::vector<std::string> words;  // admissible words; a number may have one, "tuned" or "none"
  ValueKind kind = ValueKind::number;
  bool may_be_none = true;  // whether a name or a list may be empty

  bool is_number() const { return kind == ValueKind::number; }
  /// The admissible values: `greater than 0 s`, `a whole number, at least 1 and at most 10000`,
  /// `"sampled" or "exact"`.
  std::string admissible() const;
};

/// A key of a case file outside [[device]] and [uncertain].
struct CaseKey : KeyForm {
  ValuePlace (*place)(Case&) = nullptr;  // null for a key of [wind] in a case without [wind]
  bool required = false;                 // whether a key of [wind] has no default
  bool replaced_by_wind = false;         // whether [wind] replaces it
  bool beyond_two_masses = false;        // whether two masses do not depend on it
  bool* (*tuned)(Case&) = nullptr;       // flag for the word "tuned"; null: no such word

  std::string table() const;       // "control"
  std::string short_name() const;  // "sampling_period"
  /// Pointer to the number in a case; null: not a number, or a key of [wind] without wind.
  double* number(Case& the_case) const;

  /// Whether the case has a word instead of the number: "tuned", or "none", stored as infinity.
  bool bears_word(Case& the_case) const;
  void give_word(Case& the_case) const;
};

/// All keys of a case, in the order of a written case file.
const std::vector<CaseKey>& case_keys();

/// The key with the given name; null if there is none.
const CaseKey* find_case_key(std::string_view name);

/// The known key, or table, most similar to an unknown name; symbols such as tau are recognised.
const CaseKey& nearest_case_key(std::string_view name);
std::string nearest_case_table(std::string_view name);

/// The message for an unknown key: "unknown key: did you mean control.velocity (...)?"
std::string unknown_key(std::string_view name);

/// Throws WrongInput for a key of [wind] in a case without [wind], or a key that [wind] replaces.
void require_in_force(const Case& the_case, const CaseKey& key);

/// Throws WrongInput if a key does not admit the ends, min and max, of an axis over it.
/// @param option  beginning of the message: "--map plant.absorber_mass=-1:1:3"
void require_admissible(const std::string& option, std::string_view key, double min, double max);

/// A copy of the case with one number changed. Throws as set_case_value() and check_case().
Case case_with(Case the_case, std::string_view name, double value);

/// Sets one number by its key; a sweep calls it, then check_case() once all its keys are set.
/// A proportional gain set this way is no longer tuned.
/// Throws WrongInput when the key is unknown or not a number, when the value is not finite, out of
/// range or a fraction where only whole numbers are admitted, when wind.* is set and the case has
/// no wind, and when excitation.amplitude or excitation.frequency is set and the case has wind.
void set_case_value(Case& the_case, std::string_view name, double value);

/// The number of a key: resolved_proportional_gain() for the proportional gain, infinity for a word
/// such as "none". Throws WrongInput if the key is unknown, no number, or of [wind] without wind.
double case_value(const Case& the_case, std::string_view name);

/// Contradiction between keys of a case, each of which is within its own range.
struct CaseFault {
  std::vector<std::string> keys;  // keys involved
  std::string message;            // empty: nothing is wrong
};
CaseFault first_fault(const Case& the_case);

/// The part of first_fault() that concerns [conductor] and [absorber].
CaseFault conductor_fault(const Case& the_case);

/// Sets tension and sag of the conductor at weather.temperature from [stringing], if the case has
/// it. Throws WrongInput if the conductor would break or leave its stress-strain curves.
void settle_tension(Case& the_case);

/// Sets the sag of the conductor from its tension, if the case has one.
void settle_sag(Case& the_case);

/// Sets wind.diameter to the conductor's diameter, if that is known and wind.diameter is not given.
void settle_wind(Case& the_case);

/// Throws WrongInput when first_fault() finds one.
void check_case(const Case& the_case);

/// Throws WrongInput if a displacement (m) given by an option is not smaller than the span.
void require_within_span(const std::string& option, double displacement, const Case& the_case);

}  // namespace holdfast::program
