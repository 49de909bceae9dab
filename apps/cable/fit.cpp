#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string_view>

#include "case/model/cable_of_case.hpp"
#include "case/model/decay/damping_fit.hpp"
#include "case/model/plant_of_case.hpp"
#include "case/model/resolved_plant.hpp"
#include "case/plausibility/quantities.hpp"
#include "holdfast/ceres/decay_fit_options.hpp"
#include "io/file/whole_file.hpp"
#include "io/text/record_file.hpp"
#include "job.hpp"

namespace holdfast::program {
namespace {

/// A parameter that a fit may free, as the case file names it.
struct FitParameter {
  fit::PlantParameter parameter;
  const char* name;  ///< its key in [plant]
  const char* unit;
};

constexpr FitParameter known_parameters[] = {
    {fit::PlantParameter::conductor_mass, "conductor_mass", "kg"},
    {fit::PlantParameter::conductor_stiffness, "conductor_stiffness", "N/m"},
    {fit::PlantParameter::conductor_damping, "conductor_damping", "N s/m"},
    {fit::PlantParameter::absorber_stiffness, "absorber_stiffness", "N/m"},
    {fit::PlantParameter::absorber_damping, "absorber_damping", "N s/m"}};

const FitParameter& parameter_named(std::string_view name) {
  if (name.empty())
    throw WrongInput("--parameters: a name is missing; give names with one comma between them");
  for (const FitParameter& known : known_parameters)
    if (name == known.name) return known;
  throw WrongInput("--parameters: " + one_line(name) +
                   " is not one of conductor_mass, conductor_stiffness, conductor_damping, "
                   "absorber_stiffness, absorber_damping");
}

const FitParameter& description_of(fit::PlantParameter parameter) {
  return known_parameters[static_cast<std::size_t>(parameter)];
}

struct FitQuestion {
  std::optional<std::string> data;
  std::string parameters = "absorber_damping";
  std::optional<std::string> target;
  bool plain = false;

