#include "case/case_keys.hpp"

#include <utility>

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
AdmissibleRange whole_number(double lowest, double highest) {
  return {lowest, highest, false, false, true};
}
/// Whole numbers that a double tells apart.
AdmissibleRange seed() { return whole_number(0.0, 9007199254740992.0); }

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

CaseKey replaced_by_wind(CaseKey key) {
  key.replaced_by_wind = true;
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

CaseKey largest_force_key() {
  CaseKey key = number_key("control.largest_force", "N", positive(),
                           field<&Case::control, &Control::largest_force>,
                           "of the drive, at which the command is cut off; \"none\": no limit");
  key.words = {"none"};
  return key;
}

CaseKey harmonics_key() {
  CaseKey key;
  key.name = "excitation.harmonics";
  key.description = "[amplitude (N), frequency (Hz), phase (rad)] of each further harmonic";
  key.harmonics = field<&Case::excitation, &Excitation::harmonics>;
  return key;
}

CaseKey record_key() {
  CaseKey key;
  key.name = "excitation.record";
  key.description = "CSV file of a further force, columns time_s and force_N";
  key.file = field<&Case::excitation, &Excitation::record>;
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
}

void add_controller_limits(Keys& keys) {
  keys.push_back(number_key("control.displacement_quantum", "m", not_negative(),
                            field<&Case::control, &Control::displacement_quantum>,
                            "step of the measured displacement; 0: none"));
  keys.push_back(number_key("control.velocity_quantum", "m/s", not_negative(),
                            field<&Case::control, &Control::velocity_quantum>,
                            "step of the measured velocity; 0: none"));
  keys.push_back(word_key(
      "control.velocity", {"measured", "difference"}, field<&Case::control, &Control::velocity>,
      "whether the velocity is measured or the difference of two displacements"));
  keys.push_back(largest_force_key());
  keys.push_back(number_key("control.jitter", "s", not_negative(),
                            field<&Case::control, &Control::jitter>,
                            "largest deviation of a sampling instant from its place"));
  keys.push_back(number_key("control.jitter_seed", "", seed(),
                            field<&Case::control, &Control::jitter_seed>,
                            "of the random sampling instants"));
}

void add_backlash(Keys& keys) {
  keys.push_back(number_key("backlash.width", "m", not_negative(),
                            field<&Case::backlash, &Backlash::width>, "r0"));
  keys.push_back(word_key("backlash.law", {"kollar", "immediate", "play", "dead_zone", "none"},
                          field<&Case::backlash, &Backlash::law>,
                          "the rule by which the drive enters and leaves the gap"));
  keys.push_back(number_key("backlash.contact_stiffness", "N/m", not_negative(),
                            field<&Case::backlash, &Backlash::contact_stiffness>,
                            "of the stops of a dead zone"));
  keys.push_back(number_key("backlash.contact_damping", "N s/m", not_negative(),
                            field<&Case::backlash, &Backlash::contact_damping>,
                            "of the stops of a dead zone"));
}

void add_excitation(Keys& keys) {
  keys.push_back(replaced_by_wind(number_key("excitation.amplitude", "N", not_negative(),
                                             field<&Case::excitation, &Excitation::amplitude>,
                                             "of the harmonic force on the conductor")));
  keys.push_back(replaced_by_wind(number_key("excitation.frequency", "Hz", positive(),
                                             field<&Case::excitation, &Excitation::frequency>,
                                             "of the harmonic force on the conductor")));
  keys.push_back(word_key("excitation.hold", {"sampled", "exact"},
                          field<&Case::excitation, &Excitation::hold>,
                          "whether the force is held over each sample"));
  keys.push_back(harmonics_key());
  keys.push_back(record_key());
  keys.push_back(word_key("excitation.record_interpolation", {"linear", "held"},
                          field<&Case::excitation, &Excitation::record_interpolation>,
                          "between the rows of the record"));
}

void add_noise(Keys& keys) {
  keys.push_back(number_key("excitation.noise_rms", "N", not_negative(),
                            field<&Case::excitation, &Excitation::noise_rms>,
                            "root mean square of a further random force; 0: none"));
  keys.push_back(number_key("excitation.noise_lowest", "Hz", positive(),
                            field<&Case::excitation, &Excitation::noise_lowest>,
                            "lower end of the band of the random force"));
  keys.push_back(number_key("excitation.noise_highest", "Hz", positive(),
                            field<&Case::excitation, &Excitation::noise_highest>,
                            "upper end of the band of the random force"));
  keys.push_back(number_key("excitation.noise_lines", "", whole_number(1.0, 10000.0),
                            field<&Case::excitation, &Excitation::noise_lines>,
                            "number of harmonics that the random force is made of"));
  keys.push_back(number_key("excitation.noise_seed", "", seed(),
                            field<&Case::excitation, &Excitation::noise_seed>,
                            "of the phases of the random force"));
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
  add_controller_limits(keys);
  add_backlash(keys);
  add_excitation(keys);
  add_noise(keys);
  add_wind(keys);
  add_initial(keys);
  return keys;
}

}  // namespace

const std::vector<CaseKey>& case_keys() {
  static const Keys keys = make_case_keys();
  return keys;
}

}  // namespace holdfast::program
