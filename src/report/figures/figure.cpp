#include "report/figures/figure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "case/case_keys.hpp"
#include "text/text.hpp"

namespace holdfast::program {
namespace {

const toml::table& texts() {
  static const toml::table parsed = toml::parse(figures_texts);
  return parsed;
}

/// The text with every @KEY@ replaced, also each @KEY@ inside the replacing values.
std::string resolved(std::string text, const Values& values) {
  for (std::string before; before != text;) {
    before = text;
    text = filled(text, values);
  }
  return text;
}

/// Adds tables to a figure; each entry of `tables` has the suffix of its name and its command.
void add_tables(Figure& figure, const toml::array* tables, const Values& values) {
  if (tables == nullptr) return;
  for (const toml::node& node : *tables) {
    const toml::array& table = *node.as_array();
    figure.tables.push_back({figure.name + resolved(text_of(table[0]), values),
                             words_of(resolved(text_of(table[1]), values))});
  }
}

/// Figure of a row in texts/figures.toml. @param panels  panels in addition to those of the row
Figure figure_of(const toml::array& row, const Values& others, std::vector<Values> panels) {
  if (row.size() > 5)
    for (const toml::node& panel : *row[5].as_array())
      panels.push_back(values_of(*panel.as_table()));
  Figure figure;
  figure.name = text_of(row[0]);
  figure.title = text_of(row[3]);
  figure.caption = text_of(row[4]);
  const Values values = joined(values_of(*row[2].as_table()), others);
  return figure_of_kind(std::move(figure), text_of(row[1]), nullptr, values, panels);
}

bool is_plain(const std::string& argument) {
  constexpr const char* plain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_=.,:/+@%";
  return !argument.empty() && argument.find_first_not_of(plain) == std::string::npos;
}

std::string quoted(const std::string& argument) {
  return "'" + replaced(argument, "'", "'\\''") + "'";
}

/// Tics at 1, 2 and 5 times powers of ten, since gnuplot's images have no logarithmic axis. They
/// set a gnuplot variable, which tells the measurement of panels that the axis counts decades.
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

Values values_of(const toml::table& table) {
  Values values;
  for (const auto& [key, value] : table) values.emplace_back(key.str(), text_of(value));
  return values;
}

std::vector<std::string> words_of(const std::string& command) {
  std::vector<std::string> words;
  for (const std::string_view word : split(command, ' '))
    if (!word.empty()) words.emplace_back(word);
  return words;
}

std::vector<std::string> command_of(const std::vector<std::string>& arguments,
                                    const std::vector<std::string>& case_arguments) {
  std::vector<std::string> command = {arguments.front()};
  command.insert(command.end(), case_arguments.begin(), case_arguments.end());
  command.insert(command.end(), arguments.begin() + 1, arguments.end());
  return command;
}

std::string shell_text(const std::vector<std::string>& arguments,
                       const std::vector<std::string>& case_arguments) {
  std::string text = "holdfast";
  for (const std::string& argument : command_of(arguments, case_arguments))
    text += " " + (is_plain(argument) ? argument : quoted(argument));
  return text;
}

std::string rounded(double value, int digits) {
  char text[40];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  if (std::isinf(value)) return value > 0 ? "∞" : "−∞";
  return replaced(text, "-", "−");
}

double rounded_up(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)));
  return std::ceil(1.02 * value / unit) * unit;
}

LengthUnit length_unit_for(double length) {
  constexpr std::array<LengthUnit, 3> units = {{{"mm", 1e3}, {"µm", 1e6}, {"nm", 1e9}}};
  const auto fits = [length](const LengthUnit& unit) { return length * unit.per_metre >= 0.1; };
  const auto* const found = std::find_if(units.begin(), units.end(), fits);
  if (found != units.end()) return *found;
  return length > 0.0 ? units.back() : units.front();  // the latter: nothing moves
}

std::vector<Figure> listed_figures(const std::string& list, const Values& values,
                                   const std::vector<Values>& panels) {
  std::vector<Figure> figures;
  for (const toml::node& row : *texts()[list].as_array())
    figures.push_back(figure_of(*row.as_array(), values, panels));
  return figures;
}

Figure figure_of_kind(Figure figure, const std::string& kind_name, const toml::array* tables,
                      const Values& given, const std::vector<Values>& panels) {
  const auto kind = texts()["kind"][kind_name];
  const Values values = joined(given, values_of(*texts()["words"].as_table()));
  figure.title = resolved(figure.title, values);
  figure.caption = resolved(figure.caption, values);
  figure.plot = resolved(text_of(kind["plot"]), values);
  figure.height = kind["height"].value<double>().value();
  add_tables(figure, tables != nullptr ? tables : kind["tables"].as_array(), values);
  for (std::size_t k = 0; k < panels.size(); ++k) {
    const Values of_panel = joined(joined({{"k", std::to_string(k + 1)}}, panels[k]), values);
    figure.plot += resolved(text_of(kind["panel"]), of_panel);
    add_tables(figure, kind["panel_tables"].as_array(), of_panel);
  }
  if (!panels.empty()) figure.plot += "unset multiplot\n";
  return figure;
}

std::string listed_text(const std::string& name) { return texts()[name].value_or(std::string()); }

std::string listed_text(const std::string& table, const std::string& name) {
  return texts()[table][name].value_or(std::string());
}

const toml::array& listed_pictures() { return *texts()["pictures"].as_array(); }

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
