#include <cmath>
#include <filesystem>
#include <limits>
#include <utility>

#include "case/case_file.hpp"
#include "case/case_keys.hpp"
#include "case/device/device_keys.hpp"
#include "case/model/cable_of_case.hpp"
#include "case/model/linear_loop.hpp"
#include "case/model/loop_of_case.hpp"
#include "case/needed.hpp"
#include "holdfast/control/gains.hpp"
#include "holdfast/plant/natural_modes.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "io/file/output.hpp"
#include "job.hpp"
#include "jobs/job_texts.hpp"

namespace holdfast::program {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// Numbers derived from the case, by their names in texts/jobs.toml.
using Derivations = std::vector<std::pair<const char*, double>>;

void add_force(Derivations& derived, const Case& the_case) {
  const auto excitation = excitation_of(the_case);
  derived.emplace_back("force_amplitude", excitation.amplitude);
  derived.emplace_back("force_frequency", excitation.frequency);
  const case_tables::Excitation& given = the_case.excitation;
  if (given.noise_rms > 0.0)
    derived.emplace_back("noise_period",
                         given.noise_lines / (given.noise_highest - given.noise_lowest));
  if (is_two_masses(the_case))
    derived.emplace_back("static_displacement",
                         excitation.amplitude / plant_of(the_case).conductor_stiffness);
}

void add_gains(Derivations& derived, const Case& the_case) {
  derived.emplace_back("proportional_gain", gains_of(the_case).proportional);
  if (!has_absorber(the_case)) return;
  const TwoMass<double> plant = plant_of(the_case);
  derived.emplace_back("tuned_proportional_gain",
                       tuned_proportional_gain(plant.absorber_stiffness, plant.absorber_mass,
                                               excitation_of(the_case).frequency));
}

void add_modes(Derivations& derived, const TwoMass<double>& plant) {
  TwoMass<double> undamped = plant;
  undamped.conductor_damping = undamped.absorber_damping = 0.0;
  const auto free = natural_modes(undamped), damped = natural_modes(plant);
  const auto frequency = [&](std::size_t k) {
    return k < free.size() ? free[k].frequency() : unknown;
  };
  const auto damping = [&](std::size_t k) {
    return damped.size() == 2 ? damped[k].damping_ratio() : unknown;
  };
  derived.emplace_back("first_natural_frequency", frequency(0));
  derived.emplace_back("second_natural_frequency", frequency(1));
  derived.emplace_back("first_damping_ratio", damping(0));
  derived.emplace_back("second_damping_ratio", damping(1));
}

void add_clock(Derivations& derived, const Case& the_case) {
  const double period = sampling_of(the_case).period;
  derived.emplace_back("sampling_rate", 1.0 / period);
  derived.emplace_back("samples_per_forcing_period",
                       1.0 / (excitation_of(the_case).frequency * period));
  const auto ratio = forcing_ratio(implemented_loop_of(the_case, Switching::sampled).digital);
  derived.emplace_back("samples_to_coincidence",
                       ratio ? static_cast<double>(ratio->denominator) : unknown);
}

void add_stability(Derivations& derived, const Case& the_case) {
  const PdGains<double> gains = gains_of(the_case);
  const LinearLoop loop(the_case);
  derived.emplace_back("spectral_radius", loop.radius(gains));
  double lower = unknown, upper = unknown;
  for (const auto& interval : loop.stable_gains(FreeGain::differential, gains)) {
    const bool nearest = interval.lower <= gains.differential || std::isnan(lower);
    if (nearest) lower = interval.lower;
    if (nearest) upper = interval.upper;
  }
  derived.emplace_back("stable_from", lower);
  derived.emplace_back("stable_to", upper);
}

Derivations derivations_of(const Case& the_case) {
  const bool masses = is_two_masses(the_case);
  Derivations derived;
  // A derivation is left out where the case lacks something for it.
  const auto add_if = [&](bool is_asked, const auto& add) {
    if (!is_asked) return;
    try {
      add();
    } catch (const MissingKeys&) {
    }
  };
  add_if(true, [&] { add_force(derived, the_case); });
  add_if(true, [&] { add_gains(derived, the_case); });
  add_if(masses, [&] { add_modes(derived, plant_of(the_case)); });
  add_if(true, [&] { add_clock(derived, the_case); });
  add_if(has_absorber(the_case), [&] { add_stability(derived, the_case); });
  return derived;
}

/// The other key for the absorber's mass, if its value is used for this key too; else empty.
std::string other_absorber_mass(const std::string& key, const Case& the_case) {
  const std::string other = key == "absorber.mass"         ? "plant.absorber_mass"
                            : key == "plant.absorber_mass" ? "absorber.mass"
                                                           : "";
  const bool stands = the_case.stands_alone || !is_two_masses(the_case);
  return stands && the_case.is_given(other) ? other : "";
}

bool is_computed(const CaseKey& key, const Case& the_case) {
  return (key.name == "wind.diameter") ||
         (key.name == "reduction.first_frequency" && the_case.first_frequency_computed) ||
         (key.name == "reduction.second_frequency" && the_case.second_frequency_computed) ||
         (key.table() == "plant" && !key.beyond_two_masses && is_two_masses(the_case) &&
          plant_is_reduced(the_case));
}

/// Origin of a key's value: the file with its line, the option, "built-in", "default" or other.
std::string origin_of(const CaseKey& key, const Case& the_case) {
  const auto given = the_case.places.find(key.name);
  if (given != the_case.places.end()) return given->second;
  if (is_from_library(the_case, key.name)) return "conductor library";
  if (is_absent(the_case, key)) return "not given";
  if (key.name == "conductor.sag" && std::isfinite(the_case.conductor.tension))
    return "follows from conductor.tension";
  const std::string other = other_absorber_mass(key.name, the_case);
  if (!other.empty()) return "follows from " + other;
  if (is_computed(key, the_case)) return "computed from the conductor";
  return the_case.stands_alone ? "default" : "built-in";
}

void add_devices(Table& table, const Case& the_case) {
  for (std::size_t k = 0; k < the_case.devices.size(); ++k) {
    const case_tables::Device& device = the_case.devices[k];
    for (const DeviceKey* key : standing_keys(device)) {
      const std::string name = device_key_text(k + 1, key->name);
      const auto given = the_case.places.find(name);
      table.row(name, device_value_text(*key, device), key->unit,
                given == the_case.places.end() ? "default" : given->second,
                key->description + "; admissible: " + key->admissible());
    }
  }
}

/// Writes every key of the case with value and origin, then the numbers derived from them.
void write_case_table(const JobContext& context) {
  const Case& the_case = context.case_data;
  Table table(context, columns_of("case"));
  for (const CaseKey& key : case_keys()) {
    const std::string value = case_value_text(key, the_case);
    if (value.empty() && !is_absent(the_case, key)) continue;
    table.row(key.name, value, key.unit, origin_of(key, the_case),
              key.description + "; admissible: " + key.admissible());
  }
  add_devices(table, the_case);
  for (const auto& [name, value] : derivations_of(the_case)) {
    const toml::array& texts = *job_texts()["derived"][name].as_array();
    table.row(name, format_number(value), text_of(texts[0]), "derived", text_of(texts[1]));
  }
  table.commit();
}

/// Writes the case file; throws WrongInput if the file exists.
void write_case_file(const Case& the_case, const std::string& name, CaseForm form) {
  if (name == "--help" || name == "-h")
    throw WrongInput("--init " + name + ": give the file's name right after --init");
  if (name != "-" && std::filesystem::exists(name))
    throw WrongInput("--init " + name + ": this file exists already; give another name");
  OutputFile file(name);
  file.write(case_to_begin_with(the_case, form));
  file.commit();
}

struct CaseQuestion {
  std::optional<std::string> begun, checked, from;
  bool wind = false;

  void add_to(const Job& job) {
    job.add("--init", begun);
    job.add("--check", checked);
    job.add("--from", from);
    job.add("--wind", wind);
  }

  void run(const Job& job) const {
    if (begun && checked)
      throw WrongInput("--init writes a case file and --check explains one: give only one of them");
    if (!begun && (from || wind))
      throw WrongInput(std::string(from ? "--from" : "--wind") +
                       " works only with --init: add --init FILE");
    const JobContext context = job.context(checked);
    if (!begun) return write_case_table(context);
    Case the_case = context.case_data;
    if (wind && !the_case.wind) the_case.wind = wind_for(the_case);
    const bool by_plant =
        from ? *from == "plant" : the_case.plant_given && !plant_is_reduced(the_case);
    write_case_file(the_case, *begun, by_plant ? CaseForm::plant : CaseForm::conductor);
  }
};

}  // namespace

void add_case(CLI::App& program) { add_job<CaseQuestion>(program, "case"); }

}  // namespace holdfast::program
