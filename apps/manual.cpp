#include "texts.hpp"

#include <string_view>

#include "case/case_file.hpp"
#include "case/case_keys.hpp"
#include "holdfast/core/version.hpp"
#include "io/text/text.hpp"

namespace holdfast::program {
namespace {

/// Text that roff takes as it is: no escapes, no requests at the beginning of a line.
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

std::string heading(const std::string& title) { return ".SH " + title + "\n"; }

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

bool is_of_every_job(const CLI::Option& option) { return option.get_group() == "Every job"; }

std::string options_of(const CLI::App& job, bool of_every_job) {
  std::string text;
  for (const CLI::Option* option : job.get_options()) {
    const bool shown = option->get_name() != "--help" && !option->get_group().empty();
    if (shown && is_of_every_job(*option) == of_every_job) text += item_of(*option);
  }
  return text;
}

std::string jobs_section(const CLI::App& program) {
  std::string text = heading("JOBS");
  std::string question;
  for (const CLI::App* job : program.get_subcommands(nullptr)) {
    if (job->get_group() != question) text += ".SS \"" + roff(question = job->get_group()) + "\"\n";
    text += ".PP\n" + bold("holdfast " + job->get_name()) + "\n.RS\n" +
            roff(job->get_description()) + ".\n" + options_of(*job, false) + ".RE\n";
  }
  return text;
}

std::string case_section() {
  std::string text = heading("CASE FILE") +
                     "TOML, SI units. Every key may be left out: the built-in case stands in, and "
                     "of [wind] only what has a default.\n";
  std::string table;
  for (const CaseKey& key : case_keys()) {
    if (key.table() != table) text += ".SS \"[" + roff(table = key.table()) + "]\"\n";
    std::string meaning = key.description + ". Admissible: " + key.admissible() + ".";
    const std::string value = case_default(key);
    if (!value.empty()) meaning += " Default: " + value + ".";
    text += item(bold(key.short_name()) + (key.unit.empty() ? "" : " (" + roff(key.unit) + ")"),
                 meaning);
  }
  return text;
}

std::string closing_sections() {
  return heading("EXIT STATUS") + item("0", "Done.") +
         item("1", "The computation has no answer; standard error says why.") +
         item("2", "Wrong input; one line on standard error says which and what is admissible.") +
         item("130", "Interrupted.") + heading("OUTPUT") +
         roff(
             "Tables are CSV (RFC 4180) with a header row and the shortest digits that read back "
             "the same. A named file appears whole or not at all, and beside it "
             "FILE-metadata.json with columns, units, the full case, options and version. Text "
             "has no colour, whatever NO_COLOR says.") +
         "\n" + heading("SEE ALSO") +
         roff(
             "L. E. Kollár, Dynamics of digitally controlled forced vibration of suspended "
             "cables, Nonlinear Dynamics, 2022.") +
         "\n";
}

}  // namespace

std::string manual_page(const CLI::App& program, const std::string& examples) {
  const std::string version(version_string);
  return ".TH HOLDFAST 1 \"\" \"holdfast " + version + "\" \"User Commands\"\n" + heading("NAME") +
         "holdfast \\- suspended cables under digital vibration control\n" + heading("SYNOPSIS") +
         bold("holdfast") + " " + italic("JOB") + " [" + italic("options") + "]\n" +
         heading("DESCRIPTION") +
         roff(
             "A motor-driven absorber hangs on a conductor and pushes back. Its computer samples, "
             "so the force comes late; its belt has backlash, so the force sometimes does not "
             "come at all. holdfast says which gains are stable, how slow the computer may be, "
             "how much play the belt may have, and what kind of motion results.") +
         "\n" + heading("EXAMPLES") + ".nf\n" + roff(examples) + ".fi\n" + jobs_section(program) +
         heading("OPTIONS OF EVERY JOB") + options_of(*program.get_subcommand("simulate"), true) +
         case_section() + closing_sections();
}

}  // namespace holdfast::program
