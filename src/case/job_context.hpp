#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "case/case.hpp"
#include "case/case_source.hpp"
#include "kernels/instruction_set.hpp"
#include "process/progress.hpp"

namespace holdfast::program {

/// Question to a job: everything that its result depends on, and how to show it.
struct JobContext {
  std::string job;      // "stability"
  std::string version;  // of the program that computed the numbers; empty: this one
  Case case_data;
  CaseSource case_source;  // of case_data, for a job that needs variants of it
  /// Options that the user gave and that shape the result, name and text: {"--p", "-600:0:41"}.
  std::vector<std::pair<std::string, std::string>> options;
  std::optional<std::filesystem::path> output;  // none or "-": standard output
  std::vector<std::string> doubts;              // what of the case is not plausible, a line each
  std::string plant_remark;                     // what is to be known of the reduced plant
  std::vector<std::pair<std::string, std::string>> notes;  // of the numbers, for the metadata
  bool quiet = false;
  bool progress = false;  // even where standard error is no terminal
  bool yes = false;       // a table as large as it becomes is meant
  int threads = 0;        // 0: all
  int zarr_format = 3;    // of a store, 2 or 3
  bool on_packs = false;  // the job computes on packs: its metadata name the instruction set
  InstructionSet instructions = InstructionSet::baseline;  // of the packs
};

inline bool progress_wanted(const JobContext& context) {
  return progress_wanted(context.quiet, context.progress);
}

/// The version of the program that computed what is written.
inline std::string computed_by(const JobContext& context) {
  return context.version.empty() ? HOLDFAST_VERSION : context.version;
}

}  // namespace holdfast::program
