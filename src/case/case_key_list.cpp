#include <limits>
#include <optional>
#include <type_traits>
#include <utility>

#include "case/case_keys.hpp"

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

constexpr AdmissibleRange positive{0.0, std::numeric_limits<double>::infinity(), true};
constexpr AdmissibleRange not_negative{0.0};
constexpr AdmissibleRange below_one{0.0, 1.0, false, true};
constexpr AdmissibleRange any_number{};
constexpr AdmissibleRange some_lines{1.0, 10000.0, false, false, true};
/// Whole numbers that a double tells apart.
constexpr AdmissibleRange seed{0.0, 9007199254740992.0, false, false, true};

/// Where the member of a table lies in a case; null for [wind] where the case has none.
template <auto Table, auto Member>
auto* where(Case& the_case) {
  auto& table = the_case.*Table;
  if constexpr (std::is_same_v<decltype(table), std::optional<Wind>&>)
    return table ? &((*table).*Member) : nullptr;
  else
    return &(table.*Member);
}

/// Adds the keys of one table to the list.
template <auto Table>
class KeysOf {
 public:
  KeysOf(Keys& keys, std::string table) : keys_(keys), table_(std::move(table)) {}

  CaseKey& add(const char* name, const char* description) {
    CaseKey& key = keys_.emplace_back();
    key.name = table_ + "." + name;
    key.description = description;
    return key;
  }

  template <auto Member>
  CaseKey& number(const char* name, const char* unit, const AdmissibleRange& range,
                  const char* description) {
    CaseKey& key = add(name, description);
    key.unit = unit;
    key.range = range;
    key.number = where<Table, Member>;
    return key;
  }

  template <auto Member>
  void word(const char* name, std::vector<std::string> words, const char* description) {
    CaseKey& key = add(name, description);
    key.words = std::move(words);
    key.word = where<Table, Member>;
  }

 private:
  Keys& keys_;
  std::string table_;
};

void add_cable(Keys& keys) {
  KeysOf<&Case::conductor> conductor(keys, "conductor");
  conductor.number<&Conductor::mass_per_length>("mass_per_length", "kg/m", positive,
                                                "mass of the conductor per unit length");
  conductor.number<&Conductor::span>("span", "m", positive,
                                     "distance between the supports, which are level");
  conductor.number<&Conductor::sag>("sag", "m", positive, "sag at mid-span, below half the span");
  conductor.number<&Conductor::area>("area", "m2", positive, "cross section");
  conductor.number<&Conductor::youngs_modulus>("youngs_modulus", "Pa", positive, "Young's modulus");
  conductor.number<&Conductor::damping_ratio>("damping_ratio", "", below_one,
                                              "fraction of critical damping");
  conductor.number<&Conductor::gravity>("gravity", "m/s2", positive, "gravitational acceleration");
  KeysOf<&Case::absorber> absorber(keys, "absorber");
  absorber.number<&Absorber::mass>("mass", "kg", positive, "mass of the absorber");
  absorber.number<&Absorber::position>("position", "m", positive,
                                       "distance from the left support, inside the span");
  KeysOf<&Case::reduction> reduction(keys, "reduction");
  reduction.number<&Reduction::first_frequency>(
      "first_frequency", "Hz", positive, "lower natural frequency that the plant shall have");
  reduction.number<&Reduction::second_frequency>(
      "second_frequency", "Hz", positive, "higher natural frequency that the plant shall have");
  reduction.word<&Reduction::stiffness_reading>(
      "stiffness_reading", {"tangent", "secant", "least_squares"},
      "how a straight line is laid through the static deflection");
  reduction.number<&Reduction::reading_below>("reading_below", "m", not_negative,
                                              "how far below the equilibrium the line is laid");
  reduction.number<&Reduction::reading_above>("reading_above", "m", not_negative,
                                              "how far above the equilibrium the line is laid");
}

void add_plant(Keys& keys) {
  KeysOf<&Case::plant> plant(keys, "plant");
  plant.number<&Plant::conductor_mass>("conductor_mass", "kg", positive, "m1");
  plant.number<&Plant::conductor_stiffness>("conductor_stiffness", "N/m", positive, "k1");
  plant.number<&Plant::conductor_damping>("conductor_damping", "N s/m", not_negative, "c1");
  plant.number<&Plant::absorber_mass>("absorber_mass", "kg", positive, "m2");
  plant.number<&Plant::absorber_stiffness>("absorber_stiffness", "N/m", positive, "k2");
  plant.number<&Plant::absorber_damping>("absorber_damping", "N s/m", not_negative, "c2");
}

