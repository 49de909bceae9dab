#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "text/text.hpp"

namespace holdfast::program {

/// The text of texts/program.toml, which is compiled in, with its values.
std::string program_text(const std::string& name, const Values& values);

/// Command lines to begin with, each with what it tells, of the whole program ("holdfast") or of
/// one job; empty where there are none.
std::string examples_of(const std::string& name);

/// Help that leads with examples.
class ExamplesFirst : public CLI::Formatter {
 public:
  std::string make_description(const CLI::App* app) const override;
};

/// "case", "reduce", …, in the order of the help.
std::vector<std::string> job_names(const CLI::App& program);

/// Completion of the program's command lines for a shell, from the same options as `--help`: jobs,
/// their options, the words that an option takes, the keys of a case, names of files.
std::string bash_completion(const CLI::App& program);
std::string zsh_completion(const CLI::App& program);

/// The manual page of the program (roff, section 1), from the same options and case keys as
/// `--help` and the case file.
std::string manual_page(const CLI::App& program);

}  // namespace holdfast::program
