#include "io/text/decay_file.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "io/file/input.hpp"
#include "io/text/text.hpp"
#include "io/text/time_table.hpp"

namespace holdfast::program {
namespace {

void refuse_gaps(const TimeTable& table, const std::vector<double>& times) {
  std::vector<double> steps;
  for (std::size_t k = 1; k < times.size(); ++k) steps.push_back(times[k] - times[k - 1]);
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  const double usual = *middle;
  for (std::size_t row = 1; row < times.size(); ++row) {
    const double step = times[row] - times[row - 1];
    if (step <= 1.5 * usual) continue;
    throw table.fault(row, "a gap of " + format_rounded(step) +
                               " s before this row, where the rows usually are " +
                               format_rounded(usual) + " s apart");
  }
}

}  // namespace

DecayRecord read_decay_text(const std::string& text, const std::string& name) {
  constexpr std::size_t fewest = 8;
  const TimeTable table(text, name);
  TimeSeries series = table.series("displacement_m", fewest, "a decay record");
  if (series.values.front() == 0.0)
    throw table.fault(0, "displacement_m = 0: the decay must start displaced");
  refuse_gaps(table, series.times);
  return {std::move(series.times), std::move(series.values)};
}

DecayRecord read_decay_file(const std::filesystem::path& file) {
  return read_decay_text(read_input(file), file.string());
}

}  // namespace holdfast::program
