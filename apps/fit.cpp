#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "axis.hpp"
#include "cable_of_case.hpp"
#include "damping_fit.hpp"
#include "decay_file.hpp"
#include "errors.hpp"
#include "exit.hpp"
#include "job.hpp"
#include "loop_of_case.hpp"
#include "table.hpp"
#include "text.hpp"

namespace holdfast::program {
namespace {

struct Options {
  std::optional<std::string> data;
  std::string parameters = "absorber_damping";
  std::optional<std::string> target;
  bool plain = false;
};

struct Named {
  fit::PlantParameter parameter;
  const char* name;
  const char* unit;
};
constexpr Named known_parameters[] = {
    {fit::PlantParameter::conductor_mass, "conductor_mass", "kg"},
    {fit::PlantParameter::conductor_stiffness, "conductor_stiffness", "N/m"},
    {fit::PlantParameter::conductor_damping, "conductor_damping", "N s/m"},
    {fit::PlantParameter::absorber_stiffness, "absorber_stiffness", "N/m"},
    {fit::PlantParameter::absorber_damping, "absorber_damping", "N s/m"}};

const Named& parameter_named(std::string_view name) {
  if (name.empty()) throw WrongInput("--parameters: a name is missing");
  for (const Named& known : known_parameters)
    if (name == known.name) return known;
  throw WrongInput("--parameters: " + one_line(name) +
                   " is none of conductor_mass, conductor_stiffness, conductor_damping, "
                   "absorber_stiffness, absorber_damping");
}

const Named& description_of(fit::PlantParameter parameter) {
  return known_parameters[static_cast<std::size_t>(parameter)];
}

fit::DecayQuestion question_of(const Options& options) {
  fit::DecayQuestion question;
  question.free.clear();
  for (const std::string_view name : split(options.parameters, ',')) {
    const fit::PlantParameter parameter = parameter_named(trimmed(name)).parameter;
    if (std::count(question.free.begin(), question.free.end(), parameter) > 0)
      throw WrongInput("--parameters: " + one_line(trimmed(name)) + " stands there twice");
    question.free.push_back(parameter);
  }
  const std::string target = options.target.value_or("history");
  question.target = target == "history" ? fit::DecayTarget::time_history
                    : target == "peak"  ? fit::DecayTarget::first_peak_and_period
                                        : fit::DecayTarget::first_peak_period_and_decrement;
  const std::size_t most = target == "peak" ? 1 : target == "measures" ? 2 : 5;
  if (question.free.size() > most)
    throw WrongInput("--parameters: --target " + target + " determines " + std::to_string(most) +
                     " of them at most");
  question.robust = !options.plain;
  question.fit_initial_displacement = options.data.has_value();
  return question;
}

/// Quantities of the deepest minimum bear their key's name; those of the next, `_minimum_2` behind.
void write_minimum(Table& table, const fit::DecayQuestion& question,
                   const fit::DecayMinimum& minimum, std::size_t rank) {
  const std::string behind = rank == 1 ? "" : "_minimum_" + std::to_string(rank);
  const double none = std::nan("");
  for (std::size_t k = 0; k < question.free.size(); ++k) {
    const Named& what = description_of(question.free[k]);
    table.row(what.name + behind, parameter_of(minimum.plant, question.free[k]),
              minimum.standard_errors[k], what.unit);
  }
  const bool history = question.target == fit::DecayTarget::time_history;
  if (history) table.row("initial_displacement" + behind, minimum.initial_displacement, none, "m");
  table.row("residual" + behind, minimum.residual, none, history ? "m" : "");
}

/// Where a fit starts: the case's plant, or what its conductor reduces to with c2 still open.
TwoDof<double> start_of(const Case& the_case) {
  if (the_case.plant_given || !the_case.conductor_given) return plant_of(the_case);
  return plant_without_absorber_damping(the_case);
}

/// Parameters are fitted by their logarithms: but for c2 the plant's values are where they start.
void require_starts(const fit::DecayQuestion& question, const TwoDof<double>& plant) {
  for (const fit::PlantParameter parameter : question.free) {
    if (parameter == fit::PlantParameter::absorber_damping || parameter_of(plant, parameter) > 0.0)
      continue;
    throw WrongInput(std::string("--parameters: the fit starts from plant.") +
                     description_of(parameter).name + ", which is 0; admissible is greater than 0");
  }
}

/// All minima; where nothing but the case is given, those of `reduce`.
std::vector<fit::DecayMinimum> minima_of(const JobContext& context, const Options& options,
                                         fit::DecayQuestion& question) {
  const TwoDof<double> plant = start_of(context.case_data);
  require_starts(question, plant);
  const bool damping_alone = question.free == std::vector{fit::PlantParameter::absorber_damping};
  if (damping_alone && !options.data && !options.target && !options.plain) {
    const AbsorberDampingFit found = fit_absorber_damping(context.case_data, plant);
    question.target = found.target;
    report_warning(misfit_warning(found), context.quiet);
    return found.fit.minima;
  }
  const DecayRecord record =
      options.data ? read_decay_file(*options.data) : record_for_fit(context.case_data);
  return fit_record(record, plant, question).minima;
}

void run(const JobContext& context, const Options& options) {
  fit::DecayQuestion question = question_of(options);
  Table table(
      context,
      {{"quantity", "", "key of the case file; residual: root mean square", "string"},
       {"value", "", "in the unit beside it"},
       {"standard_error", "",
        "same unit: from the scatter about the history; of measures, from their misfit or 1 "
        "% of each"},
       {"unit", "", "SI; none: relative", "string"}});
  const auto minima = minima_of(context, options, question);
  for (std::size_t k = 0; k < minima.size(); ++k) write_minimum(table, question, minima[k], k + 1);
  table.commit();
}

}  // namespace

void add_fit(CLI::App& program) {
  const Job job(program, "fit", question::cable,
                "Damping of the absorber (or more) from a decay record");
  const auto options = std::make_shared<Options>();
  job->add_option("--data", options->data,
                  "CSV file with columns time_s,displacement_m; without it the continuous cable of "
                  "the case")
      ->type_name("FILE");
  job.add_text("--parameters", options->parameters, "Keys of [plant] to be fitted, between commas");
  job->add_option("--target", options->target,
                  "What is met: history, peak (first peak and period), measures (and logarithmic "
                  "decrement); default: history, but for absorber_damping alone without --data "
                  "peak where the plant meets it to a tenth")
      ->check(CLI::IsMember({"history", "peak", "measures"}))
      ->type_name("");
  job->add_flag("--plain", options->plain, "Least squares, without the robust loss");
  job->final_callback([job, options] {
    require_ceres();
    run(job.context(PlantNeed::none), *options);
  });
}

}  // namespace holdfast::program
