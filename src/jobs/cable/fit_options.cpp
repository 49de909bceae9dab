#include "jobs/cable/fit_options.hpp"

#include <algorithm>
#include <cstddef>
#include <string_view>

#include "io/text/text.hpp"
#include "process/errors.hpp"

namespace holdfast::program {
namespace {

constexpr FitParameter known_parameters[] = {
    {fit::PlantParameter::conductor_mass, "conductor_mass", "kg"},
    {fit::PlantParameter::conductor_stiffness, "conductor_stiffness", "N/m"},
    {fit::PlantParameter::conductor_damping, "conductor_damping", "N s/m"},
    {fit::PlantParameter::absorber_stiffness, "absorber_stiffness", "N/m"},
    {fit::PlantParameter::absorber_damping, "absorber_damping", "N s/m"}};

const FitParameter& parameter_named(std::string_view name) {
  if (name.empty()) throw WrongInput("--parameters: a name is missing");
  for (const FitParameter& known : known_parameters)
    if (name == known.name) return known;
  throw WrongInput("--parameters: " + one_line(name) +
                   " is none of conductor_mass, conductor_stiffness, conductor_damping, "
                   "absorber_stiffness, absorber_damping");
}

}  // namespace

const FitParameter& description_of(fit::PlantParameter parameter) {
  return known_parameters[static_cast<std::size_t>(parameter)];
}

fit::DecayFitOptions fit_options(const std::string& parameters, const std::string& target) {
  fit::DecayFitOptions options;
  options.free.clear();
  for (const std::string_view name : split(parameters, ',')) {
    const fit::PlantParameter parameter = parameter_named(trimmed(name)).parameter;
    if (std::count(options.free.begin(), options.free.end(), parameter) > 0)
      throw WrongInput("--parameters: " + one_line(trimmed(name)) + " stands there twice");
    options.free.push_back(parameter);
  }
  options.target = target == "history" ? fit::DecayTarget::time_history
                   : target == "peak"  ? fit::DecayTarget::first_peak_and_period
                                       : fit::DecayTarget::first_peak_period_and_decrement;
  const std::size_t most = target == "peak" ? 1 : target == "measures" ? 2 : 5;
  if (options.free.size() > most)
    throw WrongInput("--parameters: --target " + target + " determines " + std::to_string(most) +
                     " of them at most");
  return options;
}

void require_starts(const fit::DecayFitOptions& options, const TwoMass<double>& plant) {
  for (const fit::PlantParameter parameter : options.free) {
    if (parameter == fit::PlantParameter::absorber_damping || parameter_of(plant, parameter) > 0.0)
      continue;
    throw WrongInput(std::string("--parameters: the fit starts from plant.") +
                     description_of(parameter).name + ", which is 0; admissible is greater than 0");
  }
}

}  // namespace holdfast::program
