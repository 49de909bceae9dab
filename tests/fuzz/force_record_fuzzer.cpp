#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

#include "fuzz/require.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/excitation/recorded_force.hpp"
#include "io/text/record_file.hpp"
#include "process/errors.hpp"

namespace {

using holdfast::RecordedForce;
using holdfast::RecordInterpolation;
using holdfast::fuzz::require;

/// The force at the rows and between them.
void ask(const RecordedForce& force) {
  const auto& times = force.times();
  for (std::size_t row = 0; row + 1 < times.size(); ++row) {
    const double middle = times[row] + (times[row + 1] - times[row]) / 2.0;
    require(std::isfinite(force.at(times[row])), "a recorded force is finite at its rows");
    require(std::isfinite(force.at(middle)), "a recorded force is finite between its rows");
    require(force.next_break(times[row]) == times[row + 1], "a row ends at the next");
  }
  require(force.at(force.last_time()) == 0.0, "a recorded force ends with its last row");
}

}  // namespace

/// Any text as a force record, read in both ways between its rows.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  try {
    const auto record = holdfast::program::read_force_text(text, "fuzz.csv");
    ask(RecordedForce(record.times, record.forces, RecordInterpolation::held));
    ask(RecordedForce(record.times, record.forces, RecordInterpolation::linear));
  } catch (const holdfast::program::WrongInput& refusal) {
    require(std::string(refusal.what()).find('\n') == std::string::npos, "a refusal is one line");
  } catch (const holdfast::InvalidParameter&) {
    // Rows too far apart for their difference, or too close for their slope.
  }
  return 0;
}
