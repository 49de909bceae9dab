#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "case/case_file.hpp"
#include "case/case_keys.hpp"
#include "case/model/cable_of_case.hpp"
#include "case/model/loop_of_case.hpp"
#include "holdfast/control/gains.hpp"
#include "holdfast/math/linalg/spectral_radius.hpp"
#include "holdfast/motion/implemented_loop.hpp"
#include "holdfast/plant/natural_modes.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "holdfast/stability/boundary/stable_intervals.hpp"
#include "holdfast/stability/polynomial/characteristic_polynomial.hpp"
#include "io/file/output.hpp"
#include "io/text/table.hpp"
#include "io/text/text.hpp"
#include "job.hpp"
#include "process/errors.hpp"

namespace holdfast::program {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// What follows from the case.
struct Derived {
  const char* name;
  double value;
  const char* unit;
  const char* meaning;
};

using Derivations = std::vector<Derived>;

void add_force(Derivations& derived, const Case& the_case, const TwoMass<double>& plant) {
  const auto excitation = excitation_of(the_case);
  derived.push_back({"force_amplitude", excitation.amplitude, "N",
                     "of the harmonic force, from [excitation] or [wind]"});
  derived.push_back({"force_frequency", excitation.frequency, "Hz", "of the same"});
  const case_tables::Excitation& given = the_case.excitation;
  if (given.noise_rms > 0.0)
    derived.push_back({"noise_period",
                       given.noise_lines / (given.noise_highest - given.noise_lowest), "s",
                       "after it the noise repeats: lines over bandwidth"});
  derived.push_back({"static_displacement", excitation.amplitude / plant.conductor_stiffness, "m",
                     "the force over the conductor's stiffness, F/k1"});
}

void add_gains(Derivations& derived, const Case& the_case, const TwoMass<double>& plant) {
  derived.push_back({"proportional_gain", gains_of(the_case).proportional, "N/m", "P in force"});
  derived.push_back(
      {"tuned_proportional_gain",
       tuned_proportional_gain(plant.absorber_stiffness, plant.absorber_mass,
                               excitation_of(the_case).frequency),
       "N/m", "k2 - m2 (2 pi f)^2, Eq. 6: the absorber's own frequency becomes that of the force"});
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
  derived.push_back({"first_natural_frequency", frequency(0), "Hz",
                     "of conductor and absorber together, without damping and control"});
  derived.push_back({"second_natural_frequency", frequency(1), "Hz", "the same"});
  derived.push_back(
      {"first_damping_ratio", damping(0), "",
       "of the slower mode of the damped plant; nan: one of them does not oscillate"});
  derived.push_back({"second_damping_ratio", damping(1), "", "of the faster one"});
}

void add_clock(Derivations& derived, const Case& the_case) {
  const double period = the_case.control.sampling_period;
  const auto ratio = forcing_ratio(implemented_loop_of(the_case, Switching::sampled).digital);
  derived.push_back({"sampling_rate", 1.0 / period, "Hz", "of the computer"});
  derived.push_back({"samples_per_forcing_period",
                     1.0 / (excitation_of(the_case).frequency * period), "",
                     "below 2 the computer does not see the vibration"});
  derived.push_back(
      {"samples_to_coincidence", ratio ? static_cast<double>(ratio->denominator) : unknown, "",
       "after so many, sampling and forcing are as before: every period is a multiple "
       "of it; nan: never"});
}

void add_stability(Derivations& derived, const Case& the_case) {
  const auto loop = loop_of(the_case);
  const PdGains<double> gains = gains_of(the_case);
  derived.push_back({"spectral_radius", spectral_radius(loop.engaged_map(gains)), "",
                     "of the sampled loop without backlash; stable below 1"});
  const auto stable =
      stable_differential_gains(characteristic_polynomial(loop), gains.proportional);
  double lower = unknown, upper = unknown;
  for (const auto& interval : stable) {
    const bool nearest = interval.lower <= gains.differential || std::isnan(lower);
    if (nearest) lower = interval.lower;
    if (nearest) upper = interval.upper;
  }
  derived.push_back({"stable_from", lower, "N.s/m",
                     "lower end of the stable D at the P in force, about the case's D; nan: none"});
  derived.push_back({"stable_to", upper, "N.s/m", "their upper end"});
}

Derivations derivations_of(const Case& the_case) {
  const TwoMass<double> plant = plant_of(the_case);
  Derivations derived;
  add_force(derived, the_case, plant);
  add_gains(derived, the_case, plant);
  add_modes(derived, plant);
  add_clock(derived, the_case);
  add_stability(derived, the_case);
  return derived;
}

/// "built-in", the file with its line, the option, or what else the value comes from.
std::string origin_of(const CaseKey& key, const Case& the_case) {
  const auto given = the_case.places.find(key.name);
  if (given != the_case.places.end()) return given->second;
  const bool computed =
      (key.name == "reduction.first_frequency" && the_case.first_frequency_computed) ||
      (key.name == "reduction.second_frequency" && the_case.second_frequency_computed) ||
      (key.table() == "plant" && plant_is_reduced(the_case));
  return computed ? "computed from the conductor" : "built-in";
}

/// Every key of the case with its value and where that comes from, then what follows from them.
void write_case_table(const JobContext& context) {
  const Case& the_case = context.case_data;
  Table table(context, {{"key", "", "of the case file, or what follows from the case", "string"},
                        {"value", "", "in the unit beside it", "string"},
                        {"unit", "", "SI", "string"},
                        {"origin", "", "built-in, the file and line, --set, or derived", "string"},
                        {"meaning", "", "with what is admissible", "string"}});
  for (const CaseKey& key : case_keys()) {
    const std::string value = case_value_text(key, the_case);
    if (value.empty()) continue;
    table.row(key.name, value, key.unit, origin_of(key, the_case),
              key.description + "; admissible: " + key.admissible());
  }
  for (const Derived& derived : derivations_of(the_case))
    table.row(derived.name, format_number(derived.value), derived.unit, "derived", derived.meaning);
  table.commit();
}

struct CaseOptions {
  std::optional<std::string> begun;
  std::optional<std::string> checked;
};

/// A case file that is there already is somebody's work.
void write_case_file(const JobContext& context, const std::string& name) {
  if (name != "-" && std::filesystem::exists(name))
    throw WrongInput("--init " + name + ": there is such a file already");
  OutputFile file(name);
  file.write(case_to_toml(context.case_data));
  file.commit();
}

void run(const Job& job, const CaseOptions& options) {
  if (options.begun && options.checked)
    throw WrongInput("--init begins a case file and --check explains one: give one of them");
  const JobContext context = job.context(PlantNeed::whole, options.checked);
  if (options.begun) return write_case_file(context, *options.begun);
  write_case_table(context);
}

}  // namespace

void add_case(CLI::App& program) {
  const Job job(program, "case", question::case_file,
                "Begins a case file, or explains every value of one and what follows from it");
  const auto options = std::make_shared<CaseOptions>();
  job->add_option("--init", options->begun,
                  "Write the case, built-in or --case with --set, as a commented case file")
      ->type_name("FILE");
  job->add_option("--check", options->checked,
                  "Explain this case file: every value, where it comes from, what it means")
      ->type_name("FILE");
  job->final_callback([job, options] { run(job, *options); });
}

}  // namespace holdfast::program
