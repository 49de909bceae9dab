#include "case/plausibility/doubts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "case/case_source.hpp"
#include "case/library/conductor_library.hpp"
#include "case/model/cable_of_case.hpp"
#include "case/needed.hpp"
#include "case/units.hpp"
#include "holdfast/core/types.hpp"
#include "process/errors.hpp"
#include "text/text.hpp"

namespace holdfast::program {
namespace {

using Keys = std::vector<std::string>;
using Quantities = std::vector<PlausibleQuantity>;

/// Whether a value is outside a range; false for NaN, an unknown value.
bool is_beyond(const AdmissibleRange& range, double value) {
  return value < range.lowest || value > range.highest;
}

/// Number of quantities unusual for cables, to choose between equally possible units.
int oddness(const Case& the_case) {
  const case_tables::Conductor& c = the_case.conductor;
  const double diameter = std::isfinite(c.diameter) ? c.diameter
                          : the_case.wind           ? the_case.wind->diameter
                                                    : std::nan("");
  const double circle = 0.25 * pi<double> * diameter * diameter;
  const std::array<std::array<double, 3>, 5> mostly = {
      {{c.youngs_modulus, 4e10, 2.2e11},              // metals, stranded or not
       {c.mass_per_length / c.area, 2500.0, 9000.0},  // aluminium to copper
       {c.area / circle, 0.5, 1.0},                   // a strand
       {parabolic_tension_of(the_case) / c.rated_strength, 0.05, 0.5},
       {c.mass_per_length / circle, 1500.0, 8000.0}}};
  int odd = 0;
  for (const auto& [value, lowest, highest] : mostly)
    odd += value < lowest || value > highest ? 1 : 0;
  return odd;
}

/// Implausibility: 1000 for a fault, 100 for each impossible and 1 for each unusual quantity.
int badness(const Case& the_case, const Quantities& quantities) {
  int sum = first_fault(the_case).message.empty() ? 0 : 1000;
  for (const PlausibleQuantity& quantity : quantities) {
    const double value = quantity.of(the_case);
    sum += is_beyond(quantity.possible, value) ? 100 : is_beyond(quantity.usual, value) ? 1 : 0;
  }
  return sum;
}

/// The case with the values of some keys multiplied by a factor.
Case scaled(Case the_case, const Keys& keys, double factor) {
  for (const std::string& name : keys) {
    const CaseKey& key = *find_case_key(name);
    if (double* value = key.number(the_case)) *value *= factor;
  }
  return the_case;
}

/// All given keys of the table of `like` that have its unit.
Keys of_same_unit(const Case& the_case, const CaseKey& like) {
  Keys keys;
  for (const CaseKey& key : case_keys())
    if (key.is_number() && key.unit == like.unit && key.table() == like.table() &&
        the_case.is_given(key.name))
      keys.push_back(key.name);
  return keys;
}

std::string listed(const Keys& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

std::string value_of(const Case& the_case, const std::string& key) {
  const std::string& unit = find_case_key(key)->unit;
  return format_rounded(case_value(the_case, key)) + (unit.empty() ? "" : " " + unit);
}

/// The given keys for a message: "my.toml:3: conductor.area = 546 m2", or options as given.
std::string given_text(const Case& the_case, const Keys& keys) {
  std::string text;
  for (const std::string& key : keys) {
    const std::string& place = the_case.places.at(key);
    const bool is_option = place.rfind("--set", 0) == 0;
    text += (text.empty() ? "" : ", ") +
            (is_option ? place : place + ": " + key + " = " + value_of(the_case, key));
  }
  return text;
}

/// Search for the keys and the units in which their values make a case most plausible.
class BestUnits {
 public:
  BestUnits(const Case& the_case, const Quantities& quantities)
      : case_(the_case),
        quantities_(quantities),
        badness_(badness(the_case, quantities)),
        least_(badness_) {}

  void try_keys(const Keys& keys) {
    const std::string unit = find_case_key(keys.front())->unit;
    for (const Unit& other : other_units()) {
      if (unit != other.own || !other.is_mistaken) continue;
      const Case changed = scaled(case_, keys, other.factor());
      const int bad = badness(changed, quantities_), odd = oddness(changed);
      // If a factor of 1.5 removes at least half of the implausibility, the unit is not mistaken.
      const double a_little = other.factor() < 1.0 ? 1.0 / 1.5 : 1.5;
      const int mended = badness_ - badness(scaled(case_, keys, a_little), quantities_);
      if (2 * mended > badness_ - bad || bad >= badness_) continue;
      const auto now = std::pair(bad, odd), least = std::pair(least_, oddness_);
      if (now > least || (now == least && keys != guess_.keys)) continue;
      is_sure_ = now < least;
      names_ = (is_sure_ ? "" : names_ + " or ") + other.name;
      if (is_sure_) guess_ = {keys, "", changed};
      least_ = bad;
      oddness_ = odd;
    }
  }

  UnitGuess found() && {
    if (guess_.keys.empty()) return std::move(guess_);
    const bool one = guess_.keys.size() == 1;
    guess_.text =
        one ? "; did you mean " + names_ : "; are " + listed(guess_.keys) + " in " + names_;
    if (one && is_sure_)
      guess_.text += ", that is " + value_of(guess_.corrected, guess_.keys.front());
    guess_.text += "?";
    return std::move(guess_);
  }

 private:
  const Case& case_;
  const Quantities& quantities_;
  int badness_, least_, oddness_ = 0;
  std::string names_;
  bool is_sure_ = false;  // exactly one unit is best
  UnitGuess guess_;
};

/// Hint, " (did you mean lb/ft, that is 1.628 kg/m?)", at the unit that brings a value nearest to
/// the library, within 15 % since conductors of one name differ; empty without such a unit.
std::string mistaken_unit_text(const std::string& own, double given, double ratio) {
  double nearest = 0.15;
  const Unit* found = nullptr;
  for (const Unit& unit : other_units()) {
    const double off = std::abs(unit.factor() * ratio - 1.0);
    if (own != unit.own || !unit.is_mistaken || off >= nearest) continue;
    nearest = off;
    found = &unit;
  }
  if (found == nullptr) return "";
  return std::string(" (did you mean ") + found->name + ", that is " +
         format_rounded(found->in_own(given)) + " " + own + "?)";
}

std::string found_text(const PlausibleQuantity& quantity, double value) {
  const std::string unit = quantity.unit;
  return std::string(quantity.name) + " is " + format_rounded(value) +
         (unit.empty() ? "" : " " + unit);
}

}  // namespace

UnitGuess guessed_unit(const Case& the_case, const Keys& keys, const Quantities& quantities) {
  BestUnits best(the_case, quantities);
  std::set<Keys> groups;
  for (const std::string& name : keys) {
    const CaseKey* key = find_case_key(name);  // null for a key of a device
    if (key == nullptr || !the_case.is_given(name)) continue;
    groups.insert(of_same_unit(the_case, *key));
    Case copy = the_case;
    if (key->is_number() && !key->bears_word(copy)) best.try_keys({name});
  }
  for (const Keys& together : groups)
    if (together.size() > 1) best.try_keys(together);
  return std::move(best).found();
}

CaseFault impossible_fault(const Case& the_case) {
  for (const PlausibleQuantity& quantity : quantities_of_case()) {
    const double value = quantity.of(the_case);
    if (is_beyond(quantity.possible, value) && !is_half_borrowed(the_case, quantity.keys))
      return {quantity.keys, found_text(quantity, value) + "; must be " +
                                 quantity.possible.in_words(quantity.unit) + ": " +
                                 quantity.reason};
  }
  return {};
}

std::vector<PlausibleQuantity> in_question(const Case& the_case,
                                           const std::vector<PlausibleQuantity>& quantities) {
  const bool has_masses = is_two_masses(the_case), has_absorber = has_active_absorber(the_case);
  // Without a reduction a given plant.absorber_mass is used, not absorber.mass.
  const auto is_out = [&](const std::string& key) {
    return (!has_masses && the_case.is_given("plant.absorber_mass") && key == "absorber.mass") ||
           (!has_masses && key.rfind("plant.conductor", 0) == 0) ||
           (!has_absorber && key.find("absorber") != std::string::npos);
  };
  std::vector<PlausibleQuantity> kept;
  for (const PlausibleQuantity& quantity : quantities)
    if (std::none_of(quantity.keys.begin(), quantity.keys.end(), is_out)) kept.push_back(quantity);
  return kept;
}

std::vector<std::string> doubts_about(const Case& the_case, const Quantities& quantities) {
  std::vector<std::string> doubts;
  Case read = the_case;  // with the values in the guessed units
  for (const PlausibleQuantity& quantity : quantities) {
    const double value = quantity.of(read);
    if (!is_beyond(quantity.usual, value) || is_half_borrowed(the_case, quantity.keys)) continue;
    UnitGuess guess;
    if (quantity.asks_unit) guess = guessed_unit(read, quantity.keys, quantities);
    Keys keys = guess.keys;
    if (keys.empty())
      for (const std::string& key : quantity.keys)
        if (the_case.is_given(key)) keys.push_back(key);
    if (keys.empty()) continue;
    doubts.push_back(given_text(read, keys) + ": " + found_text(quantity, value) + ", usually " +
                     quantity.usual.in_words(quantity.unit) + ": " + quantity.reason + guess.text);
    if (!guess.keys.empty()) read = guess.corrected;
  }
  return doubts;
}

std::string contradicted_conductor_text(const Case& the_case) {
  if (!the_case.conductor_given || !the_case.plant_given || plant_is_reduced(the_case) ||
      !is_two_masses(the_case))
    return "";
  constexpr double tolerance = 0.05;
  double stiffness = the_case.plant.conductor_stiffness;
  try {
    stiffness = conductor_stiffness_of(the_case);
  } catch (const MissingKeys&) {
    return "";
  } catch (const WrongInput&) {
    // The range of the readings of k1 does not fit this conductor, but no answer needs it.
  }
  const auto [first, second] = undamped_frequencies(the_case.plant);
  const case_tables::Reduction& reduction = the_case.reduction;
  struct Pair {
    const char* name;
    double given, conductors;
    const char* unit;
  };
  const std::array<Pair, 4> pairs = {
      {{"k1", the_case.plant.conductor_stiffness, stiffness, "N/m"},
       {"m2", the_case.plant.absorber_mass, the_case.absorber.mass, "kg"},
       {"the lower frequency", first, reduction.first_frequency, "Hz"},
       {"the higher frequency", second, reduction.second_frequency, "Hz"}}};
  std::string differ;
  for (const Pair& pair : pairs)
    if (std::abs(pair.given - pair.conductors) > tolerance * std::abs(pair.conductors))
      differ += (differ.empty() ? "" : ", ") + std::string(pair.name) + " " +
                format_rounded(pair.given) + " instead of " + format_rounded(pair.conductors) +
                " " + pair.unit;
  if (differ.empty()) return "";
  return "every key of [plant] is given, so [conductor], [absorber] and [reduction] are not used "
         "for the plant, and they contradict [plant]: " +
         differ + "; remove [plant] to compute the plant from the conductor";
}

std::string contradicted_name_text(const Case& the_case) {
  const LibraryConductor* conductor = find_conductor(the_case.conductor.name);
  if (conductor == nullptr) return "";
  constexpr double tolerance = 0.1;
  std::string differ;
  for (const LibraryKey& key : library_keys()) {
    // A name does not determine the number of layers nor the bending stiffness.
    if (key.name == "conductor.layers" || key.name == "conductor.bending_stiffness") continue;
    const double given = case_value(the_case, key.name), ratio = given / (conductor->*key.value);
    if (is_from_library(the_case, key.name) || !std::isfinite(ratio)) continue;
    if (std::abs(ratio - 1.0) <= tolerance) continue;
    const std::string& unit = find_case_key(key.name)->unit;
    differ += (differ.empty() ? "" : "; ") + std::string(key.name) + " " + format_rounded(given) +
              " instead of " + format_rounded(conductor->*key.value) + " " + unit + ", ratio " +
              format_rounded(ratio) + mistaken_unit_text(unit, given, ratio);
  }
  if (differ.empty()) return "";
  return the_case.places.at("conductor.name") + ": values given besides conductor.name = \"" +
         conductor->name + "\" differ from the library; remove those that are wrong: " + differ;
}

std::string borrowed_damping_text(const Case& the_case) {
  if (the_case.stands_alone || the_case.conductor.name.empty() ||
      the_case.is_given("conductor.damping_ratio"))
    return "";
  return "conductor.damping_ratio is " + format_number(the_case.conductor.damping_ratio) +
         ", the value of the built-in cable: no data sheet gives one, and a stranded conductor "
         "under tension has about 0.0001 to 0.002; give conductor.damping_ratio";
}

std::string borrowed_control(const Case& the_case) {
  if (the_case.stands_alone || (!the_case.plant_given && !the_case.conductor_given)) return "";
  Keys missing;
  for (const char* key : {"control.proportional_gain", "control.differential_gain",
                          "control.sampling_period", "backlash.width"})
    if (!the_case.is_given(key)) missing.emplace_back(key);
  return listed(missing);
}

std::string borrowed_gains_text(const Case& the_case) {
  if (the_case.stands_alone || the_case.is_given("control.proportional_gain") ||
      the_case.is_given("control.differential_gain"))
    return "";
  const auto impedance = [](const case_tables::Plant& plant) {
    return std::sqrt(plant.absorber_stiffness * plant.absorber_mass);
  };
  const double here = impedance(the_case.plant), there = impedance(CaseSource{}.load().plant);
  constexpr double factor = 3.0;
  if (here < factor * there && there < factor * here) return "";
  return "control.proportional_gain and control.differential_gain are not given: the gains are "
         "those of the built-in case, whose absorber differs (sqrt(k2 m2) is " +
         format_rounded(here) + " N s/m here and " + format_rounded(there) +
         " there); holdfast design finds gains for this plant";
}

}  // namespace holdfast::program
