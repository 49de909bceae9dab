#include <cmath>

#include "case/case_keys.hpp"
#include "report/figures/figure.hpp"
#include "text/text.hpp"

namespace holdfast::program {
namespace {

/// 1, 2 and 5 times the powers of ten: gnuplot's pictures of cells know no logarithmic axis. The
/// variable tells who measures the panel that its axis counts decades.
std::string tics_of(const std::string& letter, const MapAxis& axis) {
  if (!axis.logarithmic) return "";
  const double lowest = axis.min * axis.scale, highest = axis.max * axis.scale;
  std::string tics;
  for (double power = std::pow(10.0, std::floor(std::log10(lowest))); power <= highest;
       power *= 10.0) {
    for (const double digit : {1.0, 2.0, 5.0}) {
      const double value = digit * power;
      if (value < 0.999 * lowest || value > 1.001 * highest) continue;
      const std::string text = format_rounded(value);
      tics += (tics.empty() ? "'" : ", '") + text + "' log10(" + text + ")";
    }
  }
  return "set " + letter + "tics (" + tics + ")\n" + letter + "_decades = 1\n";
}

}  // namespace

std::string shown_on(const MapAxis& axis, const std::string& value) {
  const std::string shown = value + "*" + format_number(axis.scale);
  return axis.logarithmic ? "log10(" + shown + ")" : shown;
}

Values values_of(const std::string& letter, const MapAxis& axis, const std::string& column) {
  const std::string min = format_number(axis.min), max = format_number(axis.max);
  return {{letter + " axis",
           axis.key + "=" + (axis.logarithmic ? "log:" : "") + min + ":" + max + ":61"},
          {letter + " label", axis.label},
          {letter + " range", shown_on(axis, min) + ":" + shown_on(axis, max)},
          {letter + " tics", tics_of(letter, axis)},
          {letter, shown_on(axis, column)}};
}

std::string label_of(const std::string& key) {
  const std::string label = listed_text("words", "label of " + key);
  if (!label.empty()) return label;
  const CaseKey* known = find_case_key(key);
  if (known == nullptr) return key;
  const std::string name = replaced(known->short_name(), "_", " ");
  return known->unit.empty() ? name : name + " (" + known->unit + ")";
}

double scale_of(const std::string& key) {
  return parse_number(listed_text("words", "scale of " + key)).value_or(1.0);
}

}  // namespace holdfast::program