void add_control(Keys& keys) {
  KeysOf<&Case::control> control(keys, "control");
  CaseKey& gain = control.number<&Control::proportional_gain>(
      "proportional_gain", "N/m", any_number,
      "P; \"tuned\" takes k2 - m2 (2 pi frequency)^2, Eq. 6");
  gain.words = {"tuned"};
  gain.tuned = where<&Case::control, &Control::proportional_gain_tuned>;
  control.number<&Control::differential_gain>("differential_gain", "N s/m", any_number, "D");
  control.number<&Control::sampling_period>("sampling_period", "s", positive,
                                            "time between samples");
  control.number<&Control::processing_delay>(
      "processing_delay", "s", not_negative,
      "from taking a sample to applying its force, up to a period");
  control.number<&Control::displacement_quantum>("displacement_quantum", "m", not_negative,
                                                 "step of the measured displacement; 0: none");
  control.number<&Control::velocity_quantum>("velocity_quantum", "m/s", not_negative,
                                             "step of the measured velocity; 0: none");
  control.word<&Control::velocity>(
      "velocity", {"measured", "difference"},
      "whether the velocity is measured or the difference of two displacements");
  CaseKey& largest_force = control.number<&Control::largest_force>(
      "largest_force", "N", positive,
      "of the drive, at which the command is cut off; \"none\": no limit");
  largest_force.words = {"none"};
  control.number<&Control::jitter>("jitter", "s", not_negative,
                                   "largest deviation of a sampling instant from its place");
  control.number<&Control::jitter_seed>("jitter_seed", "", seed, "of the random sampling instants");
}

void add_backlash(Keys& keys) {
  KeysOf<&Case::backlash> backlash(keys, "backlash");
  backlash.number<&Backlash::width>("width", "m", not_negative, "r0");
  backlash.word<&Backlash::law>("law", {"kollar", "immediate", "play", "dead_zone", "none"},
                                "the rule by which the drive enters and leaves the gap");
  backlash.number<&Backlash::contact_stiffness>("contact_stiffness", "N/m", not_negative,
                                                "of the stops of a dead zone");
  backlash.number<&Backlash::contact_damping>("contact_damping", "N s/m", not_negative,
                                              "of the stops of a dead zone");
}

void add_forces(Keys& keys) {
  KeysOf<&Case::excitation> excitation(keys, "excitation");
  excitation
      .number<&Excitation::amplitude>("amplitude", "N", not_negative,
                                      "of the harmonic force on the conductor")
      .replaced_by_wind = true;
  excitation
      .number<&Excitation::frequency>("frequency", "Hz", positive,
                                      "of the harmonic force on the conductor")
      .replaced_by_wind = true;
  excitation.word<&Excitation::hold>("hold", {"sampled", "exact"},
                                     "whether the force is held over each sample");
  excitation
      .add("harmonics", "[amplitude (N), frequency (Hz), phase (rad)] of each further harmonic")
      .harmonics = where<&Case::excitation, &Excitation::harmonics>;
  excitation.add("record", "CSV file of a further force, columns time_s and force_N").file =
      where<&Case::excitation, &Excitation::record>;
  excitation.word<&Excitation::record_interpolation>("record_interpolation", {"linear", "held"},
                                                     "between the rows of the record");
  excitation.number<&Excitation::noise_rms>("noise_rms", "N", not_negative,
                                            "root mean square of a further random force; 0: none");
  excitation.number<&Excitation::noise_lowest>("noise_lowest", "Hz", positive,
                                               "lower end of the band of the random force");
  excitation.number<&Excitation::noise_highest>("noise_highest", "Hz", positive,
                                                "upper end of the band of the random force");
  excitation.number<&Excitation::noise_lines>(
      "noise_lines", "", some_lines, "number of harmonics that the random force is made of");
  excitation.number<&Excitation::noise_seed>("noise_seed", "", seed,
                                             "of the phases of the random force");
  KeysOf<&Case::wind> wind(keys, "wind");
  wind.number<&Wind::speed>("speed", "m/s", positive, "speed across the conductor").required = true;
  wind.number<&Wind::diameter>("diameter", "m", positive, "of the conductor").required = true;
  wind.number<&Wind::effective_length>("effective_length", "m", positive,
                                       "length over which vortices are shed in step")
      .required = true;
  wind.number<&Wind::strouhal>("strouhal", "", positive, "Strouhal number");
  wind.number<&Wind::lift_coefficient>("lift_coefficient", "", not_negative, "lift coefficient");
  wind.number<&Wind::air_density>("air_density", "kg/m3", positive, "density of the air");
}

void add_initial(Keys& keys) {
  KeysOf<&Case::initial> initial(keys, "initial");
  initial.number<&Initial::z1>("z1", "m", any_number, "displacement of the conductor, downward");
  initial.number<&Initial::v1>("v1", "m/s", any_number, "velocity of the conductor");
  initial.number<&Initial::z2>("z2", "m", any_number, "displacement of the absorber, downward");
  initial.number<&Initial::v2>("v2", "m/s", any_number, "velocity of the absorber");
}

}  // namespace

const std::vector<CaseKey>& case_keys() {
  static const Keys all = [] {
    Keys keys;
    add_cable(keys);
    add_plant(keys);
    add_control(keys);
    add_backlash(keys);
    add_forces(keys);
    add_initial(keys);
    return keys;
  }();
  return all;
}

}  // namespace holdfast::program
