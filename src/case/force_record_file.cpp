#include "case/force_record_file.hpp"

#include <utility>

#include "io/file/input.hpp"
#include "io/text/time_table.hpp"

namespace holdfast::program {

ForceRecord read_force_text(const std::string& text, const std::string& name) {
  constexpr std::size_t fewest = 2;
  TimeSeries series = TimeTable(text, name).series("force_N", fewest, "a force record");
  return {std::move(series.times), std::move(series.values)};
}

ForceRecord read_force_record(const std::string& path) {
  return read_force_text(read_input(path), path);
}

}  // namespace holdfast::program
