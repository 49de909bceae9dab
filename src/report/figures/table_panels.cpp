#include "report/figures/figure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "jobs/columns.hpp"
#include "text/text.hpp"

namespace holdfast::program {
namespace {

/// The column of a job's table with this name, with unit and words; without them if not known.
CellColumn known_column(const std::string& name) {
  for (const char* list :
       {"sweep metrics", "sampled stability", "continuous stability", "response"})
    for (const CellColumn& column : cell_columns_of(list))
      if (column.column.name == name) return column;
  return {{name, "", ""}};
}

/// The absolute values of a column's finite nonzero numbers, ascending.
std::vector<double> magnitudes(const CsvTable& table, const std::string& name) {
  std::vector<double> values;
  for (const double value : table.numbers(name))
    if (std::isfinite(value) && value != 0.0) values.push_back(std::abs(value));
  std::sort(values.begin(), values.end());
  return values;
}

/// Upper end of the colour scale, at most 30 medians; "*" for the largest value if that is less.
std::string limit_of(const std::vector<double>& magnitudes, double scale) {
  constexpr double most = 30.0;  // medians
  if (magnitudes.empty()) return "*";
  const double limit = most * magnitudes[magnitudes.size() / 2];
  return magnitudes.back() > limit ? replaced(rounded(limit * scale, 2), "−", "-") : "*";
}

/// gnuplot's expression for the number of a word of a column.
std::string number_of_word(const std::vector<std::string>& words, const std::string& column) {
  std::string expression;
  for (std::size_t k = 0; k < words.size(); ++k)
    expression += "strcol(" + column + ") eq '" + words[k] + "' ? " + std::to_string(k) + " : ";
  return expression + "NaN";
}

/// gnuplot's tics for words: 'computed' 0, 'no gain' 1.
std::string tics_of(const std::vector<std::string>& words) {
  std::string tics;
  for (std::size_t k = 0; k < words.size(); ++k)
    tics += (k == 0 ? "'" : ", '") + replaced(words[k], "_", " ") + "' " + std::to_string(k);
  return tics;
}

/// Label of a column with its unit: "steady peak (mm)".
std::string column_label(const Column& column, const LengthUnit& unit) {
  const bool is_length = column.unit == "m";
  std::string name = column.name;
  if (is_length && name.size() > 2 && name.compare(name.size() - 2, 2, "_m") == 0)
    name.resize(name.size() - 2);
  const std::string shown = is_length ? unit.name : replaced(column.unit, ".", " ");
  return replaced(name, "_", " ") + (shown.empty() ? "" : " (" + shown + ")");
}

/// Shades for words, distinguishable with all kinds of colour vision.
std::string shades_of(std::size_t words) {
  constexpr std::array<const char*, 7> colours = {"#e6e6e6", "#56b4e9", "#e69f00", "#009e73",
                                                  "#f0e442", "#d55e00", "#0072b2"};
  std::string shades;
  for (std::size_t k = 0; k < std::min(words, colours.size()); ++k)
    shades += (k == 0 ? "" : ", ") + std::to_string(k) + " '" + colours[k] + "'";
  return shades;
}

Values panel_of_words(const CellColumn& column, const std::string& place, std::size_t axes) {
  const bool is_number = column.column.datatype == "integer";
  return {{"value", is_number ? "$" + place : number_of_word(column.words, place)},
          {"words", tics_of(column.words)},
          {"last", std::to_string(column.words.size() - 1)},
          {"shades", shades_of(column.words.size())},
          {"style", "points pt 7 ps 0.5 lc rgb '#0072b2'"},
          {"beyond", ""},
          {"limits", axes == 2 ? "@words on shades@" : "@words on ordinate@"}};
}

Values panel_of_numbers(const CsvTable& table, const CellColumn& column, const std::string& place,
                        const LengthUnit& unit, std::size_t axes) {
  const double scale = column.column.unit == "m" ? unit.per_metre : 1.0;
  const std::string limit = limit_of(magnitudes(table, column.column.name), scale);
  return {{"value", "$" + place + "*" + format_number(scale)},
          {"limit", limit},
          {"beyond", limit == "*" ? "" : "@more is not told apart@"},
          {"style", "linespoints ls 1 pt 7 ps 0.4"},
          {"limits", axes == 2 ? "@numbers on shades@" : "@numbers on ordinate@"}};
}

}  // namespace

double largest_length(const CsvTable& table) {
  double largest = 0.0;
  for (const std::string& name : table.names()) {
    const bool is_length =
        name == "z1_m" || name == "z2_m" || known_column(name).column.unit == "m";
    if (!is_length) continue;
    const std::vector<double> lengths = magnitudes(table, name);
    // The upper quartile counts, since some may diverge.
    if (!lengths.empty()) largest = std::max(largest, lengths[lengths.size() * 3 / 4]);
  }
  return largest;
}

std::vector<Values> panels_of(const CsvTable& table, std::size_t axes, const LengthUnit& unit) {
  std::vector<Values> panels;
  for (std::size_t k = axes; k < table.names().size(); ++k) {
    const CellColumn column = known_column(table.names()[k]);
    const std::string place = std::to_string(k + 1);
    const Values panel = column.words.empty() ? panel_of_numbers(table, column, place, unit, axes)
                                              : panel_of_words(column, place, axes);
    panels.push_back(joined(panel, {{"name", column_label(column.column, unit)}}));
  }
  return panels;
}

}  // namespace holdfast::program
