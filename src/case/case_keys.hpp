#pragma once

#include <array>
#include <limits>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "case/case.hpp"

namespace holdfast::program {

/// The numbers that a key admits; the ends belong to it unless open. Infinity and NaN never do.
struct AdmissibleRange {
  double lowest = -std::numeric_limits<double>::infinity();
  double highest = std::numeric_limits<double>::infinity();
  bool lowest_open = false;
  bool highest_open = false;
  bool whole = false;  // only whole numbers

  bool contains(double value) const;
  /// `greater than 0 s`, `any finite number rad`.
  std::string in_words(const std::string& unit) const;
};

/// One of the three numbers of a further harmonic of the excitation.
struct HarmonicPart {
  const char* name;
  const char* unit;
  AdmissibleRange range;
};

/// Amplitude, frequency and phase, of which the last may be left out.
const std::array<HarmonicPart, 3>& harmonic_parts();

/// Kinds of values of a key.
enum class ValueKind {
  number,
  word,
  file,       ///< the name of a file
  conductor,  ///< a name of the library
  interval,   ///< two numbers, ascending
  numbers,    ///< a list
  harmonics
};

/// Where the value of a key lies: its type follows from its kind.
using ValuePlace = std::variant<double*, std::string*, std::array<double, 2>*, std::vector<double>*,
                                std::vector<std::array<double, 3>>*>;

/// Form of a key of a case, or of one of its devices.
struct KeyForm {
  std::string name;  // of a case with its table: "control.sampling_period"
  std::string unit;  // "" without dimension
  std::string description;
  AdmissibleRange range;           // of numbers; of both ends of an interval; of each of a list
  std::vector<std::string> words;  // admissible words; a number may have one, "tuned" or "none"
  ValueKind kind = ValueKind::number;
  bool may_be_none = true;  // a name or a list may be empty

  bool is_number() const { return kind == ValueKind::number; }
  /// In words: `greater than 0 s`, `a whole number, at least 1 and at most 10000`,
  /// `"sampled" or "exact"`.
  std::string admissible() const;
};

/// One key of the case file but for those of its devices.
struct CaseKey : KeyForm {
  ValuePlace (*place)(Case&) = nullptr;  // a null pointer of [wind] for a case without wind
  bool required = false;                 // of [wind]: has no default
  bool replaced_by_wind = false;         // of [excitation]: [wind] stands in its place
  bool beyond_two_masses = false;        // nothing of the two masses depends on it
  bool* (*tuned)(Case&) = nullptr;  // set when a key that is a number is given the word "tuned"

  std::string table() const;       // "control"
  std::string short_name() const;  // "sampling_period"
  /// Where the number of a case lies; null of any other key.
  double* number(Case& the_case) const;

  /// Whether the word of a number stands in place of one: "tuned", or "none", which is infinity.
  bool bears_word(Case& the_case) const;
  void give_word(Case& the_case) const;
};

/// Every key, in the order in which a case is written.
const std::vector<CaseKey>& case_keys();

/// The key of that name, or null.
const CaseKey* find_case_key(std::string_view name);

/// The known key, or the known table, closest to a name that is not known (fewest edits).
const CaseKey& nearest_case_key(std::string_view name);
std::string nearest_case_table(std::string_view name);

/// "unknown key: did you mean control.velocity (...)?"
std::string unknown_key(std::string_view name);

/// Throws WrongInput for a key of [wind] and a case without it, and for one that [wind] stands in
/// place of.
void require_in_force(const Case& the_case, const CaseKey& key);

/// Throws WrongInput for an axis over a key, from min to max, whose ends the key does not admit.
/// @param option  with its text, which the error begins with: "--map plant.absorber_mass=-1:1:3"
void require_admissible(const std::string& option, std::string_view key, double min, double max);

/// The case with one number changed, checked. Throws as set_case_value() and check_case().
Case case_with(Case the_case, std::string_view name, double value);

/// Sets one number by its key; a sweep calls it, then check_case() once all its keys are set.
/// A proportional gain set so is no longer tuned.
/// Throws WrongInput when the key is unknown or not a number, when the value is not finite, out of
/// range or a fraction where only whole numbers are admitted, when wind.* is set and the case has
/// no wind, and when excitation.amplitude or excitation.frequency is set and the case has wind.
void set_case_value(Case& the_case, std::string_view name, double value);

/// One number by its key; the proportional gain as resolved_proportional_gain() gives it, infinity
/// for a largest force that is "none".
/// Throws WrongInput when the key is unknown or not a number, or wind.* and there is no wind.
double case_value(const Case& the_case, std::string_view name);

/// Fault between keys that are each admissible alone.
struct CaseFault {
  std::vector<std::string> keys;  // those involved
  std::string message;            // empty: nothing is wrong
};
CaseFault first_fault(const Case& the_case);

/// The part of it that is about [conductor] and [absorber].
CaseFault conductor_fault(const Case& the_case);

/// Gives the conductor the tension that [stringing] leaves at weather.temperature, and its sag,
/// where it was strung. Throws WrongInput where it would break.
void settle_tension(Case& the_case);

/// Gives the conductor the sag that its tension leaves, where it has a tension.
void settle_sag(Case& the_case);

/// Gives the wind the conductor's diameter, where that is known and nobody gives the wind one.
void settle_wind(Case& the_case);

/// Throws WrongInput when first_fault() finds one.
void check_case(const Case& the_case);

/// Throws WrongInput for a displacement of the conductor (m) that an option gives beyond the span.
void require_within_span(const std::string& option, double displacement, const Case& the_case);

}  // namespace holdfast::program
