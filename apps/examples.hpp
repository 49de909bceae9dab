#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace holdfast::program {

/// Command lines to begin with, each with what it tells, of the whole program ("holdfast") or of
/// one job; empty where there are none.
std::string examples_of(const std::string& name);

/// Help that leads with examples.
class ExamplesFirst : public CLI::Formatter {
 public:
  std::string make_description(const CLI::App* app) const override;
};

}  // namespace holdfast::program
