#include "output/grid/grid_attributes.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>

#include "case/case_file.hpp"
#include "output/metadata.hpp"
#include "text/text.hpp"

namespace holdfast::program {
namespace {

/// The options as a JSON object, as in the metadata beside a CSV file.
std::string options_text(const JobContext& context) {
  const auto options = table_metadata(context, {}, "")["notes"][0]["holdfast"]["options"];
  return options.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

/// History attribute of the file (CF 2.6.2): version and command.
std::string history_of(const JobContext& context) {
  std::string text = "holdfast " + computed_by(context) + ": holdfast " + context.job;
  const auto append = [&text](const std::string& option, const std::string& value) {
    text += " " + option;
    if (value != "true") text += " '" + replaced(value, "'", "'\\''") + "'";  // else a flag
  };
  if (context.case_source.text) append("--case", context.case_source.name);
  for (const std::string& override : context.case_source.overrides) append("--set", override);
  for (const auto& [option, value] : context.options) append(option, value);
  return text;
}

void append_long_name(Attributes& attributes, const Column& column) {
  if (!column.description.empty()) attributes.emplace_back("long_name", column.description);
}

// Wider instruction sets fuse multiply-adds, and irregular motions depend on the last digit.
constexpr const char* irregular_motions =
    "Cells of regular motions agree to rounding with all instruction sets; a cell with a chaotic "
    "or undecided motion (metric verdict) may differ with another set";

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

}  // namespace

Attributes origin_attributes(const JobContext& context) {
  Attributes attributes = {{"Conventions", "CF-1.10"},
                           {"title", "holdfast " + context.job},
                           {"source", "holdfast " + computed_by(context)},
                           {"history", history_of(context)},
                           {"options", options_text(context)}};
  if (context.on_packs)
    attributes.emplace_back("instructions", std::string(name_of(context.instructions)));
  if (context.job == "sweep" || context.job == "basins")
    attributes.emplace_back("comment", irregular_motions);
  attributes.emplace_back("case", case_to_toml(context.case_data));
  return attributes;
}

Attributes axis_attributes(const Column& column) {
  Attributes attributes;
  append_long_name(attributes, column);
  attributes.emplace_back("units", udunits(column.unit));
  if (cf_name(column.name) != column.name) attributes.emplace_back("key", column.name);
  return attributes;
}

Attributes column_attributes(const CellColumn& column) {
  Attributes attributes;
  if (column.words.empty())
    attributes.emplace_back("units", udunits(column.column.unit));
  else
    attributes.emplace_back("flag_meanings", joined(column.words));
  append_long_name(attributes, column.column);
  return attributes;
}

std::string cf_name(const std::string& name) { return replaced(name, ".", "_"); }

std::string udunits(const std::string& unit) {
  std::string text;
  bool divided = false;
  for (const std::string_view quotient : split(unit, '/')) {
    for (const std::string_view factor : split(quotient, '.')) {
      if (factor.empty() || factor == "1") continue;
      const bool has_power = factor.find_first_of("0123456789") != std::string_view::npos;
      const std::size_t letters = std::min(factor.find_first_of("0123456789"), factor.size());
      text += (text.empty() ? "" : " ") + std::string(factor.substr(0, letters));
      if (divided) text += '-';
      if (has_power) text += factor.substr(letters);
      if (divided && !has_power) text += '1';
    }
    divided = true;
  }
  return text.empty() ? "1" : text;
}

}  // namespace holdfast::program
