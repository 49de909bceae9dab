// Whatever is on the command line, in the files that it names and in the folder that it goes on
// with: the program ends by itself, in words and with a code that it has, and leaves nothing half
// done. The inputs are random, the same for the same seed:
//
//   HOLDFAST_HOSTILE_INPUTS  how many that are refused, of all kinds together (300)
//   HOLDFAST_HOSTILE_SEED    the seed (1)
//   HOLDFAST_HOSTILE_NUMBER  one of them alone, by the number that a failure tells
//
// What may ask for much work (1e9 values of an axis, a sampling period of a nanosecond) is asked to
// stop after a while and has to; what cannot must be done within two seconds.

#include "case/case_keys.hpp"
#include "cli/sweep/stopped_sweep.hpp"
#include "hostile/hostile_scene.hpp"
#include "hostile/hostile_texts.hpp"
#include "jobs/support.hpp"

namespace holdfast::tests {
namespace {

std::optional<std::uint64_t> number_from_environment(const char* name) {
  const char* text = std::getenv(name);
  if (text == nullptr || *text == '\0') return std::nullopt;
  return std::strtoull(text, nullptr, 10);
}

// ---- what is asked ---------------------------------------------------------------------------

/// The questions of texts/support.toml: of the linear loop, which is done at once whatever the case
/// is, or those whose work depends on the case: how many samples, forcing periods, swings.
std::vector<std::string> questions(bool of_motion) {
  const std::vector<std::string> linear = {"stability", "boundary", "response",
                                           "design",    "margins",  "sensitivity"};
  std::vector<std::string> found = {"case",
                                    "case --check case.toml",
                                    "reduce",
                                    "statics --force -1:1:3 --elements 8",
                                    "modes --count 2 --elements 8",
                                    "fit --data decay.csv",
                                    "completion bash",
                                    "manual",
                                    "case --init new.toml"};
  if (of_motion)
    found = {"orbit --max-period 100 --certificate", "lyapunov --duration 0.1 --history",
             "decay --duration 0.1 --elements 8 --absorber spring",
             "peaks --force 0.1:0.4:2 --elements 8 --duration 0.1", "report --output report"};
  for (const program::SupportCell& cell : program::support_cells()) {
    const std::string& question = cell.question;
    const std::string job = question.substr(0, question.find(' '));
    const bool is_quick = std::count(linear.begin(), linear.end(), job) > 0 &&
                          question.find("--prove") == std::string::npos;
    if (is_quick != of_motion && question != found.back()) found.push_back(question);
  }
  return found;
}

const std::vector<std::string>& quick_jobs() {
  static const std::vector<std::string> all = questions(false);
  return all;
}
const std::vector<std::string>& motion_jobs() {
  static const std::vector<std::string> all = questions(true);
  return all;
}

HostileInput some_job(Random& random) {
  const bool motion = happens(random, 0.4);
  HostileInput input;
  input.words = words_of(one_of(random, motion ? motion_jobs() : quick_jobs()));
  input.may_take_long = motion;
  return input;
}

/// A key of the case, in one of twenty cases none.
std::string some_key(Random& random) {
  if (happens(random, 0.05)) return damaged(random, "control.sampling_period");
  return one_of(random, program::case_keys()).name;
}

std::string decay_record(Random& random) {
  std::string text = "time_s,displacement_m\n";
  for (std::size_t k = 0; k < 5 + random.index(40); ++k) {
    const double time = 0.01 * static_cast<double>(k);
    text += std::to_string(time) + "," +
            std::to_string(0.01 * std::exp(-time) * std::cos(9 * time)) + "\n";
  }
  return text;
}

std::string force_record(Random& random) {
  std::string text = "time_s,force_N\n";
  for (std::size_t k = 0; k < 2 + random.index(30); ++k)
    text += std::to_string(0.05 * static_cast<double>(k)) + "," +
            std::to_string(random.uniform(-1.0, 1.0)) + "\n";
  return text;
}

/// As the system hands over an argument: it ends at a zero, and is not endless.
std::string as_argument(const std::string& text) {
  constexpr std::size_t longest = 100'000;
  return text.substr(0, std::min(text.find('\0'), longest));
}

// ---- the kinds of inputs ---------------------------------------------------------------------

/// An option of some job with what it might be given.
std::vector<std::string> some_option(Random& random) {
  static const std::vector<std::string> options = words_of(
      "--set --case --output --threads --p --d --force --elements --count --absorber --duration "
      "--interval --data --parameters --target --axis --frequency --band --largest-radius "
      "--criterion --from --kick --switching --discard --window --offset --durations --cells "
      "--max-period --follow --transient --strobes --tangent --metric --chunk "
      "--init --check --resume --dry-run --quiet --progress --radius --continuous --plain "
      "--largest --history --trace --certificate --fractions --details --best-gain --no-control "
      "--help --version --regions --stable-interval --both-gains "
      "--equal-displacement -v -h");
  static const std::vector<std::string> values = between_bars(
      "out.csv|out.nc|out|no/such/folder.csv|.|/dev/full|/dev/null|a b.csv|new\nline.csv|-|"
      "case.toml|decay.csv|none.csv|1|2|0.1|sampled|exact|peak|absorber_damping|verdict|"
      "largest_exponent|backlash.width=0.001");
  std::vector<std::string> words = {one_of(random, options)};
  if (happens(random, 0.5))
    words.push_back(one_of(random, values));
  else if (happens(random, 0.5))
    words.push_back(hostile_number(random));
  else if (happens(random, 0.5))
    words.push_back(hostile_axis(random));
  if (words.size() == 2 && happens(random, 0.2)) words = {words[0] + "=" + words[1]};
  return words;
}

void damage_words(Random& random, std::vector<std::string>& words) {
  const std::size_t place = random.index(words.size() + 1);
  const auto at = words.begin() + static_cast<std::ptrdiff_t>(place);
  const bool inside = place < words.size();
  switch (random.index(8)) {
    case 0:
      words.insert(at, hostile_word(random));
      break;
    case 1:
      if (inside) words[place] = hostile_word(random);
      break;
    case 2:
      if (inside) words.erase(at);
      break;
    case 3:
      if (inside) words.push_back(words[place]);
      break;
    case 4:
      if (inside) words[place] = damaged(random, words[place]);
      break;
    default: {
      const auto option = some_option(random);
      words.insert(happens(random, 0.8) ? words.end() : at, option.begin(), option.end());
    }
  }
}

HostileInput hostile_command_line(Random& random) {
  HostileInput input = some_job(random);
  if (happens(random, 0.2)) input.words.insert(input.words.begin(), {"--case", "case.toml"});
  for (std::size_t k = 1 + random.index(4); k > 0; --k) damage_words(random, input.words);
  for (std::string& word : input.words) word = as_argument(word);
  input.files = {{"case.toml", "[backlash]\nwidth = 0.001\n"}, {"decay.csv", decay_record(random)}};
  input.may_take_long = true;  // the options say how much
  return input;
}

/// A case file of some keys, each in its table, the values fit or hostile.
std::string made_case_file(Random& random) {
  std::string text, table;
  for (const program::CaseKey& key : program::case_keys()) {
    if (!happens(random, 0.3)) continue;
    if (key.table() != table) text += "[" + (table = key.table()) + "]\n";
    const bool fit = happens(random, 0.8);
    const std::string word = key.words.empty() ? "" : "\"" + one_of(random, key.words) + "\"";
    const double size = key.range.contains(0.5) ? random.log_uniform(1e-3, 1.0) : 2.0;
    const std::string value = word.empty() ? std::to_string(size) : word;
    text += key.short_name() + " = " + (fit ? value : hostile_number(random)) + "\n";
  }
  return text;
}

std::string nested(Random& random) {
  const std::size_t depth = std::size_t{1} << random.index(17);
  const std::string open =
      one_of(random, std::vector<std::string>{"[", "{a=", "a.", "\"a\" . ", "[[a]]\n"});
  const bool is_key = open.find('.') != std::string::npos,
             is_table = is_key && happens(random, 0.5);
  std::string text = happens(random, 0.5) ? "[excitation]\nharmonics = " : "x = ";
  if (is_key) text = is_table ? "[" : "";
  for (std::size_t k = 0; k < depth; ++k) text += open;
  return text + (is_table ? "a]\n" : is_key ? "a = 1\n" : "1\n");
}

HostileInput hostile_case_file(Random& random) {
  HostileInput input = some_job(random);
  const bool names_it = input.words.back() == "case.toml";
  if (!names_it) input.words.insert(input.words.end(), {"--case", "case.toml"});
  std::string text = happens(random, 0.4) ? made_case_file(random)
                                          : read_text(HOLDFAST_SOURCE_DIR "/data/kollar2022.toml");
  for (std::size_t k = random.index(4); k > 0; --k) text = damaged(random, text);
  if (happens(random, 0.05)) text = nested(random);
  if (happens(random, 0.05)) text = noise(random, random.index(5000));
  if (happens(random, 0.02)) text.clear();
  input.files = {{"case.toml", text}, {"decay.csv", decay_record(random)}};
  return input;
}

HostileInput hostile_override(Random& random) {
  HostileInput input = some_job(random);
  for (std::size_t k = 1 + random.index(3); k > 0; --k) {
    const std::string key = some_key(random);
    std::string text =
        key + "=" + (happens(random, 0.8) ? hostile_number(random) : hostile_word(random));
    // A stiff cable, or one that hardly damps, is integrated for seconds before the damping of its
    // absorber is found.
    for (const char* table : {"conductor.", "absorber.", "reduction."})
      if (key.rfind(table, 0) == 0) input.may_take_long = true;
    if (happens(random, 0.1)) text = damaged(random, text);
    input.words.insert(input.words.end(), {"--set", as_argument(text)});
  }
  input.files = {{"case.toml", ""}, {"decay.csv", decay_record(random)}};
  return input;
}

/// The jobs that read axes, ranges, lists, windows and kicks, with hostile ones.
HostileInput hostile_axes(Random& random) {
  static const std::vector<std::string> jobs = {
      "stability --p @ --d @",
      "stability --radius --axis #=@ --axis #=@",
      "boundary --p @ --d @",
      "response --p @ --d @ --output out.csv",
      "design --frequency @",
      "design --band @",
      "max-delay --frequency @",
      "statics --elements 8 --force @",
      "peaks --elements 8 --duration 0.1 --force @",
      "basins --max-period 50 --axis #=@ --axis #=@",
      "basins --max-period 50 --axis initial.z1=@ --axis initial.v2=@ --output out.csv",
      "diagram --transient 0.1 --strobes 2 --axis #=@",
      "orbit --max-period 50 --follow #=@",
      "coverage --durations 0.1 --window @:@",
      "coverage --durations @",
      "simulate --kick @",
      "sweep --dry-run --axis #=@ --axis #=@",
      "sweep --duration 0.1 --axis #=@ --output out.csv",
      "sweep --duration 0.1 --axis #=@ --axis #=@ --output out.nc",
      "stability --p @ --d @ --output out.nc",
      "boundary --stable-interval --p @ --d @"};
  HostileInput input;
  for (const std::string& word : words_of(one_of(random, jobs))) {
    std::string text;
    for (const char character : word) {
      if (character == '@')
        text += hostile_axis(random);
      else if (character == '#')
        text += some_key(random);
      else
        text += character;
    }
    input.words.push_back(as_argument(text));
  }
  input.may_take_long = true;
  return input;
}

HostileInput hostile_record(Random& random) {
  HostileInput input;
  const bool decay = happens(random, 0.5);
  std::string text = decay ? decay_record(random) : force_record(random);
  for (std::size_t k = random.index(4); k > 0; --k) text = damaged(random, text);
  if (happens(random, 0.05)) text = noise(random, random.index(5000));
  if (happens(random, 0.1))
    text = "time_s," + std::string(decay ? "displacement_m" : "force_N") + "\n" +
           hostile_number(random) + ",1\n" + hostile_number(random) + "," + hostile_number(random) +
           "\n";
  if (decay) {
    input.words = words_of(one_of(
        random,
        std::vector<std::string>{
            "fit --data record.csv", "fit --data record.csv --target peak",
            "fit --data record.csv --target measures --parameters "
            "absorber_damping,conductor_stiffness",
            "fit --data record.csv --plain --parameters absorber_damping,absorber_stiffness"}));
  } else {
    input.words = words_of(one_of(random, motion_jobs()));
    input.words.insert(input.words.end(), {"--set", "excitation.record=record.csv"});
    if (happens(random, 0.5))
      input.words.insert(input.words.end(), {"--set", "excitation.record_interpolation=held"});
    input.may_take_long = true;
  }
  input.files = {{"record.csv", text}};
  return input;
}

/// Everything where a file is expected but one, and files where none can be.
HostileInput hostile_file(Random& random) {
  static const std::vector<std::string> names = between_bars(
      "case.toml|a b.toml|new\nline.toml|\xFF\xFE.toml|-|--case|.toml|caf\xC3\xA9.toml|out.csv|"
      "quote\".toml|folder|folder/|loop|missing.toml|pipe-less/none|unreadable|dangling|"
      "/dev/null|/proc/self/mem||case.toml/x");
  HostileInput input;
  input.files = {{"case.toml", ""},
                 {"a b.toml", ""},
                 {"new\nline.toml", ""},
                 {"unreadable", "x"},
                 {"\xFF\xFE.toml", "[control]\nx = 1\n"},
                 {"-", ""},
                 {"--case", ""},
                 {".toml", ""},
                 {"caf\xC3\xA9.toml", ""},
                 {"quote\".toml", "\""},
                 {"folder/x", "a folder"},
                 {"out.csv", "somebody's"}};
  input.prepare = [](const std::filesystem::path& folder) {
    std::filesystem::create_symlink("loop", folder / "loop");
    std::filesystem::create_symlink("nowhere", folder / "dangling");
    std::filesystem::permissions(folder / "unreadable", std::filesystem::perms::none);
  };
  const std::string name = one_of(random, names);
  constexpr const char* lines[] = {
      "case --check @",
      "case --init @",
      "fit --data @",
      "report --output @",
      "modes --elements 8 --count 1 --output @",
      "sweep --axis backlash.width=0:0.001:2 --duration 0.1 --output @",
      "simulate --duration 0.1 --set excitation.record=@",
      "margins --case @"};
  const std::size_t kind = random.index(std::size(lines));
  input.words = words_of(lines[kind]);
  input.words.back().replace(input.words.back().size() - 1, 1, name);
  input.may_take_long = kind == 3;  // a report
  if (happens(random, 0.3)) damage_words(random, input.words), input.may_take_long = true;
  for (std::string& word : input.words) word = as_argument(word);
  return input;
}

/// The store that a sweep left which was killed, by the names of its files.
const std::map<std::string, std::string>& left_store() {
  static const auto files = [] {
    const StoppedSweep stopped(SIGKILL);
    auto contents = contents_of(stopped.folder().path());
    for (auto entry = contents.begin(); entry != contents.end();) {
      const bool file = std::filesystem::is_regular_file(stopped.folder() / entry->first);
      entry = file ? std::next(entry) : contents.erase(entry);
    }
    return contents;
  }();
  return files;
}

HostileInput hostile_store(Random& random) {
  static const std::vector<std::string> names = between_bars(
      "zarr.json|lock|steady_peak/c.1.0|steady_peak/c.99.0|outcome/c.1.0|steady_peak/zarr.json|"
      "steady_peak/.c.1.0.claim|.zarr.json-1-0.tmp|steady_peak/.c.2.0-7-0.tmp|initial_z1/c.0|"
      "notes.txt|new\nline|\xFF");
  const std::string folder = "sweep.csv.zarr/";
  HostileInput input;
  input.words = sweep_words("sweep.csv", happens(random, 0.9) ? "--resume" : "");
  if (happens(random, 0.1)) damage_words(random, input.words);
  for (std::string& word : input.words) word = as_argument(word);
  input.files = left_store();
  for (std::size_t k = 1 + random.index(3); k > 0; --k) {
    auto file = std::next(input.files.begin(),
                          static_cast<std::ptrdiff_t>(random.index(input.files.size())));
    if (happens(random, 0.3)) file = input.files.find(folder + "zarr.json");
    if (file == input.files.end()) continue;
    const std::string name = file->first;
    switch (random.index(6)) {
      case 0:
        input.files.erase(name);
        break;
      case 1:
        input.files[folder + one_of(random, names)] = damaged(random, file->second);
        break;
      case 2:
        input.files[name] = "";
        break;
      case 3:
        input.files[name] = noise(random, random.index(2000));
        break;
      default:
        input.files[name] = damaged(random, file->second);
    }
  }
  if (happens(random, 0.2)) {
    const std::string in_the_way = folder + one_of(random, names);
    input.files.erase(in_the_way);
    input.prepare = [in_the_way, pipe = happens(random, 0.5)](const std::filesystem::path& work) {
      std::filesystem::create_directories((work / in_the_way).parent_path());
      if (pipe)
        mkfifo((work / in_the_way).c_str(), 0600);
      else
        std::filesystem::create_directory(work / in_the_way);
    };
  }
  input.may_take_long = true;
  return input;
}

// ---- what is expected ------------------------------------------------------------------------

struct Kind {
  const char* name;
  HostileInput (*make)(Random&);
};

const Kind kinds[] = {{"command lines", hostile_command_line},
                      {"case files", hostile_case_file},
                      {"overrides", hostile_override},
                      {"axes", hostile_axes},
                      {"records", hostile_record},
                      {"files", hostile_file},
                      {"stores", hostile_store}};

/// Finished chunks stay beside the output on purpose, and a report is a folder of many results.
bool may_leave_something(const HostileInput& input, const LimitedEnding& ending) {
  // Before the job stand options, of which two take no value.
  std::size_t job = 0;
  const std::vector<std::string>& words = input.words;
  while (job < words.size() && words[job].rfind("--", 0) == 0)
    job += words[job] == "--quiet" || words[job] == "--progress" ? 1U : 2U;
  const bool makes_many = job < words.size() && (words[job] == "sweep" || words[job] == "report");
  return ending.exit_code == 0 || (makes_many && ending.exit_code != 2);
}

/// What is wrong with an ending, in words; empty for nothing.
std::string fault_of(const HostileInput& input, const LimitedEnding& ending,
                     const HostileScene& scene) {
  if (ending.killed) return "did not stop when it was asked to";
  if (ending.ended_by_signal != 0)
    return "was ended by signal " + std::to_string(ending.ended_by_signal);
  if (ending.asked_to_stop && !input.may_take_long) return "took longer than two seconds";
  const int code = ending.exit_code;
  const bool interrupted = ending.asked_to_stop && code == 130;
  if (code != 0 && code != 1 && code != 2 && !interrupted)
    return "gave the exit code " + std::to_string(code);
  const ErrorLines lines = error_lines_of(ending.errors, input.words);
  if (!lines.strange.empty()) return "wrote a strange line: " + shown(lines.strange, 200);
  // A sweep that stops says beside the reason where its chunks are.
  const std::size_t kept = ending.errors.find("--resume to continue") != std::string::npos ? 1 : 0;
  const std::size_t expected = code == 0 ? 0 : 1;
  if (code != 2 ? lines.others > expected + kept || lines.others < expected : lines.others != 1)
    return "wrote " + std::to_string(lines.others) + " lines of errors";
  if (code == 2 && !ending.output.empty()) return "wrote a result of what it refused";
  if (!scene.temporary_files().empty()) return "left" + scene.temporary_files();
  if (!may_leave_something(input, ending) && !scene.changes().empty())
    return "left its folder changed:" + scene.changes();
  return "";
}

struct Counts {
  std::map<std::string, int> endings;
  std::uint64_t refused = 0;  // exit code 1 or 2
  std::size_t warnings = 0;
  std::size_t longest_message = 0;
};

void try_input(const Kind& kind, std::uint64_t seed, std::uint64_t number, Counts& counts) {
  Random random(seed * 0x9E3779B97F4A7C15ULL + number);
  const HostileInput input = kind.make(random);
  const HostileScene scene(input);
  Limits limits;
  if (input.may_take_long) limits.patience = std::chrono::milliseconds(500);
  if (is_sanitized) limits.patience *= 10, limits.last_words *= 10, limits.processor_seconds = 60;
  const LimitedEnding ending = limited_run(input.words, scene.place(), limits);
  const ErrorLines lines = error_lines_of(ending.errors, input.words);
  counts.warnings += lines.warnings;
  counts.longest_message = std::max(counts.longest_message, ending.errors.size());
  ++counts.endings[ending.asked_to_stop ? "asked to stop" : std::to_string(ending.exit_code)];
  if (!ending.asked_to_stop && ending.exit_code != 0) ++counts.refused;
  const std::string fault = fault_of(input, ending, scene);
  if (fault.empty()) return;
  ADD_FAILURE() << kind.name << ", seed " << seed << ", number " << number << ": the program "
                << fault << " (exit code " << ending.exit_code << ", " << ending.seconds << " s)\n"
                << described(input) << "\nstandard error:\n"
                << shown(ending.errors, 2000);
}

class HostileInputs : public testing::TestWithParam<std::size_t> {};

TEST_P(HostileInputs, EndInWordsAndLeaveNothing) {
  const std::size_t kind = GetParam(), kinds_of_inputs = std::size(kinds);
  const std::uint64_t all = number_from_environment("HOLDFAST_HOSTILE_INPUTS").value_or(300);
  const std::uint64_t seed = number_from_environment("HOLDFAST_HOSTILE_SEED").value_or(1);
  const auto one = number_from_environment("HOLDFAST_HOSTILE_NUMBER");
  Counts counts;
  // What turns out to be a question with an answer is no hostile input: others take its place.
  const std::uint64_t wanted = one ? 0 : (all + kinds_of_inputs - 1 - kind) / kinds_of_inputs;
  for (std::uint64_t number = kind; counts.refused < wanted && number < 10 * all;
       number += kinds_of_inputs)
    try_input(kinds[kind], seed, number, counts);
  if (one && *one % kinds_of_inputs == kind) try_input(kinds[kind], seed, *one, counts);
  EXPECT_GE(counts.refused, wanted);
  std::cout << kinds[kind].name << ":";
  for (const auto& [ending, times] : counts.endings) std::cout << " " << ending << ": " << times;
  std::cout << "; warnings: " << counts.warnings
            << ", longest standard error: " << counts.longest_message << " bytes\n";
}

std::string name_of_kind(const testing::TestParamInfo<std::size_t>& info) {
  std::string name = kinds[info.param].name;
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Kinds, HostileInputs, testing::Range(std::size_t{0}, std::size(kinds)),
                         name_of_kind);

}  // namespace
}  // namespace holdfast::tests
