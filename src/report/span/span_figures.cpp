#include "report/figures/figure.hpp"

#include <algorithm>
#include <cmath>

#include "case/model/modal/conductor_modes.hpp"
#include "case/model/span/span_of_case.hpp"
#include "holdfast/span/end_response.hpp"
#include "jobs/span/span_words.hpp"
#include "text/text.hpp"

namespace holdfast::program {
namespace {

/// As many modes as vibrate in the wind, twenty at least, and no more than are soon found.
std::int64_t modes_shown(const Case& the_case, const Axis& frequencies) {
  const TautString<double> string = string_of(the_case);
  const double lowest = string.wave_speed() / (2.0 * string.span);
  return static_cast<std::int64_t>(std::clamp(std::ceil(frequencies.max / lowest), 20.0, 200.0));
}

}  // namespace

std::string frequencies_text(const Axis& axis) {
  return format_rounded(axis.min) + ":" + format_rounded(axis.max) + ":" +
         std::to_string(axis.count);
}

Values span_values(const Case& the_case) {
  return {{"diameter", format_number(the_case.conductor.diameter)}};
}

std::vector<Figure> span_figures(const Case& the_case) {
  const Axis axis = aeolian_frequencies(the_case);
  const std::string range = format_rounded(axis.min) + ":" + format_rounded(axis.max);
  const Values values =
      joined(span_values(the_case), {{"frequencies", frequencies_text(axis)},
                                     {"frequency range", range},
                                     {"modes", std::to_string(modes_shown(the_case, axis))}});
  std::vector<Figure> figures = listed_figures("span vibration", values);
  const auto devices = span_devices_of(the_case);
  const auto ends = span_ends(devices, the_case.conductor.span);
  if (!ends[0].devices.empty())
    figures = joined(std::move(figures), listed_figures("span left end", values));
  if (!ends[1].devices.empty())
    figures = joined(std::move(figures), listed_figures("span right end", values));
  if (ends[0].devices.empty() && ends[1].devices.empty())
    figures = joined(std::move(figures), listed_figures("span without devices", values));
  return joined(std::move(figures), listed_figures("span life", values));
}

}  // namespace holdfast::program
