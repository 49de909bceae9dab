#include "texts.hpp"

#include <string_view>

#include "case/case_file.hpp"
#include "case/case_keys.hpp"
#include "case/device/device_keys.hpp"
#include "holdfast/core/version.hpp"
#include "job.hpp"

namespace holdfast::program {
namespace {

/// Text with roff's escapes and leading requests neutralised.
std::string roff(std::string_view text) {
  std::string safe;
  bool begins_line = true;
  for (const char character : text) {
    const bool request = begins_line && (character == '.' || character == '\'');
    if (request) safe += "\\&";
    if (character == '\\')
      safe += "\\e";
    else if (character == '-')
      safe += "\\-";
    else
      safe += character;
    begins_line = character == '\n';
  }
  return safe;
}

std::string item(const std::string& term, const std::string& text) {
  return ".TP\n" + term + "\n" + roff(text) + "\n";
}

std::string bold(const std::string& text) { return "\\fB" + roff(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + roff(text) + "\\fR"; }

std::string item_of(const CLI::Option& option) {
  std::string term = bold(option.get_name(false, true));
  if (option.get_expected_max() > 0 && option.get_type_size() > 0)
    term += " " + italic(option.get_type_name());
  std::string text = option.get_description();
  if (!option.get_default_str().empty()) text += " (default: " + option.get_default_str() + ")";
  return item(term, text + ".");
}

std::string options_of(const CLI::App& job, bool of_every_job) {
  std::string text;
  for (const CLI::Option* option : job.get_options()) {
    const bool shown = option->get_name() != "--help" && !option->get_group().empty();
    const bool is_general = option->get_group() == question::every_job;
    if (shown && is_general == of_every_job) text += item_of(*option);
  }
  return text;
}

std::string text_of_jobs(const CLI::App& program) {
  std::string text, question;
  for (const CLI::App* job : program.get_subcommands(nullptr)) {
    if (job->get_group() != question) text += ".SS \"" + roff(question = job->get_group()) + "\"\n";
    text += ".PP\n" + bold("holdfast " + job->get_name()) + "\n.RS\n" +
            roff(job->get_description()) + ".\n" + options_of(*job, false) + ".RE\n";
  }
  return text;
}

std::string text_of_key(const std::string& name, const std::string& unit,
                        const std::string& meaning) {
  return item(bold(name) + (unit.empty() ? "" : " (" + roff(unit) + ")"), meaning);
}

std::string text_of_device_keys() {
  std::string text = ".SS \"[[device]]\"\n";
  for (const DeviceKey& key : device_keys())
    text += text_of_key(key.name, key.unit,
                        key.description + ". Admissible: " + key.admissible() + ".");
  return text;
}

std::string text_of_keys() {
  std::string text, table;
  for (const CaseKey& key : case_keys()) {
    if (key.table() != table) text += ".SS \"[" + roff(table = key.table()) + "]\"\n";
    std::string meaning = key.description + ". Admissible: " + key.admissible() + ".";
    const std::string value = case_default(key);
    if (!value.empty()) meaning += " Default: " + value + ".";
    text += text_of_key(key.short_name(), key.unit, meaning);
  }
  return text + text_of_device_keys();
}

}  // namespace

std::string manual_page(const CLI::App& program) {
  return program_text("manual", {{"version", std::string(version_string)},
                                 {"examples", roff(examples_of("holdfast"))},
                                 {"jobs", text_of_jobs(program)},
                                 {"options", options_of(*program.get_subcommand("simulate"), true)},
                                 {"keys", text_of_keys()}});
}

}  // namespace holdfast::program
