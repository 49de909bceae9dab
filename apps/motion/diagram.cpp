#include "case/axes/axis.hpp"
#include "case/case_keys.hpp"
#include "case/model/loop_of_case.hpp"
#include "case/model/modal/modes_warning.hpp"
#include "case/model/moving_loop.hpp"
#include "holdfast/phase_space/orbit_diagram.hpp"
#include "job.hpp"

namespace holdfast::program {
namespace {

std::vector<double> values_of(const Axis& axis, const std::string& text) {
  constexpr std::int64_t most_values = 1'000'000;
  if (axis.count > most_values)
    throw WrongInput("--axis " + text + ": give at most " + std::to_string(most_values) +
                     " values");
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(axis.count));
  for (std::int64_t k = 0; k < axis.count; ++k) values.push_back(axis.at(k));
  return values;
}

struct DiagramQuestion {
  std::string axis = "backlash.width=0:0.003:121";
  DiagramOptions question;
  Switching switching = Switching::sampled;

  void add_to(const Job& job) {
    job.add("--axis", axis);
    job.add("--transient", question.transient);
    job.add("--strobes", question.strobes);
    job.add("--switching", switching);
  }

  /// Writes the points of the case's motions along a key. @return number of diverging motions
  template <class Write>
  std::size_t run_diagram(const JobContext& context, const std::string& key,
                          const std::vector<double>& values, const DiagramOptions& options,
                          const Write& write) const {
    const auto case_at = [&](double value) { return case_with(context.case_data, key, value); };
    const bool masses = is_of_masses(motion_kind_of(context.case_data, switching));
    bool sampled = true;  // at all values
    for (const double value : values) {
      const Case there = case_at(value);
      const MotionKind kind = motion_kind_of(there, switching);
      sampled = sampled && is_sampled(kind);
      if (is_of_masses(kind) != masses)
        throw WrongInput("--axis " + axis + ": some values have " +
                         modal_words(masses ? there : context.case_data) +
                         ", the others do not: give a range where all or none have it");
    }
    report_warning(dense_work_warning(context.case_data, switching), context.quiet);
    const auto diagram_of = [&](const auto& moving_at) {
      return run_orbit_diagram([&](double value) { return moving_at(value).loop; }, values,
                               [&](double value) { return moving_at(value).state; }, options,
                               write);
    };
    if (!masses && sampled)
      return diagram_of([&](double value) {
        return std::get<SampledModes>(moving_loop_of(case_at(value), {switching}));
      });
    return std::visit(
        [&](const auto& first) {
          using Moving = std::decay_t<decltype(first)>;
          return diagram_of([&](double value) {
            return std::get<Moving>(built_loop_of(case_at(value), {switching}));
          });
        },
        built_loop_of(case_at(values.front()), {switching}));
  }

  void run(const JobContext& context) const {
    const auto [key, range] = parse_key_axis("--axis", axis);
    case_value(context.case_data, key);  // throws where there is no such number
    const std::vector<double> values = values_of(range, axis);
    Table table(context, columns_of("diagram", {{"key", key}}));
    const double seconds =
        question.transient + question.strobes / excitation_of(context.case_data).frequency;
    require_bearable(2.0 * static_cast<double>(values.size()) * seconds /
                     context.case_data.control.sampling_period);
    DiagramOptions watched = question;
    watched.watch = throw_if_interrupted;
    const auto write = [&](const StrobePoint& point) {
      table.row(values[point.index], point.upward ? 1 : 0, point.state[0], point.state[1],
                point.state[2], point.state[3]);
    };
    const std::size_t diverged = run_diagram(context, key, values, watched, write);
    table.commit();
    if (diverged > 0) {
      report_warning(std::to_string(diverged) + " of " + std::to_string(2 * values.size()) +
                         " motions diverge and are left out",
                     context.quiet);
    }
  }
};

}  // namespace

void add_diagram(CLI::App& program) { add_job<DiagramQuestion>(program, "diagram"); }

}  // namespace holdfast::program
