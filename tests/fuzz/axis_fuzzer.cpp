#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>

#include "case/axes/axis.hpp"
#include "fuzz/require.hpp"
#include "process/errors.hpp"

namespace {

using namespace holdfast::program;
using holdfast::fuzz::require;

/// The first, a middle and the last value lie between the ends, in their order.
template <class Points>
void require_between(const Points& axis, double lowest, double highest) {
  const auto last = axis.count - 1;
  const double first = axis.at(0), middle = axis.at(last / 2), end = axis.at(last);
  require(std::isfinite(first) && std::isfinite(middle) && std::isfinite(end),
          "the values of an axis are finite");
  require(first == lowest && (last == 0 || end == highest), "an axis ends at its ends");
  require(first <= middle && middle <= end, "the values of an axis ascend");
}

void require_range(const Range& range) {
  require(std::isfinite(range.min) && std::isfinite(range.max) && range.min <= range.max,
          "a range is finite and ascends");
}

void read_as(unsigned form, const std::string& text) {
  if (form == 0) require_range(parse_range("--p", text));
  if (form == 1) {
    const auto axis = parse_axis("--p", text);
    require_between(axis, axis.min, axis.max);
  }
  if (form == 2) {
    const auto axis = parse_key_axis("--axis", text).axis;
    require_between(axis, axis.min, axis.max);
  }
  if (form == 3) {
    const auto values = parse_key_values("--axis", text).values;
    if (const auto* axis = std::get_if<holdfast::Axis>(&values))
      require_between(*axis, axis->min, axis->max);
    if (const auto* axis = std::get_if<holdfast::LogAxis>(&values))
      require_between(*axis, axis->min, axis->max);
  }
  if (form == 4) require(parse_kick("--kick", text).time >= 0.0, "a kick comes at a time");
  if (form == 5) {
    const WindowOption window = parse_window("--window", text);
    require_range(window.displacement);
    require_range(window.velocity);
  }
  if (form == 6) require(!parse_list("--d", text).empty(), "a list has a number");
}

}  // namespace

/// The first byte chooses the form, the others are its text.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  try {
    read_as(data[0] % 7U, std::string(reinterpret_cast<const char*>(data) + 1, size - 1));
  } catch (const WrongInput& refusal) {
    require(std::string(refusal.what()).find('\n') == std::string::npos, "a refusal is one line");
  }
  return 0;
}
