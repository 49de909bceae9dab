#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

#include "case/device/impedance_table.hpp"
#include "fuzz/require.hpp"
#include "process/errors.hpp"

/// Any text as a table of impedance: it is refused in one line, or each row is one of a passive
/// device, in the order of the frequencies.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using holdfast::fuzz::require;
  const std::string text(reinterpret_cast<const char*>(data), size);
  try {
    const auto table = holdfast::program::read_impedance_text(text, "fuzz.csv");
    const std::size_t rows = table.frequency.size();
    require(rows >= 2 && table.magnitude.size() == rows && table.phase_deg.size() == rows,
            "every column has every row");
    for (std::size_t row = 0; row < rows; ++row) {
      const double before = row == 0 ? 0.0 : table.frequency[row - 1];
      require(std::isfinite(table.frequency[row]) && table.frequency[row] > before,
              "frequencies ascend from above 0");
      require(table.magnitude[row] >= 0.0 && std::abs(table.phase_deg[row]) <= 360.0,
              "magnitude and phase are within their ranges");
    }
  } catch (const holdfast::program::WrongInput& refusal) {
    const std::string line = refusal.what();
    require(line.rfind("fuzz.csv:", 0) == 0, "a refusal names the file");
    require(line.find('\n') == std::string::npos, "a refusal is one line");
  }
  return 0;
}
