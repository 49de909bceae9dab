#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "case/job_context.hpp"
#include "holdfast/motion/implemented_loop.hpp"
#include "jobs/columns.hpp"
#include "output/table.hpp"
#include "process/errors.hpp"
#include "process/exit.hpp"
#include "process/interrupt.hpp"
#include "process/progress.hpp"
#include "text/text.hpp"

// Common frame of all jobs: command line, table, warnings, errors, progress and end.

namespace holdfast::program {

/// Command line of one job: its own options and those common to all jobs. texts/jobs.toml gives the
/// help, the admissible values and the mutual exclusions of these options.
class Job {
 public:
  Job(CLI::App& program, const std::string& name);

  /// Adds an option with one word or number and a default.
  template <class Value>
  CLI::Option* add(const std::string& name, Value& value) const {
    return described(options_->add_option(name, value)->capture_default_str());
  }
  /// Adds an option with one word or number and no default.
  template <class Value>
  CLI::Option* add(const std::string& name, std::optional<Value>& value) const {
    return described(options_->add_option(name, value));
  }
  /// Adds a flag.
  CLI::Option* add(const std::string& name, bool& given) const;
  /// Adds a repeatable option.
  CLI::Option* add(const std::string& name, std::vector<std::string>& texts) const;
  /// Adds an option with the words "sampled" and "exact".
  CLI::Option* add(const std::string& name, Switching& switching) const;

  /// Whether the command line has the option.
  bool has(const std::string& name) const {
    const CLI::Option* option = options_->get_option_no_throw(name);
    return option != nullptr && option->count() > 0;
  }

  /// Context of the job: checked case, output and given options; call after the command line is
  /// parsed. A plant that the case does not give is computed from its conductor, unless the job
  /// needs no plant.
  /// @param case_file    case file in place of --case, which must then be absent
  /// @param needs_plant  whether this run needs the plant; without effect for a job that never does
  JobContext context(const std::optional<std::string>& case_file = std::nullopt,
                     bool needs_plant = true) const;

  /// Number of members to be drawn from [uncertain].
  int draws() const { return common_->draws; }

  /// Context of the case with further overrides, each "key=value".
  JobContext context_with(const JobContext& whole, const std::vector<std::string>& overrides) const;

  /// Options --case, --set and --instructions as given, to be passed to another job.
  std::vector<std::string> case_arguments() const;

  /// Sets the function that does the job; where --output names a picture, the picture shows the
  /// table that this function writes.
  void does(const std::function<void()>& work) const;

 private:
  struct Common {
    std::optional<std::string> case_file;
    std::vector<std::string> overrides;
    std::optional<std::string> output;
    bool quiet = false;
    bool progress = false;
    bool yes = false;
    bool family = false;
    int draws = 100;
    std::optional<int> threads;      // nullopt, 0: all
    std::string instructions;        // empty: the best that the processor has
    std::optional<Ticking> ticking;  // from when the context is made to the program's end
  };

  void require_output(const JobContext& context) const;
  /// Throws WrongInput if texts/support.toml refuses the question. @return features left out
  std::string require_supported(const JobContext& context) const;
  void examine_for_this(JobContext& context, bool needs_plant) const;
  void draw() const;
  void answer_family() const;
  CLI::Option* described(CLI::Option* option) const;
  bool has_fact(const std::string& fact, bool otherwise) const;

  CLI::App* options_;
  std::shared_ptr<Common> common_;
};

/// Adds a job defined by a struct: `add_to(job)` adds its members as options; `run(context)` does
/// the job, or `run(job)` where the job makes its own context.
template <class Question>
void add_job(CLI::App& program, const std::string& name) {
  const Job job(program, name);
  const auto question = std::make_shared<Question>();
  question->add_to(job);
  job.does([job, question] {
    if constexpr (std::is_invocable_v<decltype(&Question::run), Question&, const Job&>)
      question->run(job);
    else
      question->run(job.context());
  });
}

/// Adds a job without options.
inline void add_job(CLI::App& program, const std::string& name, void (*run)(const JobContext&)) {
  const Job job(program, name);
  job.does([job, run] { run(job.context()); });
}

/// Adds the subcommand of a job, or of a text about the program, by its name in texts/jobs.toml.
CLI::App* add_subcommand(CLI::App& program, const std::string& name);

/// Runs one command line, given without the program's name. Throws errors of the command line and
/// of its job.
void do_job(const std::vector<std::string>& arguments);

/// Runs the whole program with the arguments of main(); the result is the exit code.
int run_program(int argument_count, char** arguments);

/// Type of functions that add one job each. They are listed in the order of `holdfast --help`.
using AddJob = void(CLI::App& program);
AddJob add_case, add_conductors, add_reduce, add_sag_tension, add_statics, add_modes, add_decay,
    add_peaks, add_fit, add_stability, add_boundary, add_response, add_design, add_margins,
    add_modal_damping, add_sensitivity, add_max_delay, add_simulate, add_spectrum, add_deviation,
    add_coverage, add_verdict, add_orbit, add_basins, add_diagram, add_section, add_lyapunov,
    add_sweep, add_convert, add_absorption, add_aeolian, add_fatigue, add_place, add_answers,
    add_report, add_explore;

/// Heading in the help of the options of every job.
namespace question {
inline constexpr const char* every_job = "Every job";
}

}  // namespace holdfast::program
