#include <algorithm>
#include <filesystem>
#include <sstream>
#include <system_error>

#include "case/case_keys.hpp"
#include "io/file/build_record.hpp"
#include "io/file/output.hpp"
#include "job.hpp"
#include "texts.hpp"

namespace holdfast::program {
namespace {

void print(const std::string& text) {
  OutputFile output(std::nullopt);
  output.write(text);
  output.commit();
}

/// Adds the subcommands that print texts about the program and take no case.
void add_texts(CLI::App& program) {
  CLI::App* completion = add_subcommand(program, "completion");
  const auto shell = std::make_shared<std::string>("bash");
  completion->add_option("SHELL", *shell, "Shell that will read the script")
      ->check(CLI::IsMember({"bash", "zsh"}))
      ->required();
  completion->final_callback([&program, shell] {
    print(*shell == "zsh" ? zsh_completion(program) : bash_completion(program));
  });
  add_subcommand(program, "bill-of-materials")->final_callback([] { print(bill_of_materials()); });
  add_subcommand(program, "manual")->final_callback([&program] { print(manual_page(program)); });
}

void add_jobs(CLI::App& program) {
  for (AddJob* add :
       {add_case,        add_conductors, add_reduce,   add_sag_tension, add_statics,
        add_modes,       add_decay,      add_peaks,    add_fit,         add_stability,
        add_boundary,    add_response,   add_design,   add_margins,     add_modal_damping,
        add_sensitivity, add_max_delay,  add_simulate, add_spectrum,    add_deviation,
        add_coverage,    add_verdict,    add_orbit,    add_basins,      add_diagram,
        add_section,     add_lyapunov,   add_sweep,    add_convert,     add_absorption,
        add_aeolian,     add_fatigue,    add_place,    add_answers,     add_report,
        add_explore})
    add(program);
  add_texts(program);
}

/// Job whose name begins with the word, else the job with the most similar name.
std::string nearest_job(const std::vector<std::string>& jobs, const std::string& word) {
  const auto begun = std::find_if(
      jobs.begin(), jobs.end(), [&](const std::string& name) { return name.rfind(word, 0) == 0; });
  return begun != jobs.end() ? *begun : nearest_name(jobs, word);
}

/// Option of every job that equals the word or begins it (`--set=...`); null if there is none.
const CLI::Option* option_of_every_job(const CLI::App& program, const std::string& word) {
  const CLI::App& any_job = *program.get_subcommand("simulate");
  const std::string name = word.substr(0, word.find('='));
  const auto options = any_job.get_options([&](const CLI::Option* option) {
    return option->get_group() == question::every_job && option->check_name(name);
  });
  return options.empty() ? nullptr : options.front();
}

/// Moves the job before options of every job that precede it (`--case my.toml answers`).
std::vector<std::string> with_job_first(const CLI::App& program, std::vector<std::string> words) {
  std::size_t place = 0;
  while (place < words.size() && words[place].rfind("--", 0) == 0) {
    const CLI::Option* option = option_of_every_job(program, words[place]);
    if (option == nullptr) return words;  // --help, --version, or what no job has
    const bool takes_value = option->get_expected_max() > 0 && option->get_type_size() > 0;
    const bool value_follows = takes_value && words[place].find('=') == std::string::npos;
    place += value_follows ? 2 : 1;
  }
  if (place == 0 || place >= words.size()) return words;
  const auto first = words.begin();
  std::rotate(first, first + static_cast<std::ptrdiff_t>(place),
              first + static_cast<std::ptrdiff_t>(place) + 1);
  return words;
}

/// Refuses an option given in place of the job, and says where it belongs.
[[noreturn]] void refuse_option_before_job(const CLI::App& program, const std::string& word) {
  if (option_of_every_job(program, word) != nullptr)
    throw WrongInput("no job is given, only options; holdfast --help lists the jobs");
  throw WrongInput("option " + word +
                   " is given before the job: put it after the job's name; only options of every "
                   "job, such as --case and --set, may come first");
}

/// Checks that the first word is a job; CLI11's own message would be unclear.
void check_job_name(const CLI::App& program, const std::vector<std::string>& arguments) {
  if (arguments.empty()) throw WrongInput("no job is given; holdfast --help lists the jobs");
  const std::string& word = arguments.front();
  if (word.rfind('-', 0) == 0) {
    if (program.get_option_no_throw(word) != nullptr) return;
    refuse_option_before_job(program, word);
  }
  const std::vector<std::string> jobs = job_names(program);
  if (std::find(jobs.begin(), jobs.end(), word) != jobs.end()) return;
  throw WrongInput("unknown job " + word + "; did you mean " + nearest_job(jobs, word) +
                   "? (holdfast --help lists the jobs)");
}

/// Translates `help` and `help JOB`, known from other programs, to `--help` and `JOB --help`.
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

/// List of the jobs that have an option of that name.
std::string jobs_with(const CLI::App& program, const std::string& option) {
  std::vector<std::string> names;
  for (const CLI::App* job : program.get_subcommands(nullptr))
    if (job->get_option_no_throw(option) != nullptr) names.push_back(job->get_name());
  return CLI::detail::join(names, ", ");
}

/// Message with a guess at an unexpected word on the command line.
std::string unexpected_text(const CLI::App& job) {
  const std::string word = job.remaining().empty() ? "" : job.remaining().front();
  const std::string others = jobs_with(*job.get_parent(), word);
  if (!others.empty())
    return job.get_name() + " has no option " + word + "; jobs with this option: " + others;
  if (word.rfind("--", 0) == 0 && find_case_key(word.substr(2, word.find('=') - 2)) != nullptr)
    return "unknown option " + word + "; did you mean --set " + word.substr(2) + "?";
  if (word.rfind('-', 0) == 0)
    return "unknown option " + word + "; did you mean " + nearest_option(job, word) +
           "? (holdfast " + job.get_name() + " --help lists the options)";
  if (job.get_option_no_throw("--find") != nullptr)
    return "unexpected word " + word + "; did you mean --find " + word + "?";
  const char* option = job.get_name() == "case" ? "--check " : "--case ";
  std::error_code ignored;
  if (std::filesystem::exists(word, ignored))
    return "unexpected word " + word + "; did you mean " + option + word + "?";
  return "unexpected word " + word + ": remove it, or put a name with blanks in quotes";
}

/// Message of the parser, in other words where it counts the values of an option.
std::string text_of(const CLI::ParseError& outcome) {
  const std::string text = one_line(outcome.what());
  const std::size_t twice = text.find(": At Most 1 required"), none = text.find(": 1 required ");
  return twice != std::string::npos  ? text.substr(0, twice) + " is given more than once"
         : none != std::string::npos ? text.substr(0, none) + " needs a value after it"
                                     : text;
}

}  // namespace

void do_job(const std::vector<std::string>& arguments) {
  CLI::App program("holdfast: suspended cables under digital vibration control", "holdfast");
  program.set_version_flag("-v,--version", version_text);
  program.formatter(std::make_shared<ExamplesFirst>());
  program.require_subcommand(1);
  program.get_formatter()->column_width(20);
  program.get_formatter()->label("SUBCOMMAND", "JOB");
  add_jobs(program);
  const std::vector<std::string> words = with_job_first(program, with_help_as_option(arguments));
  check_job_name(program, words);
  try {
    program.parse(std::vector<std::string>(words.rbegin(), words.rend()));
  } catch (const CLI::ExtrasError& outcome) {
    const std::vector<CLI::App*> jobs = program.get_subcommands();
    throw WrongInput(jobs.empty() ? one_line(outcome.what()) : unexpected_text(*jobs.front()));
  } catch (const CLI::ParseError& outcome) {
    // Help and version arrive as exceptions of exit code 0 and print themselves.
    if (outcome.get_exit_code() != 0) throw WrongInput(text_of(outcome));
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
