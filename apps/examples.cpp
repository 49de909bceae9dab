#include <algorithm>

#include "text/compiled_texts.hpp"
#include "texts.hpp"

namespace holdfast::program {
namespace {

const toml::table& texts() {
  static const toml::table parsed = toml::parse(program_texts);
  return parsed;
}

/// Example command lines, each with its purpose.
std::vector<std::pair<std::string, std::string>> known_examples(const std::string& name) {
  std::vector<std::pair<std::string, std::string>> chosen;
  for (const toml::node& node : *texts()["examples"].as_array()) {
    const toml::array& row = *node.as_array();
    if (text_of(row[0]) != name) continue;
    std::string command = name == "holdfast" ? name : "holdfast " + name;
    if (!text_of(row[1]).empty()) command += " " + text_of(row[1]);
    chosen.emplace_back(command, text_of(row[2]));
  }
  return chosen;
}

}  // namespace

std::string program_text(const std::string& name, const Values& values) {
  return text_of(texts()[name], values);
}

std::string examples_of(const std::string& name) {
  constexpr std::size_t longest_with_remark = 56;
  const auto chosen = known_examples(name);
  std::size_t width = 0;
  for (const auto& [command, tells] : chosen)
    if (command.size() <= longest_with_remark) width = std::max(width, command.size());
  std::string text;
  for (const auto& [command, tells] : chosen) {
    std::string line = "  " + command;
    line.resize(std::max(line.size(), width + 2), ' ');
    text += line.append("  # ").append(tells).append("\n");
  }
  return text;
}

std::string ExamplesFirst::make_description(const CLI::App* app) const {
  std::string text = CLI::Formatter::make_description(app);
  const std::string lines = examples_of(app->get_name());
  return lines.empty() ? text : text + "\nExamples:\n" + lines + "\n";
}

}  // namespace holdfast::program
