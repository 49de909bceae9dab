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

// Frame of every job: its command line here, and with it the table that it writes, and how it
// warns, refuses, shows progress and ends.

namespace holdfast::program {

/// One job of the program on its command line: its own options and those that every job
/// understands. What texts/jobs.toml says of the job and of each option holds here: help, what is
/// admissible, which options exclude it.
class Job {
 public:
  Job(CLI::App& program, const std::string& name);

  /// An option that holds one word or number, with its default.
  template <class Value>
  CLI::Option* add(const std::string& name, Value& value) const {
    return told(options_->add_option(name, value)->capture_default_str());
  }
  /// An option that holds one word or number, without a default.
  template <class Value>
  CLI::Option* add(const std::string& name, std::optional<Value>& value) const {
    return told(options_->add_option(name, value));
  }
  /// A flag.
  CLI::Option* add(const std::string& name, bool& given) const;
  /// An option that may be repeated.
  CLI::Option* add(const std::string& name, std::vector<std::string>& texts) const;
  /// "sampled" or "exact".
  CLI::Option* add(const std::string& name, Switching& switching) const;

  /// Whether the command line has the option.
  bool has(const std::string& name) const {
    const CLI::Option* option = options_->get_option_no_throw(name);
    return option != nullptr && option->count() > 0;
  }

  /// Checked case, output and the options that were given; call once the command line is read.
  /// A plant that the case does not give is reduced from its conductor, unless the job does
  /// without.
  /// @param case_file    in place of --case, which must not be given then
  /// @param needs_plant  whether what is asked of a job that needs a plant needs it
  JobContext context(const std::optional<std::string>& case_file = std::nullopt,
                     bool needs_plant = true) const;

  /// The members of [uncertain] that are to be drawn.
  int draws() const { return common_->draws; }

  /// A context for the case with some further overrides, "key=value".
  JobContext context_with(const JobContext& whole, const std::vector<std::string>& overrides) const;

  /// The --case, --set and --instructions options as they were given, to be handed to another job.
  std::vector<std::string> case_arguments() const;

  /// Sets the work; where --output names a picture, it is drawn of the table that this writes.
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
    int zarr_format = 3;
    std::optional<int> threads;      // none, 0: all
    std::string instructions;        // empty: the best that the processor has
    std::optional<Ticking> ticking;  // from when the context is made to the program's end
  };

  void require_output(const JobContext& context) const;
  /// Refuses what texts/support.toml does. @return what it says that an answer leaves out
  std::string require_supported(const JobContext& context) const;
  void examine_for_this(JobContext& context, bool needs_plant) const;
  void draw() const;
  void answer_family() const;
  CLI::Option* told(CLI::Option* option) const;
  bool is_told(const std::string& fact, bool otherwise) const;

  CLI::App* options_;
  std::shared_ptr<Common> common_;
};

/// Adds a job whose question is a struct: `add_to(job)` adds its members as options, and
/// `run(context)` answers it, or `run(job)` where it makes a context of its own.
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

/// A job, or a text about the program itself, by its name in texts/jobs.toml.
CLI::App* add_subcommand(CLI::App& program, const std::string& name);

/// Does one command line, without the program's name; throws what is wrong with it or what its job
/// throws.
void do_job(const std::vector<std::string>& arguments);

/// The whole program, from what main() gets: reads the command line, does the job, gives the exit
/// code.
int run_program(int argument_count, char** arguments);

/// Each adds one job to the program, in the order of `holdfast --help`.
using AddJob = void(CLI::App& program);
AddJob add_case, add_conductors, add_reduce, add_sag_tension, add_statics, add_modes, add_decay,
    add_peaks, add_fit, add_stability, add_boundary, add_response, add_design, add_margins,
    add_modal_damping, add_sensitivity, add_max_delay, add_simulate, add_spectrum, add_deviation,
    add_coverage, add_verdict, add_orbit, add_basins, add_diagram, add_section, add_lyapunov,
    add_sweep, add_convert, add_absorption, add_aeolian, add_fatigue, add_place, add_answers,
    add_report, add_explore;

/// Heading of the help where the options stand that every job has.
namespace question {
inline constexpr const char* every_job = "Every job";
}

}  // namespace holdfast::program
