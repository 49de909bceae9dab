#include <cmath>
#include <optional>

#include "axis.hpp"
#include "cable_of_case.hpp"
#include "damping_fit.hpp"
#include "decay_file.hpp"
#include "errors.hpp"
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
  for (const Named& known : known_parameters)
    if (name == known.name) return known;
  throw WrongInput("--parameters: " + one_line(name) +
                   " is none of conductor_mass, conductor_stiffness, conductor_damping, "
                   "absorber_stiffness, absorber_damping");
}

const Named& description_of(fit::PlantParameter parameter) {
  return known_parameters[static_cast<std::size_t>(parameter)];
}

double value_in(const TwoDof<double>& plant, fit::PlantParameter parameter) {
  switch (parameter) {
    case fit::PlantParameter::conductor_mass:
      return plant.conductor_mass;
    case fit::PlantParameter::conductor_stiffness:
      return plant.conductor_stiffness;
    case fit::PlantParameter::conductor_damping:
      return plant.conductor_damping;
    case fit::PlantParameter::absorber_stiffness:
      return plant.absorber_stiffness;
    case fit::PlantParameter::absorber_damping:
      break;
  }
  return plant.absorber_damping;
}

fit::DecayQuestion question_of(const Options& options) {
  fit::DecayQuestion question;
  question.free.clear();
  for (const std::string_view name : split(options.parameters, ','))
    question.free.push_back(parameter_named(trimmed(name)).parameter);
  const std::string target = options.target.value_or(options.data ? "history" : "peak");
  question.target = target == "history" ? fit::DecayTarget::time_history
                    : target == "peak"  ? fit::DecayTarget::first_peak_and_period
                                        : fit::DecayTarget::first_peak_period_and_decrement;
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
    table.row(what.name + behind, value_in(minimum.plant, question.free[k]),
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

void run(const JobContext& context, const Options& options) {
  const fit::DecayQuestion question = question_of(options);
  Table table(context,
              {{"quantity", "", "key of the case file; residual: root mean square", "string"},
               {"value", "", "in the unit beside it"},
               {"standard_error", "", "from the scatter about the fit, same unit"},
               {"unit", "", "SI; none: relative", "string"}});
  const DecayRecord record =
      options.data ? read_decay_file(*options.data) : record_for_fit(context.case_data);
  const auto minima = fit_record(record, start_of(context.case_data), question).minima;
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
                  "decrement); default: history with --data, else peak")
      ->check(CLI::IsMember({"history", "peak", "measures"}))
      ->type_name("");
  job->add_flag("--plain", options->plain, "Least squares, without the robust loss");
  job->final_callback([job, options] {
    require_ceres();
    run(job.context(PlantNeed::none), *options);
  });
}

}  // namespace holdfast::program
