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

/// Input of a job: all that its result depends on, and the options of its output.
struct JobContext {
  std::string job;      // name of the job: "stability"
  std::string version;  // of the program that computed the numbers; empty: this one
  Case case_data;
  CaseSource case_source;  // of case_data, for a job that needs variants of it
  /// Options that the user gave and that shape the result, name and text: {"--p", "-600:0:41"}.
  std::vector<std::pair<std::string, std::string>> options;
  std::optional<std::filesystem::path> output;  // none or "-": standard output
  std::vector<std::string> doubts;              // implausible values of the case, a line each
  std::string plant_remark;                     // remark on the reduced plant; empty: none
  std::vector<std::pair<std::string, std::string>> notes;  // name and text, for metadata
  bool quiet = false;
  bool progress = false;  // show it even if standard error is no terminal
  bool yes = false;       // write a table even if it is very large
  int threads = 0;        // 0: all
  bool on_packs = false;  // the job computes on SIMD packs: its metadata name the instruction set
  InstructionSet instructions = InstructionSet::baseline;  // of the SIMD packs
};

inline bool progress_wanted(const JobContext& context) {
  return progress_wanted(context.quiet, context.progress);
}

/// The version of the program that computed the written numbers.
inline std::string computed_by(const JobContext& context) {
  return context.version.empty() ? HOLDFAST_VERSION : context.version;
}

}  // namespace holdfast::program
