// What the same answers cost in C++ alone: a chart into arrays, a motion into arrays of the columns
// of `simulate`. A line of JSON a repetition, seconds.
//
//     holdfast_python_bench chart|radius|simulate COUNT REPETITIONS

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "case/case_source.hpp"
#include "case/model/loop_of_case.hpp"
#include "case/model/resolved_plant.hpp"
#include "jobs/charts/chart_rows.hpp"
#include "jobs/motion/case_motion.hpp"
#include "jobs/motion/motion_digits.hpp"
#include "jobs/motion/motion_run.hpp"

namespace {

using namespace holdfast;
using namespace holdfast::program;

using Clock = std::chrono::steady_clock;

JobContext context_of_builtin_case() {
  JobContext context;
  context.job = "stability";
  context.case_data = CaseSource{}.load();
  settle_plant(context.case_data);
  context.instructions = best_instruction_set();
  return context;
}

/// @return a number of the result, so that nothing is left out
double chart(const JobContext& context, std::int64_t count, bool radius) {
  const GainGrid grid{{-1000.0, 200.0, count}, {-40.0, 20.0, count}};
  const auto cells = static_cast<std::size_t>(count * count);
  const std::unique_ptr<std::uint8_t[]> stable(new std::uint8_t[cells]);
  const std::unique_ptr<double[]> radii(radius ? new double[cells] : nullptr);
  fill_chart(context.case_data, grid, {stable.get(), radii.get()}, {0, context.instructions});
  return stable[cells / 2];
}

/// The columns of `simulate`, and the digits that it vouches for where they are asked for.
double simulate(const JobContext& context, std::int64_t samples, bool with_digits) {
  std::vector<double> columns[6];
  std::vector<std::int64_t> in_backlash;
  for (std::vector<double>& column : columns) column.reserve(static_cast<std::size_t>(samples));
  in_backlash.reserve(static_cast<std::size_t>(samples));
  auto digits = with_digits ? digits_beside(context.case_data, {}, {}, 0.0) : std::nullopt;
  CaseMotion motion(context.case_data, {});
  run_to_completion(motion, samples, {}, [&](const EventSample& sample) {
    if (digits) (*digits)(sample);
    columns[0].push_back(sample.time);
    for (int i = 0; i < 4; ++i) columns[i + 1].push_back(sample.state[i]);
    columns[5].push_back(sample.control_force);
    in_backlash.push_back(sample.mode == ContactMode::engaged ? 0 : 1);
  });
  return columns[1].back();
}

}  // namespace

int main(int argument_count, char** arguments) {
  if (argument_count != 4) return 2;
  const std::string what = arguments[1];
  const std::int64_t count = std::atoll(arguments[2]);
  const JobContext context = context_of_builtin_case();
  double sum = 0.0;
  for (int k = 0; k < std::atoi(arguments[3]); ++k) {
    const auto begin = Clock::now();
    if (what == "simulate" || what == "motion")
      sum += simulate(context, count, what == "simulate");
    else
      sum += chart(context, count, what == "radius");
    std::printf("%.9f\n", std::chrono::duration<double>(Clock::now() - begin).count());
  }
  return sum == 0.123 ? 1 : 0;
}
