#include "case_keys.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "cable_of_case.hpp"
#include "errors.hpp"
#include "text.hpp"

namespace holdfast::program {
namespace {

using case_tables::Absorber;
using case_tables::Backlash;
using case_tables::Conductor;
using case_tables::Control;
using case_tables::Excitation;
using case_tables::Initial;
using case_tables::Plant;
using case_tables::Reduction;
using case_tables::Wind;
using Keys = std::vector<CaseKey>;

AdmissibleRange positive() { return {0.0, std::numeric_limits<double>::infinity(), true, false}; }
AdmissibleRange not_negative() { return {0.0}; }
AdmissibleRange below_one() { return {0.0, 1.0, false, true}; }
AdmissibleRange any_number() { return {}; }

/// Where the member of a table lies in a case.
template <auto Table, auto Member>
auto field(Case& the_case) -> decltype(&(the_case.*Table.*Member)) {
  return &(the_case.*Table.*Member);
}

/// The same in [wind], null where the case has no wind.
template <auto Member>
double* wind_field(Case& the_case) {
  return the_case.wind ? &((*the_case.wind).*Member) : nullptr;
}

CaseKey number_key(const char* name, const char* unit, const AdmissibleRange& range,
                   double* (*where)(Case&), const char* description) {
  CaseKey key;
  key.name = name;
  key.unit = unit;
  key.description = description;
  key.range = range;
  key.number = where;
  return key;
}

CaseKey word_key(const char* name, std::vector<std::string> words, std::string* (*where)(Case&),
                 const char* description) {
  CaseKey key;
  key.name = name;
  key.description = description;
  key.words = std::move(words);
  key.word = where;
  return key;
}

CaseKey required(CaseKey key) {
  key.required = true;
  return key;
}

CaseKey gain_key() {
  CaseKey key = number_key("control.proportional_gain", "N/m", any_number(),
                           field<&Case::control, &Control::proportional_gain>,
                           "P; \"tuned\" takes k2 - m2 (2 pi frequency)^2, Eq. 6");
  key.words = {"tuned"};
  key.tuned = field<&Case::control, &Control::proportional_gain_tuned>;
  return key;
}

void add_conductor(Keys& keys) {
  keys.push_back(number_key("conductor.mass_per_length", "kg/m", positive(),
                            field<&Case::conductor, &Conductor::mass_per_length>,
                            "mass of the conductor per unit length"));
  keys.push_back(number_key("conductor.span", "m", positive(),
                            field<&Case::conductor, &Conductor::span>,
                            "distance between the supports, which are level"));
  keys.push_back(number_key("conductor.sag", "m", positive(),
                            field<&Case::conductor, &Conductor::sag>,
                            "sag at mid-span, below half the span"));
  keys.push_back(number_key("conductor.area", "m2", positive(),
                            field<&Case::conductor, &Conductor::area>, "cross section"));
  keys.push_back(number_key("conductor.youngs_modulus", "Pa", positive(),
                            field<&Case::conductor, &Conductor::youngs_modulus>,
                            "Young's modulus"));
  keys.push_back(number_key("conductor.damping_ratio", "", below_one(),
                            field<&Case::conductor, &Conductor::damping_ratio>,
                            "fraction of critical damping"));
  keys.push_back(number_key("conductor.gravity", "m/s2", positive(),
                            field<&Case::conductor, &Conductor::gravity>,
                            "gravitational acceleration"));
}

void add_absorber(Keys& keys) {
  keys.push_back(number_key("absorber.mass", "kg", positive(),
                            field<&Case::absorber, &Absorber::mass>, "mass of the absorber"));
  keys.push_back(number_key("absorber.position", "m", positive(),
                            field<&Case::absorber, &Absorber::position>,
                            "distance from the left support, inside the span"));
}

void add_reduction(Keys& keys) {
  keys.push_back(number_key("reduction.first_frequency", "Hz", positive(),
                            field<&Case::reduction, &Reduction::first_frequency>,
                            "lower natural frequency that the plant shall have"));
  keys.push_back(number_key("reduction.second_frequency", "Hz", positive(),
                            field<&Case::reduction, &Reduction::second_frequency>,
                            "higher natural frequency that the plant shall have"));
  keys.push_back(word_key("reduction.stiffness_reading", {"tangent", "secant", "least_squares"},
                          field<&Case::reduction, &Reduction::stiffness_reading>,
                          "how a straight line is laid through the static deflection"));
  keys.push_back(number_key("reduction.reading_below", "m", not_negative(),
                            field<&Case::reduction, &Reduction::reading_below>,
                            "how far below the equilibrium the line is laid"));
  keys.push_back(number_key("reduction.reading_above", "m", not_negative(),
                            field<&Case::reduction, &Reduction::reading_above>,
                            "how far above the equilibrium the line is laid"));
}

void add_plant(Keys& keys) {
  keys.push_back(number_key("plant.conductor_mass", "kg", positive(),
                            field<&Case::plant, &Plant::conductor_mass>, "m1"));
  keys.push_back(number_key("plant.conductor_stiffness", "N/m", positive(),
                            field<&Case::plant, &Plant::conductor_stiffness>, "k1"));
  keys.push_back(number_key("plant.conductor_damping", "N s/m", not_negative(),
                            field<&Case::plant, &Plant::conductor_damping>, "c1"));
  keys.push_back(number_key("plant.absorber_mass", "kg", positive(),
                            field<&Case::plant, &Plant::absorber_mass>, "m2"));
  keys.push_back(number_key("plant.absorber_stiffness", "N/m", positive(),
                            field<&Case::plant, &Plant::absorber_stiffness>, "k2"));
  keys.push_back(number_key("plant.absorber_damping", "N s/m", not_negative(),
                            field<&Case::plant, &Plant::absorber_damping>, "c2"));
}

void add_control(Keys& keys) {
  keys.push_back(gain_key());
  keys.push_back(number_key("control.differential_gain", "N s/m", any_number(),
                            field<&Case::control, &Control::differential_gain>, "D"));
  keys.push_back(number_key("control.sampling_period", "s", positive(),
                            field<&Case::control, &Control::sampling_period>,
                            "time between samples"));
  keys.push_back(number_key("control.processing_delay", "s", not_negative(),
                            field<&Case::control, &Control::processing_delay>,
                            "from taking a sample to applying its force, up to a period"));
  keys.push_back(number_key("backlash.width", "m", not_negative(),
                            field<&Case::backlash, &Backlash::width>, "r0"));
  keys.push_back(word_key("backlash.law", {"kollar"}, field<&Case::backlash, &Backlash::law>,
                          "the rule by which the drive enters and leaves the gap"));
}

void add_excitation(Keys& keys) {
  keys.push_back(number_key("excitation.amplitude", "N", not_negative(),
                            field<&Case::excitation, &Excitation::amplitude>,
                            "of the harmonic force on the conductor"));
  keys.push_back(number_key("excitation.frequency", "Hz", positive(),
                            field<&Case::excitation, &Excitation::frequency>,
                            "of the harmonic force on the conductor"));
  keys.push_back(word_key("excitation.hold", {"sampled", "exact"},
                          field<&Case::excitation, &Excitation::hold>,
                          "whether the force is held over each sample"));
}

void add_wind(Keys& keys) {
  keys.push_back(required(number_key("wind.speed", "m/s", positive(), wind_field<&Wind::speed>,
                                     "speed across the conductor")));
  keys.push_back(required(number_key("wind.diameter", "m", positive(), wind_field<&Wind::diameter>,
                                     "of the conductor")));
  keys.push_back(required(number_key("wind.effective_length", "m", positive(),
                                     wind_field<&Wind::effective_length>,
                                     "length over which vortices are shed in step")));
  keys.push_back(
      number_key("wind.strouhal", "", positive(), wind_field<&Wind::strouhal>, "Strouhal number"));
  keys.push_back(number_key("wind.lift_coefficient", "", not_negative(),
                            wind_field<&Wind::lift_coefficient>, "lift coefficient"));
  keys.push_back(number_key("wind.air_density", "kg/m3", positive(), wind_field<&Wind::air_density>,
                            "density of the air"));
}

void add_initial(Keys& keys) {
  keys.push_back(number_key("initial.z1", "m", any_number(), field<&Case::initial, &Initial::z1>,
                            "displacement of the conductor, downward"));
  keys.push_back(number_key("initial.v1", "m/s", any_number(), field<&Case::initial, &Initial::v1>,
                            "velocity of the conductor"));
  keys.push_back(number_key("initial.z2", "m", any_number(), field<&Case::initial, &Initial::z2>,
                            "displacement of the absorber, downward"));
  keys.push_back(number_key("initial.v2", "m/s", any_number(), field<&Case::initial, &Initial::v2>,
                            "velocity of the absorber"));
}

Keys make_case_keys() {
  Keys keys;
  add_conductor(keys);
  add_absorber(keys);
  add_reduction(keys);
  add_plant(keys);
  add_control(keys);
  add_excitation(keys);
  add_wind(keys);
  add_initial(keys);
  return keys;
}

std::string in_words(const AdmissibleRange& range) {
  std::string words;
  if (std::isfinite(range.lowest)) {
    words = (range.lowest_open ? "greater than " : "at least ") + format_number(range.lowest);
  }
  if (std::isfinite(range.highest)) {
    words += words.empty() ? "" : " and ";
    words += (range.highest_open ? "less than " : "at most ") + format_number(range.highest);
  }
  return words;
}

std::size_t distance_to(std::string_view name, const CaseKey& key) {
  // A key given without its table, or in the wrong one, is near as well.
  const std::size_t dot = name.rfind('.');
  const std::string_view last = dot == std::string_view::npos ? name : name.substr(dot + 1);
  const std::size_t elsewhere = dot == std::string_view::npos ? 1 : 2;
  return std::min(edit_distance(name, key.name), edit_distance(last, key.short_name()) + elsewhere);
}

const CaseKey& number_key_named(std::string_view name) {
  const CaseKey* key = find_case_key(name);
  if (key == nullptr) {
    const CaseKey& nearest = nearest_case_key(name);
    throw WrongInput(std::string(name) + ": unknown key: did you mean " + nearest.name + " (" +
                     nearest.admissible() + ")?");
  }
  if (key->number == nullptr) {
    throw WrongInput(key->name + " is not a number but a word: " + key->admissible());
  }
  return *key;
}

std::string quantity(const char* key, double value, const char* unit) {
  return std::string(key) + " = " + format_number(value) + " " + unit;
}

CaseFault control_fault(const Case& c) {
  if (c.control.processing_delay <= c.control.sampling_period) return {};
  return {{"control.processing_delay", "control.sampling_period"},
          quantity("control.processing_delay", c.control.processing_delay, "s") +
              " must not exceed " +
              quantity("control.sampling_period", c.control.sampling_period, "s")};
}

CaseFault reduction_fault(const Case& c) {
  const Reduction& r = c.reduction;
  if (!(r.first_frequency < r.second_frequency)) {
    return {{"reduction.first_frequency", "reduction.second_frequency"},
            quantity("reduction.first_frequency", r.first_frequency, "Hz") + " must be less than " +
                quantity("reduction.second_frequency", r.second_frequency, "Hz")};
  }
  const bool needs_extent = r.stiffness_reading != "tangent";
  if (needs_extent && !(r.reading_below + r.reading_above > 0.0)) {
    return {{"reduction.reading_below", "reduction.reading_above", "reduction.stiffness_reading"},
            "reduction.reading_below and reduction.reading_above must not both be 0 for the "
            "stiffness reading \"" +
                r.stiffness_reading + "\""};
  }
  return {};
}

CaseFault force_fault(const Case& c) {
  const Excitation force = effective_excitation(c);
  const bool fine =
      std::isfinite(force.amplitude) && std::isfinite(force.frequency) && force.frequency > 0.0;
  if (!fine) {
    return {{"wind.speed", "wind.diameter", "wind.effective_length", "wind.strouhal",
             "wind.lift_coefficient", "wind.air_density"},
            "the wind gives an excitation of " + format_number(force.amplitude) + " N at " +
                format_number(force.frequency) + " Hz, which must be finite and above 0 Hz"};
  }
  if (std::isfinite(resolved_proportional_gain(c))) return {};
  return {{"control.proportional_gain", "excitation.frequency", "plant.absorber_mass"},
          "the tuned proportional gain k2 - m2 (2 pi frequency)^2 is not finite"};
}

}  // namespace

bool AdmissibleRange::contains(double value) const {
  if (!std::isfinite(value)) return false;
  const bool above = lowest_open ? value > lowest : value >= lowest;
  const bool below = highest_open ? value < highest : value <= highest;
  return above && below;
}

std::string CaseKey::table() const { return name.substr(0, name.find('.')); }

std::string CaseKey::short_name() const { return name.substr(name.find('.') + 1); }

std::string CaseKey::admissible() const {
  std::string text;
  if (number != nullptr) {
    text = in_words(range);
    if (text.empty()) text = "any finite number";
    if (!unit.empty()) text += " " + unit;
  }
  for (const std::string& one : words) text += (text.empty() ? "\"" : " or \"") + one + "\"";
  return text;
}

const std::vector<CaseKey>& case_keys() {
  static const Keys keys = make_case_keys();
  return keys;
}

const CaseKey* find_case_key(std::string_view name) {
  const Keys& keys = case_keys();
  const auto found =
      std::find_if(keys.begin(), keys.end(), [&](const CaseKey& key) { return key.name == name; });
  return found == keys.end() ? nullptr : &*found;
}

const CaseKey& nearest_case_key(std::string_view name) {
  const Keys& keys = case_keys();
  return *std::min_element(keys.begin(), keys.end(), [&](const CaseKey& a, const CaseKey& b) {
    return distance_to(name, a) < distance_to(name, b);
  });
}

std::string nearest_case_table(std::string_view name) {
  const Keys& keys = case_keys();
  return std::min_element(keys.begin(), keys.end(),
                          [&](const CaseKey& a, const CaseKey& b) {
                            return edit_distance(name, a.table()) < edit_distance(name, b.table());
                          })
      ->table();
}

void require_in_force(const Case& the_case, const CaseKey& key) {
  if (key.table() == "wind" && !the_case.wind)
    throw WrongInput(key.name + ": the case has no [wind]");
  if (key.table() == "excitation" && the_case.wind)
    throw WrongInput(key.name + ": the case has [wind], which stands in place of [excitation]");
}

void set_case_value(Case& the_case, std::string_view name, double value) {
  const CaseKey& key = number_key_named(name);
  if (!key.range.contains(value)) {
    throw WrongInput(key.name + " = " + format_number(value) + ": admissible is " +
                     key.admissible());
  }
  require_in_force(the_case, key);
  *key.number(the_case) = value;
  if (key.tuned != nullptr) *key.tuned(the_case) = false;
}

double case_value(const Case& the_case, std::string_view name) {
  const CaseKey& key = number_key_named(name);
  if (key.tuned != nullptr) return resolved_proportional_gain(the_case);
  Case copy = the_case;
  const double* value = key.number(copy);
  if (value == nullptr) throw WrongInput(key.name + ": the case has no [wind]");
  return *value;
}

CaseFault conductor_fault(const Case& the_case) {
  const double span = the_case.conductor.span;
  if (!(the_case.absorber.position < span)) {
    return {{"absorber.position", "conductor.span"},
            quantity("absorber.position", the_case.absorber.position, "m") + " must be less than " +
                quantity("conductor.span", span, "m")};
  }
  if (!(the_case.conductor.sag < span / 2.0)) {
    return {{"conductor.sag", "conductor.span"},
            quantity("conductor.sag", the_case.conductor.sag, "m") + " must be less than half of " +
                quantity("conductor.span", span, "m")};
  }
  const auto conductor = conductor_of(the_case);
  const double strain = conductor.parabolic_tension() / conductor.axial_stiffness();
  // Below, the stretch of a bar of the continuous cable drowns in the round-off of its length.
  constexpr double smallest_strain = 1e-10, largest_strain = 0.1;
  if (!(strain >= smallest_strain && strain <= largest_strain)) {
    return {{"conductor.youngs_modulus", "conductor.area", "conductor.sag",
             "conductor.mass_per_length", "conductor.span", "conductor.gravity"},
            "the conductor's own weight would stretch it by " + format_rounded(strain) +
                " of its length; admissible is from 1e-10, less than which cannot be computed, to "
                "0.1, more than which no cable bears"};
  }
  return {};
}

CaseFault first_fault(const Case& the_case) {
  for (const auto find : {control_fault, conductor_fault, reduction_fault, force_fault}) {
    CaseFault fault = find(the_case);
    if (!fault.message.empty()) return fault;
  }
  return {};
}

void check_case(const Case& the_case) {
  const CaseFault fault = first_fault(the_case);
  if (!fault.message.empty()) throw WrongInput(fault.message);
}

}  // namespace holdfast::program
