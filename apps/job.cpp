#include "job.hpp"

#include <algorithm>
#include <cctype>
#include <set>

#include "case/device/impedance_table.hpp"
#include "case/model/cable_of_case.hpp"
#include "case/model/modal/modal_plant_of_case.hpp"
#include "case/model/modal/modes_warning.hpp"
#include "case/model/resolved_plant.hpp"
#include "case/needed.hpp"
#include "case/plausibility/doubts.hpp"
#include "host/job_host.hpp"
#include "io/file/whole_file.hpp"
#include "jobs/family/family.hpp"
#include "jobs/job_texts.hpp"
#include "jobs/support.hpp"
#include "process/worker_threads.hpp"
#include "report/page/report.hpp"

namespace holdfast::program {
namespace {

// Whether an option is stored elsewhere in the context, or does not affect the result.
bool is_common(const CLI::Option& option) {
  const std::string name = option.get_name();
  return option.get_group() == question::every_job || name == "--help" || name == "--chunk" ||
         name == "--resume" || name == "--part";
}

std::vector<std::pair<std::string, std::string>> given_options(const CLI::App& options) {
  std::vector<std::pair<std::string, std::string>> given;
  for (const CLI::Option* option : options.get_options()) {
    if (is_common(*option)) continue;
    for (const std::string& text : option->results()) given.emplace_back(option->get_name(), text);
  }
  return given;
}

/// The number of threads, at most that of the cores: more bring nothing, and oneTBB would warn.
int at_most_cores(int threads) { return std::min(threads, worker_threads(0)); }

/// Checks one number: finite, from `lowest` to `highest`.
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

CLI::Validator range_of(const toml::array& ends) {
  if (ends[0].is_integer())
    return CLI::Range(*ends[0].value<std::int64_t>(), *ends[1].value<std::int64_t>());
  return number_from(*ends[0].value<double>(), *ends[1].value<double>());
}

/// Warns of implausible values and keeps the warnings for a page of answers.
void doubt(JobContext& context, const std::vector<std::string>& texts) {
  for (const std::string& text : texts) {
    if (text.empty()) continue;
    report_warning(text, context.quiet);
    context.doubts.push_back(text);
  }
}

/// Computes the plant and reports remarks on it. If keys are missing, only the job `case` goes on,
/// with a remark.
void settle(JobContext& context) {
  try {
    report_warning(modes_warning(context.case_data), context.quiet);
    context.plant_remark = settle_plant(context.case_data);
  } catch (const MissingKeys& missing) {
    if (context.job != "case") throw;
    context.plant_remark = std::string("the plant is not computed: ") + missing.what();
  }
  report_warning(context.plant_remark, context.quiet);
}

/// Warns of implausible values, and computes the plant if the job needs it.
void examine(JobContext& context, bool needs_plant, bool needs_gains) {
  report_warning(wind_warning(context.case_data), context.quiet);
  // Usual values for a plant of the user's own are not known here.
  if (has_own_plant(context.case_data)) return;
  doubt(context,
        doubts_about(context.case_data, in_question(context.case_data, quantities_of_case())));
  doubt(context, {contradicted_conductor_text(context.case_data)});
  doubt(context, {contradicted_name_text(context.case_data)});
  doubt(context, impedance_doubts(context.case_data));
  doubt(context, {record_doubt(context.case_data)});
  if (needs_plant) doubt(context, {borrowed_damping_text(context.case_data)});
  if (needs_plant) settle(context);
  // Consequences of one mistake in the plant would look like another.
  if (context.doubts.empty() && has_absorber(context.case_data) &&
      (needs_plant || !plant_is_reduced(context.case_data)))
    doubt(context,
          doubts_about(context.case_data, in_question(context.case_data, quantities_of_plant())));
  if (needs_gains) doubt(context, {borrowed_gains_text(context.case_data)});
}

/// The letters of a warning; warnings of several members with equal letters are reported once.
std::string letters_of(std::string text) {
  const auto is_other = [](unsigned char c) { return std::isalpha(c) == 0; };
  text.erase(std::remove_if(text.begin(), text.end(), is_other), text.end());
  return text;
}

}  // namespace

CLI::App* add_subcommand(CLI::App& program, const std::string& name) {
  const auto texts = job_texts()["jobs"][name];
  return program.add_subcommand(name, text_of(texts["help"]))
      ->group(text_of(job_texts()["questions"][text_of(texts["question"])]));
}

Job::Job(CLI::App& program, const std::string& name)
    : options_(add_subcommand(program, name)), common_(std::make_shared<Common>()) {
  options_->get_formatter()->column_width(34);
  options_->option_defaults()->group(question::every_job);
  add("--case", common_->case_file);
  add("--set", common_->overrides);
  add("--output", common_->output);
  add("--quiet", common_->quiet);
  add("--progress", common_->progress);
  add("--yes", common_->yes);
  add("--threads", common_->threads);
  add("--instructions", common_->instructions);
  options_->option_defaults()->group("Options");
  if (job_texts()["worst"][name].is_array()) {
    add("--family", common_->family);
    add("--draws", common_->draws);
  }
}

CLI::Option* Job::described(CLI::Option* option) const {
  const std::string name = option->get_name();
  const toml::table* of_job = job_texts()["jobs"][options_->get_name()][name].as_table();
  const toml::table& texts = of_job ? *of_job : *job_texts()["options"][name].as_table();
  option->description(text_of(texts["help"]));
  if (const auto type = texts["type"].value<std::string>()) option->type_name(*type);
  if (const toml::array* ends = texts["range"].as_array()) option->check(range_of(*ends));
  const std::vector<std::string> words = words_of(texts["words"].as_array());
  if (!words.empty()) option->check(CLI::IsMember(words));
  for (const std::string& other : words_of(texts["excludes"].as_array()))
    option->excludes(options_->get_option(other));
  return option;
}

CLI::Option* Job::add(const std::string& name, bool& given) const {
  return described(options_->add_flag(name, given));
}

CLI::Option* Job::add(const std::string& name, std::vector<std::string>& texts) const {
  return described(options_->add_option(name, texts)->expected(1)->take_all());
}

CLI::Option* Job::add(const std::string& name, Switching& switching) const {
  const auto take = [&switching](const std::string& word) {
    switching = word == "exact" ? Switching::exact : Switching::sampled;
  };
  return described(options_->add_option_function<std::string>(name, take)->default_str("sampled"));
}

bool Job::has_fact(const std::string& fact, bool otherwise) const {
  return job_texts()["jobs"][options_->get_name()][fact].value_or(otherwise);
}

void Job::require_output(const JobContext& context) const {
  require_not_overwritten(context.case_data.excitation.record, context.output);
  for (const case_tables::Device& device : context.case_data.devices)
    require_not_overwritten(device.file, context.output);
  if (common_->output && !has_fact("writes_folder", false))
    require_output_name(*common_->output, has_picture(context.job));
}

std::string Job::require_supported(const JobContext& context) const {
  Asked asked{context.job, {}};
  for (const CLI::Option* option : options_->get_options()) {
    if (option->count() == 0) continue;
    asked.options.push_back(option->get_name());
    for (const std::string& value : option->results())
      asked.options.push_back(option->get_name() + " " + value);
  }
  const Support support = support_of(context.case_data, asked);
  if (support.refusal.empty()) return support.idealised;
  const auto place = context.case_data.places.find("plant.model");
  throw WrongInput((place == context.case_data.places.end() ? "" : place->second + ": ") +
                   support.refusal);
}

/// Computes and checks those parts of the case that this run of the job needs.
void Job::examine_for_this(JobContext& context, bool needs_plant) const {
  const CLI::Option* no_control = options_->get_option_no_throw("--no-control");
  const bool controlled = no_control == nullptr || no_control->empty();
  // Devices alone need neither absorber nor two masses.
  const Case& the_case = context.case_data;
  const bool has_loop =
      has_active_absorber(the_case) ||
      (the_case.devices.empty() && !the_case.stands_alone && !has_fact("spans_too", false));
  const bool asks_for_plant = needs_plant && has_fact("needs_plant", true);
  if (!asks_for_plant && has_fact("absorber_alone", false) && has_active_absorber(the_case))
    report_warning(settle_absorber(context.case_data), context.quiet);
  examine(context, asks_for_plant && has_loop,
          has_loop && controlled && has_fact("needs_gains", false));
}

JobContext Job::context(const std::optional<std::string>& case_file, bool needs_plant) const {
  if (case_file && common_->case_file)
    throw WrongInput("--case " + *common_->case_file + ": leave it out, since --check " +
                     *case_file + " names the case");
  const std::optional<std::string>& file = case_file ? case_file : common_->case_file;
  JobContext context;
  context.job = options_->get_name();
  context.quiet = common_->quiet;
  CaseSource& source = context.case_source;
  if (const JobHost* host = JobHost::current(); host != nullptr && host->source && !file)
    source = *host->source;
  source.overrides.insert(source.overrides.end(), common_->overrides.begin(),
                          common_->overrides.end());
  if (file) {
    source.name = *file;
    source.text = read_input(source.name);
  }
  context.case_data = source.load();
  source.attach_record(context.case_data);
  if (common_->output) context.output = *common_->output;
  if (file) require_not_overwritten(*file, context.output);
  require_output(context);
  const std::string idealised = require_supported(context);
  examine_for_this(context, needs_plant);
  report_warning(idealised, context.quiet);
  context.options = given_options(*options_);
  context.progress = common_->progress;
  context.yes = common_->yes;
  context.threads = at_most_cores(common_->threads.value_or(0));
  context.on_packs = has_fact("on_packs", false);
  context.instructions = chosen_instruction_set(common_->instructions);
  if (!common_->ticking) common_->ticking.emplace(context.job, progress_wanted(context));
  return context;
}

void Job::does(const std::function<void()>& work) const {
  options_->final_callback([job = *this, work] {
    const std::optional<std::string>& output = job.common_->output;
    const bool drawn = output && is_picture_name(*output) && has_picture(job.options_->get_name());
    const bool by_members = job.common_->family &&
                            (!job.has("--prove") || job.has_fact("proves_comparison", false)) &&
                            !job_texts()["worst"][job.options_->get_name()].as_array()->empty();
    drawn ? job.draw() : by_members ? job.answer_family() : work();
  });
}

JobContext Job::context_with(const JobContext& whole,
                             const std::vector<std::string>& overrides) const {
  JobContext context = whole;
  std::vector<std::string>& all = context.case_source.overrides;
  all.insert(all.end(), overrides.begin(), overrides.end());
  context.case_data = context.case_source.load();
  context.case_source.attach_record(context.case_data);
  context.quiet = true;
  examine_for_this(context, true);
  context.quiet = whole.quiet;
  return context;
}

/// Runs the job in memory for each member of the family, and writes the worst rows.
void Job::answer_family() const {
  const JobContext whole = context();
  std::vector<std::string> arguments = {whole.job};
  for (const CLI::Option* option : options_->get_options()) {
    const std::string name = option->get_name();
    const bool of_all = name == "--family" || name == "--draws" || name == "--prove" ||
                        name == "--help" || name == "--case" || name == "--set" ||
                        name == "--output";
    if (of_all) continue;
    for (const std::string& text : option->results()) arguments.push_back(name + "=" + text);
  }
  std::set<std::string> said;
  write_worst_of_family(whole, common_->draws, has("--prove"), [&](const FamilyMember& member) {
    JobHost host;
    host.source = std::make_shared<CaseSource>(whole.case_source);
    for (const std::string& setting : member.overrides()) host.source->overrides.push_back(setting);
    try {
      const HostScope here(host);
      do_job(arguments);
    } catch (const NoAnswer& none) {
      throw NoAnswer(member.text() + ": " + none.what());
    } catch (const WrongInput& wrong) {
      throw WrongInput(member.text() + ": " + wrong.what());
    }
    for (const std::string& warning : host.warnings)
      if (said.insert(letters_of(warning)).second) report_warning(warning, whole.quiet);
    return std::move(host.tables.front());
  });
}

void Job::draw() const {
  const bool quiet = std::exchange(common_->quiet, true);  // the job itself warns
  PictureRequest request{context(), {options_->get_name()}, {}, case_arguments()};
  common_->quiet = quiet;
  for (const CLI::Option* option : options_->get_options()) {
    const std::string name = option->get_name();
    if (name == "--output" || name == "--help") continue;
    for (const std::string& text : option->results()) request.own.push_back(name + "=" + text);
    request.options.emplace_back(
        name, option->count() > 0 ? option->results().back() : option->get_default_str());
  }
  write_picture(request, do_job);
}

std::vector<std::string> Job::case_arguments() const {
  std::vector<std::string> arguments;
  if (common_->case_file) arguments.insert(arguments.end(), {"--case", *common_->case_file});
  for (const std::string& setting : common_->overrides)
    arguments.insert(arguments.end(), {"--set", setting});
  if (has("--instructions"))
    arguments.insert(arguments.end(), {"--instructions", common_->instructions});
  return arguments;
}

}  // namespace holdfast::program