  void add_to(const Job& job) {
    job.add("--data", data);
    job.add("--parameters", parameters);
    job.add("--target", target);
    job.add("--plain", plain);
  }
  void run(const Job& job) const;
};

fit::DecayFitOptions question_of(const FitQuestion& options) {
  fit::DecayFitOptions question;
  question.free.clear();
  for (const std::string_view name : split(options.parameters, ',')) {
    const fit::PlantParameter parameter = parameter_named(trimmed(name)).parameter;
    if (std::count(question.free.begin(), question.free.end(), parameter) > 0)
      throw WrongInput("--parameters: " + one_line(trimmed(name)) + " is given twice");
    question.free.push_back(parameter);
  }
  const std::string target = options.target.value_or("history");
  question.target = target == "history" ? fit::DecayTarget::time_history
                    : target == "peak"  ? fit::DecayTarget::first_peak_and_period
                                        : fit::DecayTarget::first_peak_period_and_decrement;
  const std::size_t most = target == "peak" ? 1 : target == "measures" ? 2 : 5;
  if (question.free.size() > most)
    throw WrongInput("--parameters: --target " + target + " can fit at most " +
                     std::to_string(most) + " parameter(s)");
  question.robust = !options.plain;
  question.fit_initial_displacement = options.data.has_value();
  return question;
}

/// Throws WrongInput where a parameter starts from 0: parameters are fitted by their logarithms,
/// and all but c2 start from the plant's values.
void require_starts(const fit::DecayFitOptions& options, const TwoMass<double>& plant) {
  for (const fit::PlantParameter parameter : options.free) {
    if (parameter == fit::PlantParameter::absorber_damping || parameter_of(plant, parameter) > 0.0)
      continue;
    throw WrongInput(std::string("--parameters: plant.") + description_of(parameter).name +
                     ", from which the fit starts, is 0: give it a value above 0");
  }
}

/// Writes one minimum; keys of the second minimum end in `_minimum_2`, and so on.
void write_minimum(Table& table, const fit::DecayFitOptions& question,
                   const fit::DecayMinimum& minimum, std::size_t rank) {
  const std::string behind = rank == 1 ? "" : "_minimum_" + std::to_string(rank);
  const double none = std::nan("");
  for (std::size_t k = 0; k < question.free.size(); ++k) {
    const FitParameter& what = description_of(question.free[k]);
    table.row(what.name + behind, parameter_of(minimum.plant, question.free[k]),
              minimum.standard_errors[k], what.unit);
  }
  const bool history = question.target == fit::DecayTarget::time_history;
  if (history) table.row("initial_displacement" + behind, minimum.initial_displacement, none, "m");
  table.row("residual" + behind, minimum.residual, none, history ? "m" : "");
}

/// Warning if the rms residual is 30 % or more of the record's first displacement; else empty.
std::string course_warning(const fit::DecayMinimum& best, const DecayRecord& record) {
  const double share = best.residual / std::abs(record.displacements.front());
  if (share < 0.3) return "";
  return "the fitted two-mass plant misses the record by " +
         format_number(std::round(share * 100.0)) + " % (rms) of the record's first displacement";
}

/// Warning that a record exceeding the absorber's reach is probably in millimetres; else empty.
std::string unit_warning(const std::string& file, const DecayRecord& record, const Case& the_case) {
  double largest = 0.0;
  for (const double displacement : record.displacements)
    largest = std::max(largest, std::abs(displacement));
  const double reach = reach_of_absorber(the_case);
  if (largest <= reach) return "";
  return file + ": displacement_m reaches " + format_rounded(largest) +
         " m, but the absorber's place can move by only " + format_rounded(reach) +
         " m: the column must be in m; is it in mm (" + format_rounded(1e-3 * largest) + " m)?";
}

/// Warning if rows are over half a period apart, perhaps in milliseconds; else empty.
std::string time_warning(const std::string& file, const DecayRecord& record,
                         const TwoMass<double>& plant) {
  const double half = pi<double> * std::sqrt(plant.conductor_mass / plant.conductor_stiffness);
  const double usual = usual_step(record.times);
  if (!(usual > half)) return "";
  return file + ": rows are " + format_rounded(usual) + " s apart; the conductor's period is " +
         format_rounded(2.0 * half) + " s: is time_s in ms?";
}

/// Warning of a gap in the record. Throws WrongInput if the target needs all peaks.
std::string gap_warning(const std::string& file, const DecayRecord& record,
                        const fit::DecayFitOptions& question) {
  const std::string gap = gap_text(record.times);
  if (gap.empty()) return "";
  if (fit::is_measured(question.target))
    throw WrongInput(
        file + ": " + gap +
        ": the gap may hide a peak, but this --target needs all peaks; give --target history");
  return file + ": " + gap + "; only the rows of the file are fitted";
}

/// Reads the record of a file, and warns if its unit, its time steps or a gap are doubtful.
DecayRecord record_of(const std::string& file, const JobContext& context,
                      const TwoMass<double>& plant, const fit::DecayFitOptions& question) {
  DecayRecord record = read_decay_file(file);
  for (const std::string& warning :
       {unit_warning(file, record, context.case_data), time_warning(file, record, plant),
        gap_warning(file, record, question)})
    report_warning(warning, context.quiet);
  return record;
}

/// All minima of the fit, which starts from the case's plant, or from the plant reduced from its
/// conductor with c2 = 0; with no options given, the minima of the fit in the job reduce.
std::vector<fit::DecayMinimum> minima_of(const JobContext& context, const FitQuestion& options,
                                         fit::DecayFitOptions& question) {
  const Case& the_case = context.case_data;
  const auto plant =
      plant_is_reduced(the_case) ? plant_without_absorber_damping(the_case) : plant_of(the_case);
  require_starts(question, plant);
  const bool damping_alone = question.free == std::vector{fit::PlantParameter::absorber_damping};
  if (damping_alone && !options.data && !options.target && !options.plain) {
    const AbsorberDampingFit found = fit_absorber_damping(context.case_data, plant);
    question.target = found.target;
    report_warning(misfit_warning(found), context.quiet);
    return found.fit.minima;
  }
  const DecayRecord record = options.data ? record_of(*options.data, context, plant, question)
                                          : record_for_fit(context.case_data);
  const auto minima = fit_record(record, plant, question).minima;
  if (!fit::is_measured(question.target))
    report_warning(course_warning(minima.front(), record), context.quiet);
  return minima;
}

void FitQuestion::run(const Job& job) const {
  require_ceres();
  const JobContext context = job.context();
  fit::DecayFitOptions question = question_of(*this);
  if (data) require_not_overwritten(*data, context.output);
  Table table(context, columns_of("fit"));
  const auto minima = minima_of(context, *this, question);
  for (std::size_t k = 0; k < minima.size(); ++k) write_minimum(table, question, minima[k], k + 1);
  table.commit();
}

}  // namespace

void add_fit(CLI::App& program) { add_job<FitQuestion>(program, "fit"); }

}  // namespace holdfast::program
