#include <algorithm>
#include <filesystem>
#include <memory>
#include <sstream>
#include <system_error>

#include "io/file/build_record.hpp"
#include "io/file/output.hpp"
#include "io/text/text.hpp"
#include "job.hpp"
#include "process/errors.hpp"
#include "process/exit.hpp"
#include "texts.hpp"

namespace holdfast::program {
namespace {

void print(const std::string& text) {
  OutputFile output(std::nullopt);
  output.write(text);
  output.commit();
}

/// Texts about the program itself, which take no case.
void add_texts(CLI::App& program) {
  CLI::App* completion =
      program.add_subcommand("completion", "Completion of command lines, for a shell to read");
  const auto shell = std::make_shared<std::string>("bash");
  completion->add_option("SHELL", *shell, "Which shell")
      ->check(CLI::IsMember({"bash", "zsh"}))
      ->required();
  completion->group(question::program)->final_callback([&program, shell] {
    print(*shell == "zsh" ? zsh_completion(program) : bash_completion(program));
  });
  program
      .add_subcommand("bill-of-materials",
                      "What the program was built with, for machines: CycloneDX as JSON")
      ->group(question::program)
      ->final_callback([] { print(bill_of_materials()); });
  program.add_subcommand("manual", "The manual page, for man to read")
      ->group(question::program)
      ->final_callback([&program] { print(manual_page(program, examples_of("holdfast"))); });
}

void add_jobs(CLI::App& program) {
  for (AddJob* add :
       {add_case,        add_reduce,    add_statics,  add_modes,    add_decay,     add_peaks,
        add_fit,         add_stability, add_boundary, add_response, add_design,    add_margins,
        add_sensitivity, add_max_delay, add_simulate, add_spectrum, add_deviation, add_coverage,
        add_verdict,     add_orbit,     add_basins,   add_diagram,  add_section,   add_lyapunov,
        add_sweep,       add_answers,   add_report})
    add(program);
  add_texts(program);
}

std::vector<std::string> words_of_jobs(const CLI::App& program) {
  std::vector<std::string> names;
  for (const CLI::App* job : program.get_subcommands(nullptr)) names.push_back(job->get_name());
  return names;
}

/// The job whose name begins with the word, else the one whose name is most like it.
std::string nearest_job(const std::vector<std::string>& jobs, const std::string& word) {
  const auto begun = std::find_if(
      jobs.begin(), jobs.end(), [&](const std::string& name) { return name.rfind(word, 0) == 0; });
  return begun != jobs.end() ? *begun : nearest_name(jobs, word);
}

/// The first word is the job; CLI11 would only say that something was not expected.
void check_job_name(const CLI::App& program, const std::vector<std::string>& arguments) {
  if (arguments.empty()) throw WrongInput("which job? holdfast --help lists them");
  const std::string& word = arguments.front();
  const std::vector<std::string> jobs = words_of_jobs(program);
  const bool is_job = std::find(jobs.begin(), jobs.end(), word) != jobs.end();
  if (is_job || word.rfind('-', 0) == 0) return;
  throw WrongInput("unknown job " + word + "; did you mean " + nearest_job(jobs, word) +
                   "? (holdfast --help lists the jobs)");
}

/// `help` and `help JOB` are asked of other programs; here they are `--help` and `JOB --help`.
std::vector<std::string> with_help_as_option(std::vector<std::string> arguments) {
  if (arguments.empty() || arguments.front() != "help") return arguments;
  arguments.erase(arguments.begin());
  arguments.emplace_back("--help");
  return arguments;
}

std::string nearest_option(const CLI::App& job, const std::string& word) {
  std::vector<std::string> names;
  for (const CLI::Option* option : job.get_options()) names.push_back(option->get_name());
  return nearest_name(names, word);
}

/// What was probably meant by the first word of a command line that its job does not expect.
std::string unexpected_text(const CLI::App& job) {
  const std::string word = job.remaining().empty() ? "" : job.remaining().front();
  if (word.rfind('-', 0) == 0)
    return "unknown option " + word + "; did you mean " + nearest_option(job, word) +
           "? (holdfast " + job.get_name() + " --help lists the options)";
  const char* option = job.get_name() == "case" ? "--check " : "--case ";
  std::error_code ignored;
  if (std::filesystem::exists(word, ignored))
    return "unexpected word " + word + "; did you mean " + option + word + "?";
  return "unexpected word " + word + "; a name with blanks needs quotes";
}

}  // namespace

void do_job(const std::vector<std::string>& arguments) {
  const std::vector<std::string> words = with_help_as_option(arguments);
  CLI::App program("holdfast: suspended cables under digital vibration control", "holdfast");
  program.set_version_flag("-v,--version", version_text);
  program.formatter(std::make_shared<ExamplesFirst>());
  program.require_subcommand(1);
  program.get_formatter()->column_width(20);
  program.get_formatter()->label("SUBCOMMAND", "JOB");
  add_jobs(program);
  check_job_name(program, words);
  try {
    program.parse(std::vector<std::string>(words.rbegin(), words.rend()));
  } catch (const CLI::ExtrasError& outcome) {
    const std::vector<CLI::App*> jobs = program.get_subcommands();
    throw WrongInput(jobs.empty() ? one_line(outcome.what()) : unexpected_text(*jobs.front()));
  } catch (const CLI::ParseError& outcome) {
    // Help and version arrive as exceptions of exit code 0 and print themselves.
    if (outcome.get_exit_code() != 0) throw WrongInput(one_line(outcome.what()));
    std::ostringstream text;
    program.exit(outcome, text, text);
    print(text.str());
  }
}

int run_program(int argument_count, char** arguments) {
  return run_guarded([&] {
    do_job({arguments + 1, arguments + argument_count});
    return exit_code::done;
  });
}

}  // namespace holdfast::program
