#include <algorithm>
#include <cmath>

#include "case/axes/axis.hpp"
#include "case/model/span/span_of_case.hpp"
#include "job.hpp"
#include "jobs/span/placement/absorber_demands.hpp"
#include "jobs/span/placement/placed_device.hpp"
#include "jobs/span/placement/stable_gains.hpp"
#include "jobs/span/span_words.hpp"

namespace holdfast::program {
namespace {

/// Number of the device given by the user; 0 for the absorber.
std::size_t device_named(const std::optional<std::string>& word, const Case& the_case) {
  const std::size_t count = the_case.devices.size();
  const bool absorber = word ? *word == "absorber" : count == 0;
  if (absorber) {
    if (has_active_absorber(the_case)) return 0;
    throw WrongInput(word ? "--device absorber: the span has no absorber with a computer; give "
                            "[absorber], plant.absorber_mass or [control]"
                          : "no device is on the span: give [[device]] or [absorber]");
  }
  const std::string text = word.value_or("1");
  const std::optional<double> number = parse_number(text);
  if (number && *number >= 1.0 && *number <= static_cast<double>(count) &&
      *number == std::floor(*number))
    return static_cast<std::size_t>(*number);
  throw WrongInput("--device " + one_line(text) + ": must be " +
                   (count == 0   ? "absorber, as the case has no [[device]]"
                    : count == 1 ? "1, the only [[device]] of the case, or absorber"
                                 : "a number from 1 to " + std::to_string(count) +
                                       ", of a [[device]] of the case, or absorber"));
}

struct PlaceQuestion {
  std::optional<std::string> device, goal, modes, keep, frequency;
  std::optional<double> margin;

  void add_to(const Job& job) {
    job.add("--device", device);
    job.add("--frequency", frequency);
    job.add("--for", goal);
    job.add("--modes", modes);
    job.add("--keep", keep);
    job.add("--margin", margin);
  }

  void read_modes(PlacementQuestion& question) const {
    if (goal == "strain")
      throw WrongInput("--modes works only with --for damping: leave --for strain out");
    const Range range = parse_range("--modes", *modes);
    constexpr double most = 1000.0;
    if (!(range.min >= 1.0) || range.max > most || range.min != std::floor(range.min) ||
        range.max != std::floor(range.max))
      throw WrongInput("--modes " + one_line(*modes) +
                       ": must be FIRST:LAST, whole numbers from 1 to 1000");
    question.goal = PlacementGoal::modes;
    question.first_mode = static_cast<int>(range.min);
    question.last_mode = static_cast<int>(range.max);
  }

  PlacementQuestion question_of(const Case& the_case) const {
    PlacementQuestion question;
    question.device = device_named(device, the_case);
    question.frequencies = aeolian_frequencies(the_case);
    question.frequencies.count = 56;
    if (frequency) question.frequencies = parse_frequencies("--frequency", *frequency);
    constexpr std::int64_t most = 100000;
    if (question.frequencies.count > most)
      throw WrongInput("--frequency " + one_line(*frequency) + ": give at most 100000 frequencies");
    if (goal == "damping") question.goal = PlacementGoal::ratio;
    if (modes) read_modes(question);
    question.moves_position = !question.is_absorber() && !keep;
    question.margin = margin.value_or(question.margin);
    if (margin && !question.is_absorber())
      throw WrongInput("--margin works only for the gains of --device absorber: device " +
                       std::to_string(question.device) + " has none; leave --margin out");
    return question;
  }

  void run(const JobContext& context) const;
};

/// Value of the goal without the absorber, for comparison.
double without_absorber(Case the_case, const PlacementQuestion& question) {
  the_case.plant.absorber_mass = 0.0;
  const PlacementLevels levels(the_case, question);
  const std::vector<double> found = levels.of(the_case);
  return found.empty() ? std::nan("")
                       : levels.value_of(*std::max_element(found.begin(), found.end()));
}

void write_absorber(Table& table, const PlacedDevice& placed, const PlacementQuestion& question,
                    const PlacementLevels& levels) {
  const Case& the_case = placed.the_case;
  const auto row = [&](const std::string& quantity, double value, const char* unit) {
    if (std::isfinite(value)) table.row(quantity, value, std::string(unit));
  };
  row(levels.name() + "_without_absorber", without_absorber(the_case, question),
      levels.unit().c_str());
  const double middle = 0.5 * (levels.frequencies().front() + levels.frequencies().back());
  const PdGains<double> perfect = perfect_gains(the_case, middle);
  const bool known = std::isfinite(perfect.proportional + perfect.differential);
  row("perfect_absorption_frequency", middle, "Hz");
  row("perfect_absorption_proportional_gain", perfect.proportional, "N/m");
  row("perfect_absorption_differential_gain", perfect.differential, "N s/m");
  const StableGains judge(the_case, question.margin);
  row("perfect_absorption_stable", known && judge.is_stable(perfect) ? 1.0 : 0.0, "");
  const AbsorberDemands demands =
      absorber_demands(the_case, levels.frequencies(), placed.worst_frequency);
  constexpr double day = 86400.0;
  row("largest_force", demands.largest_force, "N");
  row("largest_stroke", demands.largest_stroke, "m");
  row("drive_power", demands.drive_power, "W");
  row("energy_per_day", day * demands.drive_power, "J");
  row("judged_modes", judge.judged_modes(), "");
  row("highest_judged_frequency", judge.highest_frequency(), "Hz");
}

void PlaceQuestion::run(const JobContext& context) const {
  require_placement_search();
  const Case& the_case = context.case_data;
  const PlacementQuestion question = question_of(the_case);
  const PlacementLevels levels(the_case, question);
  require_measured(the_case, levels.frequencies().front(), levels.frequencies().back());
  report_warning(absent_absorber_note(the_case), context.quiet);
  Table table(context, columns_of("place"));
  const PlacedDevice placed = placed_device(the_case, question);
  table.row(std::string("position"),
            question.is_absorber() ? placed.the_case.absorber.position
                                   : placed.the_case.devices[question.device - 1].position,
            std::string("m"));
  for (std::size_t k = 0; k < placed.numbers.size(); ++k)
    if (placed.numbers[k].quantity != "position")
      table.row(placed.numbers[k].quantity, placed.numbers[k].sign * placed.found.values[k],
                placed.numbers[k].unit);
  if (std::isfinite(placed.before))
    table.row(levels.name() + "_before", placed.before, levels.unit());
  table.row(levels.name(), placed.after, levels.unit());
  if (question.goal == PlacementGoal::modes)
    table.row(std::string("worst_mode"),
              static_cast<double>(placed.found.worst_at) + question.first_mode, std::string());
  table.row(std::string("worst_frequency"), placed.worst_frequency, std::string("Hz"));
  if (question.is_absorber()) write_absorber(table, placed, question, levels);
  for (const std::string& warning : placement_warnings(placed, question))
    report_warning(warning, context.quiet);
  if (!question.is_absorber())
    report_warning(instability_note(placed.the_case, true), context.quiet);
  table.commit();
}

}  // namespace

void add_place(CLI::App& program) { add_job<PlaceQuestion>(program, "place"); }

}  // namespace holdfast::program
