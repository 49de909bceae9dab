#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "text/text.hpp"

namespace holdfast::program {

/// Text of texts/program.toml by its name, with values for its @KEY@.
std::string program_text(const std::string& name, const Values& values);

/// Example command lines with their purpose, of the whole program ("holdfast") or of one job; empty
/// where there are none.
std::string examples_of(const std::string& name);

/// Help formatter that shows examples first.
class ExamplesFirst : public CLI::Formatter {
 public:
  std::string make_description(const CLI::App* app) const override;
};

/// Names of the jobs, "case", "reduce", …, in the order of the help.
std::vector<std::string> job_names(const CLI::App& program);

/// Completion script of a shell for the program's command lines, from the same options as `--help`:
/// jobs, options, words of an option, keys of a case, file names.
std::string bash_completion(const CLI::App& program);
std::string zsh_completion(const CLI::App& program);

/// The manual page of the program (roff, section 1), from the same options and case keys as
/// `--help` and the case file.
std::string manual_page(const CLI::App& program);

}  // namespace holdfast::program
