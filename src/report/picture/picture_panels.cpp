#include "report/picture/picture_panels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string_view>

#include "report/figures/figure.hpp"
#include "text/text.hpp"

namespace holdfast::program {
namespace {

/// The text with every digit replaced by an index digit: "12" becomes "₁₂".
std::string lowered(const std::string& index) {
  constexpr std::array<const char*, 10> indices = {"₀", "₁", "₂", "₃", "₄",
                                                   "₅", "₆", "₇", "₈", "₉"};
  std::string text;
  for (const char character : index) {
    const bool is_digit = character >= '0' && character <= '9';
    text +=
        is_digit ? indices[static_cast<std::size_t>(character - '0')] : std::string(1, character);
  }
  return text;
}

/// The index of a gnuplot label that begins at `at`, after "_": text in braces, or one character.
std::string index_at(const std::string& label, std::size_t at) {
  if (label[at] != '{') return label.substr(at, 1);
  return label.substr(at, label.find('}', at) + 1 - at);
}

/// The label without braces and without the fonts named in them.
std::string without_braces(const std::string& label) {
  std::string text;
  for (std::size_t at = 0; at < label.size(); ++at) {
    const bool opens = label[at] == '{';
    if (opens && label.compare(at, 2, "{/") == 0) at = std::min(label.find(' ', at), label.size());
    if (!opens && label[at] != '}') text += label[at];
  }
  return text;
}

constexpr std::string_view of_panel = "panel ", of_logarithms = "logscaling on ";

/// The numbers after the word "panel" in a line of gnuplot; empty if one is not a number.
std::vector<double> numbers_of(std::string_view line) {
  std::vector<double> numbers;
  for (const std::string& word : words_of(std::string(line.substr(of_panel.size())))) {
    const auto number = parse_number(word);
    if (!number) return {};
    numbers.push_back(*number);
  }
  return numbers;
}

/// Axis from its ends; with `decades` the ends are decimal logarithms of the values.
PanelAxis axis_of(double from, double to, bool decades) {
  if (!decades) return {"", "", from, to, false};
  return {"", "", std::pow(10.0, from), std::pow(10.0, to), true};
}

/// Panel from the numbers that `measure` of texts/figures.toml prints, with heights from below.
PicturePanel panel_of(const std::vector<double>& described) {
  return {described[0],
          1.0 - described[3],
          described[1],
          1.0 - described[2],
          axis_of(described[4], described[5], described[10] != 0.0),
          axis_of(described[6], described[7], described[11] != 0.0),
          axis_of(described[8], described[9], false)};
}

/// Splits a label such as "displacement (mm)" into name and unit of an axis.
void name_axis(PanelAxis& axis, const std::string& label) {
  const std::size_t unit = label.rfind(" (");
  const bool has_unit = unit != std::string::npos && label.back() == ')';
  axis.name = label.substr(0, has_unit ? unit : std::string::npos);
  if (has_unit) axis.unit = label.substr(unit + 2, label.size() - unit - 3);
}

/// Reads axis labels and logarithmic scales from a line of gnuplot's messages into the panel.
void tell(PicturePanel& panel, std::string_view line) {
  if (begins_with(line, of_logarithms)) {
    panel.x.logarithmic |= line.find(" x") != std::string_view::npos;
    panel.y.logarithmic |= line.find(" y") != std::string_view::npos;
  }
  const std::array<std::pair<const char*, PanelAxis*>, 3> axes = {
      {{"xlabel is \"", &panel.x},
       {"ylabel is \"", &panel.y},
       {"y2label is \"", &panel.right_axis}}};
  for (const auto& [beginning, axis] : axes) {
    const std::size_t end = line.find("\", offset");
    const std::size_t begin = std::string_view(beginning).size();
    if (!begins_with(line, beginning) || end == std::string_view::npos) continue;
    name_axis(*axis, plain_label(std::string(line.substr(begin, end - begin))));
  }
}

bool is_of_panels(std::string_view line) {
  return begins_with(line, of_panel) || begins_with(line, of_logarithms) ||
         line.find("label is \"") != std::string_view::npos;
}

void take_name(PanelAxis& axis, const PanelAxis& other) {
  if (!axis.name.empty()) return;
  axis.name = other.name;
  axis.unit = other.unit;
}

bool same(double one, double other) { return std::abs(one - other) < 1e-3; }

/// Gives axes without label the label of a panel above, below or beside that shares the axis.
void share_names(std::vector<PicturePanel>& panels) {
  for (PicturePanel& panel : panels) {
    for (const PicturePanel& other : panels) {
      if (same(panel.left, other.left) && same(panel.right, other.right))
        take_name(panel.x, other.x);
      if (same(panel.top, other.top) && same(panel.bottom, other.bottom))
        take_name(panel.y, other.y);
    }
    // gnuplot gives an axis that is not there ends at the edge of the numbers; without a unit it
    // shows words.
    const PanelAxis& right = panel.right_axis;
    if (right.unit.empty() || !(right.from < right.to)) panel.right_axis = {};
  }
}

using Json = nlohmann::ordered_json;

/// Rounds a fraction of the picture's size to 10⁻⁵, less than a pixel.
double of_picture(double part) { return std::round(1e5 * part) / 1e5; }

void add_axis(Json& panel, const char* which, const PanelAxis& axis) {
  if (axis.name.empty()) return;
  panel[which] = {{"name", axis.name}, {"from", axis.from}, {"to", axis.to}};
  if (!axis.unit.empty()) panel[which]["unit"] = axis.unit;
  if (axis.logarithmic) panel[which]["log"] = true;
}

}  // namespace

std::string with_measured_panels(const std::string& plot) {
  std::string text;
  bool in_plot = false;
  for (const std::string_view line : split(plot, '\n')) {
    in_plot |= begins_with(line, "plot ");
    text += std::string(line) + "\n";
    if (!in_plot || (!line.empty() && line.back() == '\\')) continue;
    text += listed_text("measured");
    in_plot = false;
  }
  text.pop_back();
  return text;
}

std::vector<PicturePanel> measured_panels(const std::string& messages) {
  std::vector<PicturePanel> panels;
  for (const std::string_view line : split(messages, '\n')) {
    if (begins_with(line, of_panel)) {
      const std::vector<double> described = numbers_of(line);
      if (described.size() == 12) panels.push_back(panel_of(described));
    } else if (!panels.empty()) {
      tell(panels.back(), trimmed(line));
    }
  }
  share_names(panels);
  return panels;
}

std::string without_panels(const std::string& messages) {
  std::string others;
  for (const std::string_view line : split(messages, '\n'))
    if (!trimmed(line).empty() && !is_of_panels(trimmed(line))) others += std::string(line) + "\n";
  return others;
}

std::string plain_label(const std::string& label) {
  std::string text;
  for (std::size_t at = 0; at < label.size(); ++at) {
    if (label[at] != '_' || at + 1 == label.size()) {
      text += label[at];
      continue;
    }
    const std::string index = index_at(label, at + 1);
    text += lowered(index);
    at += index.size();
  }
  return without_braces(replaced(text, "\u00a0", " "));
}

std::string panels_json(const std::vector<PicturePanel>& panels) {
  Json list = Json::array();
  for (const PicturePanel& panel : panels) {
    Json described;
    described["box"] = {of_picture(panel.left), of_picture(panel.top), of_picture(panel.right),
                        of_picture(panel.bottom)};
    add_axis(described, "x", panel.x);
    add_axis(described, "y", panel.y);
    add_axis(described, "right", panel.right_axis);
    list.push_back(std::move(described));
  }
  return list.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace holdfast::program
