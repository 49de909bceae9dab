#include "job.hpp"

#include <algorithm>

#include "case/model/resolved_plant.hpp"
#include "io/file/input.hpp"
#include "io/text/text.hpp"
#include "process/errors.hpp"
#include "process/exit.hpp"
#include "process/worker_threads.hpp"

namespace holdfast::program {
namespace {

// Options that are kept elsewhere in the context, or do not shape the result.
bool is_common(const std::string& name) {
  const std::vector<std::string> common = {"--help",   "--case",        "--set",     "--output",
                                           "--quiet",  "--progress",    "--threads", "--tile",
                                           "--resume", "--instructions"};
  return std::find(common.begin(), common.end(), name) != common.end();
}

std::vector<std::pair<std::string, std::string>> given_options(const CLI::App& options) {
  std::vector<std::pair<std::string, std::string>> given;
  for (const CLI::Option* option : options.get_options()) {
    const std::string name = option->get_name();
    if (is_common(name) || option->count() == 0) continue;
    for (const std::string& text : option->results()) given.emplace_back(name, text);
  }
  return given;
}

/// More threads than cores gain nothing, and oneTBB warns of them on standard error.
int at_most_cores(int threads) {
  const auto cores = static_cast<int>(own_cores().cores.size());
  return cores > 0 ? std::min(threads, cores) : threads;
}

}  // namespace

CLI::Validator number_from(double lowest, double highest) {
  const std::string expected =
      "a number from " + format_number(lowest) + " to " + format_number(highest);
  const auto check = [=](const std::string& text) {
    const std::optional<double> value = parse_number(text);
    const bool admissible = value && *value >= lowest && *value <= highest;
    return admissible ? std::string() : text + " is not " + expected;
  };
  return {check, "NUMBER"};
}

Job::Job(CLI::App& program, const std::string& name, const std::string& question,
         const std::string& description)
    : options_(program.add_subcommand(name, description)), common_(std::make_shared<Common>()) {
  options_->group(question);
  options_->get_formatter()->column_width(34);
  const std::string group = "Every job";
  options_
      ->add_option("--case", common_->case_file,
                   "Case file (TOML, SI units); without it the built-in case")
      ->type_name("FILE")
      ->group(group);
  options_->add_option("--set", common_->overrides, "Change one value of the case; repeatable")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->group(group);
  options_
      ->add_option(
          "--output", common_->output,
          "Where the result goes; without it standard output. Charts and sweeps are netCDF-4 "
          "where its name ends in .nc")
      ->type_name("FILE")
      ->group(group);
  options_->add_flag("--quiet", common_->quiet, "No progress, no warnings")->group(group);
  options_
      ->add_flag("--progress", common_->progress,
                 "Progress even where standard error is no terminal")
      ->group(group);
  options_
      ->add_option("--threads", common_->threads,
                   "Number of threads, 0: all; results do not depend on it")
      ->type_name("N")
      ->check(CLI::Range(0, 1024))
      ->group(group);
  options_
      ->add_option(
          "--instructions", common_->instructions,
          "Instruction set of charts, sweeps and basins: baseline, avx2 or avx512; without "
          "it the best that the processor has. Results agree to rounding")
      ->type_name("SET")
      ->check(CLI::IsMember({"baseline", "avx2", "avx512"}))
      ->group(group);
}

CLI::Option* Job::add_text(const std::string& name, std::string& value,
                           const std::string& description) const {
  return options_->add_option(name, value, description)->capture_default_str();
}

CLI::Option* Job::add_number(const std::string& name, double& value, const std::string& description,
                             double lowest, double highest) const {
  return options_->add_option(name, value, description)
      ->check(number_from(lowest, highest))
      ->type_name("")
      ->capture_default_str();
}

JobContext Job::context(PlantNeed need, const std::optional<std::string>& case_file) const {
  if (case_file && common_->case_file)
    throw WrongInput("--case " + *common_->case_file + ": the case is " + *case_file + " already");
  const std::optional<std::string>& file = case_file ? case_file : common_->case_file;
  JobContext context;
  context.job = options_->get_name();
  CaseSource& source = context.case_source;
  source.overrides = common_->overrides;
  if (file) {
    source.name = *file;
    source.text = read_input(source.name);
  }
  context.case_data = source.load();
  source.attach_record(context.case_data);
  if (common_->output) context.output = *common_->output;
  if (file) require_not_overwritten(*file, context.output);
  require_not_overwritten(context.case_data.excitation.record, context.output);
  report_warning(wind_warning(context.case_data), common_->quiet);
  if (need == PlantNeed::whole) report_warning(settle_plant(context.case_data), common_->quiet);
  context.options = given_options(*options_);
  context.quiet = common_->quiet;
  context.progress = common_->progress;
  context.threads = at_most_cores(common_->threads);
  context.on_packs = common_->on_packs;
  context.instructions = chosen_instruction_set(common_->instructions);
  return context;
}

std::vector<std::string> Job::case_arguments() const {
  std::vector<std::string> arguments;
  if (common_->case_file) arguments.insert(arguments.end(), {"--case", *common_->case_file});
  for (const std::string& setting : common_->overrides) {
    arguments.insert(arguments.end(), {"--set", setting});
  }
  if (instructions_given())
    arguments.insert(arguments.end(), {"--instructions", common_->instructions});
  return arguments;
}

}  // namespace holdfast::program
