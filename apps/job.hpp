#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "process/job_context.hpp"

namespace holdfast::program {

/// Whether a job needs the two-mass plant of the case.
enum class PlantNeed { whole, none };

/// One job of the program on its command line: its own options and those that every job
/// understands.
class Job {
 public:
  /// @param question  the heading under which `holdfast --help` lists the job
  Job(CLI::App& program, const std::string& name, const std::string& question,
      const std::string& description);

  /// Where the job adds its own options.
  CLI::App* operator->() const { return options_; }

  /// An option that holds one word or number as text, with its default.
  CLI::Option* add_text(const std::string& name, std::string& value,
                        const std::string& description) const;

  /// The same for a finite number from `lowest` to `highest`.
  CLI::Option* add_number(const std::string& name, double& value, const std::string& description,
                          double lowest, double highest) const;

  /// The job computes on packs: what it writes names the instruction set.
  void computes_on_packs() const { common_->on_packs = true; }

  /// Whether the command line has it.
  bool instructions_given() const { return !common_->instructions.empty(); }

  /// Checked case, output and the options that were given; call once the command line is read.
  /// A plant that the case does not give is reduced from its conductor, unless the job does
  /// without.
  /// @param case_file  in place of --case, which must not be given then
  JobContext context(PlantNeed need = PlantNeed::whole,
                     const std::optional<std::string>& case_file = std::nullopt) const;

  /// The --case, --set and --instructions options as they were given, to be handed to another job.
  std::vector<std::string> case_arguments() const;

 private:
  struct Common {
    std::optional<std::string> case_file;
    std::vector<std::string> overrides;
    std::optional<std::string> output;
    bool quiet = false;
    bool progress = false;
    int threads = 0;
    std::string instructions;  // empty: the best that the processor has
    bool on_packs = false;     // the job computes on packs
  };

  CLI::App* options_;
  std::shared_ptr<Common> common_;
};

/// A check for an option that is one number: finite, from `lowest` to `highest`.
CLI::Validator number_from(double lowest, double highest);

/// Does one command line, without the program's name; throws what is wrong with it or what its job
/// throws.
void do_job(const std::vector<std::string>& arguments);

/// The whole program, from what main() gets: reads the command line, does the job, gives the exit
/// code.
int run_program(int argument_count, char** arguments);

/// Each adds one job to the program, in the order of `holdfast --help`.
using AddJob = void(CLI::App& program);
AddJob add_case, add_reduce, add_statics, add_modes, add_decay, add_peaks, add_fit, add_stability,
    add_boundary, add_response, add_design, add_margins, add_sensitivity, add_max_delay,
    add_simulate, add_spectrum, add_deviation, add_coverage, add_verdict, add_orbit, add_basins,
    add_diagram, add_section, add_lyapunov, add_sweep, add_answers, add_report;

namespace question {
inline constexpr const char* case_file = "What does my case say?";
inline constexpr const char* cable = "What plant is my cable with its absorber?";
inline constexpr const char* gains = "Which gains are stable, and which are best?";
inline constexpr const char* delay = "How slow may the computer be?";
inline constexpr const char* motion = "How does it move?";
inline constexpr const char* attractor = "What is this irregular motion?";
inline constexpr const char* map = "For which delays, backlashes, frequencies does it still help?";
inline constexpr const char* all = "All of it at once";
inline constexpr const char* program = "The program itself";
}  // namespace question

}  // namespace holdfast::program
