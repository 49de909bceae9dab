#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "case/case_source.hpp"
#include "host/job_host.hpp"
#include "job.hpp"

namespace holdfast::tests {

/// The table of a job in memory, and what it warned of.
struct AnswerInMemory {
  program::ReceivedTable table;
  std::vector<std::string> warnings;

  program::ReceivedColumn& column(const std::string& name) {
    for (program::ReceivedColumn& one : table.columns)
      if (one.about().name == name) return one;
    throw std::logic_error("no column " + name);
  }
  std::vector<double>& numbers(const std::string& name) { return column(name).numbers(); }
  std::string word(const std::string& name, std::size_t row) {
    return column(name).words()[static_cast<std::size_t>(column(name).whole_numbers()[row])];
  }
};

/// @param text  of the case file; empty: the built-in case
inline AnswerInMemory answer_of(const std::vector<std::string>& job, const std::string& text,
                                const std::vector<std::string>& settings = {}) {
  program::JobHost host;
  host.source = std::make_shared<program::CaseSource>();
  if (!text.empty()) host.source->text = text;
  host.source->name = "case.toml";
  host.source->overrides = settings;
  {
    const program::HostScope here(host);
    program::do_job(job);
  }
  return {std::move(host.tables.front()), host.warnings};
}

}  // namespace holdfast::tests
