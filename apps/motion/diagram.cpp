#include <memory>

#include "case/axes/axis.hpp"
#include "case/case_keys.hpp"
#include "case/model/loop_of_case.hpp"
#include "holdfast/phase_space/orbit_diagram.hpp"
#include "io/text/table.hpp"
#include "job.hpp"
#include "motion_options.hpp"
#include "process/errors.hpp"
#include "process/exit.hpp"
#include "process/interrupt.hpp"

namespace holdfast::program {
namespace {

struct DiagramArguments {
  std::string axis = "backlash.width=0:0.003:121";
  DiagramOptions question;
  Switching switching = Switching::sampled;
};

std::vector<double> values_of(const Axis& axis, const std::string& text) {
  constexpr std::int64_t most_values = 1'000'000;
  if (axis.count > most_values)
    throw WrongInput("--axis " + text + ": at most " + std::to_string(most_values) +
                     " values make a diagram");
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(axis.count));
  for (std::int64_t k = 0; k < axis.count; ++k) values.push_back(axis.at(k));
  return values;
}

void run(const JobContext& context, const DiagramArguments& options) {
  const auto [key, axis] = parse_key_axis("--axis", options.axis);
  case_value(context.case_data, key);  // throws where there is no such number
  const std::vector<double> values = values_of(axis, options.axis);
  Table table(context, {{key, "", "the key's value"},
                        {"upward", "", "1: on the way up, 0: on the way back", "integer"},
                        {"z1_m", "m", "displacement of the conductor at a whole forcing period"},
                        {"v1_m_per_s", "m/s", "velocity of the conductor there"},
                        {"z2_m", "m", "displacement of the absorber there"},
                        {"v2_m_per_s", "m/s", "velocity of the absorber there"}});
  DiagramOptions question = options.question;
  question.watch = throw_if_interrupted;
  const auto write = [&](const StrobePoint& point) {
    table.row(values[point.index], point.upward ? 1 : 0, point.state[0], point.state[1],
              point.state[2], point.state[3]);
  };
  const auto path = [&, name = key](double value) {
    return implemented_loop_of(case_with(context.case_data, name, value), options.switching);
  };
  const std::size_t diverged =
      run_orbit_diagram(path, values, initial_state_of(context.case_data), question, write);
  table.commit();
  if (diverged > 0) {
    report_warning(std::to_string(diverged) + " of " + std::to_string(2 * values.size()) +
                       " motions diverge and show nothing",
                   context.quiet);
  }
}

}  // namespace

void add_diagram(CLI::App& program) {
  const Job job(program, "diagram", question::attractor,
                "Orbit diagram: one state a forcing period against a key, up and back");
  const auto options = std::make_shared<DiagramArguments>();
  job.add_text("--axis", options->axis, "KEY=MIN:MAX:COUNT, the key that goes up and back");
  job.add_number("--transient", options->question.transient, "Left out at each value, s", 0.0, 1e9);
  job->add_option("--strobes", options->question.strobes, "Forcing periods shown at each value")
      ->check(CLI::Range(1, 1'000'000))
      ->type_name("")
      ->capture_default_str();
  add_switching(job, options->switching);
  job->final_callback([job, options] { run(job.context(), *options); });
}

}  // namespace holdfast::program
