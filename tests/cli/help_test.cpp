#include "case/case_keys.hpp"
#include "cli/program.hpp"

namespace holdfast::tests {
namespace {

/// The jobs, as the completion of an empty word has them.
std::vector<std::string> jobs() {
  const std::string text = run_holdfast("completion bash").output;
  const std::size_t begin = text.find("compgen -W \"") + 12;
  std::istringstream words(text.substr(begin, text.find('"', begin) - begin));
  std::vector<std::string> names;
  for (std::string word; words >> word;)
    if (word.front() != '-') names.push_back(word);
  return names;
}

TEST(Help, LeadsWithExamples) {
  for (const std::string& job : jobs()) {
    const std::string help = run_holdfast(job + " --help").output;
    const std::size_t examples = help.find("Examples:\n  holdfast " + job);
    EXPECT_LT(examples, help.find("Options:")) << job;
  }
  const std::string help = run_holdfast("--help").output;
  EXPECT_LT(help.find("Examples:\n  holdfast "), help.find("Options:"));
}

TEST(Help, ItsExamplesWork) {
  const TemporaryFolder folder;
  const std::filesystem::path data = std::filesystem::path(HOLDFAST_SOURCE_DIR) / "data";
  std::filesystem::copy_file(data / "kollar2022-decay.csv", folder / "decay.csv");
  int tried = 0;
  for (const std::string& job : jobs()) {
    if (job == "report" || job == "explore" || job == "completion" || job == "manual")
      continue;  // tests of their own
    for (const std::string& line : lines_of(run_holdfast(job + " --help").output)) {
      if (line.rfind("  holdfast ", 0) != 0) continue;
      const std::string arguments = line.substr(11, line.find('#') - 11);
      const Outcome outcome = run_holdfast(arguments, ">/dev/null", folder.path().string());
      if (!both_packages && outcome.errors.find("install the package lib") != std::string::npos)
        continue;
      EXPECT_EQ(outcome.exit_code, 0) << line << "\n" << outcome.errors;
      ++tried;
    }
  }
  EXPECT_GE(tried, 30);
}

TEST(Help, AWordThatIsNotExpectedIsGuessed) {
  const TemporaryFolder folder;
  write_text(folder / "mine.toml", "");
  const auto expect_guess = [&](const std::string& arguments, const std::string& guess) {
    expect_refused(arguments, {guess}, 2, folder.path().string());
  };
  expect_guess("simulate --switchng exact", "did you mean --switching?");
  expect_guess("margins mine.toml", "--case mine.toml");
  expect_guess("case mine.toml", "--check mine.toml");
  expect_guess("simulate --set control.sampling_period=10kg", "not a unit of this key");
  expect_guess("lyap", "did you mean lyapunov?");  // by its beginning
  expect_guess("stabilty", "did you mean stability?");
}

TEST(Help, IsAskedForInOtherWaysToo) {
  EXPECT_EQ(run_holdfast("help").output, run_holdfast("--help").output);
  EXPECT_EQ(run_holdfast("help orbit").output, run_holdfast("orbit --help").output);
  EXPECT_EQ(run_holdfast("-v").output, run_holdfast("--version").output);
  EXPECT_NE(run_holdfast("-v").output.find(HOLDFAST_VERSION), std::string::npos);
}

TEST(Help, OptionsOfEveryJobMayStandBeforeIt) {
  const TemporaryFolder folder;
  write_text(folder / "mine.toml", "[backlash]\nwidth = 0.0011\n");
  const auto output = [&](const std::string& arguments) {
    const Outcome outcome = run_holdfast(arguments, "", folder.path().string());
    EXPECT_EQ(outcome.exit_code, 0) << arguments << '\n' << outcome.errors;
    return outcome.output;
  };
  const std::string options =
      "--case mine.toml --quiet --set control.sampling_period=0.002 --set=initial.z1=0.001 "
      "--threads 1 --instructions=baseline ";
  for (const std::string job : {"simulate --duration 0.1", "margins", "spectrum --duration 1",
                                "case", "stability --p -600:0:3 --d -20:0:3"}) {
    EXPECT_EQ(output(options + job), output(job + " " + options));
    EXPECT_EQ(output("--case mine.toml " + job + " --set initial.z1=0.002"),
              output(job + " --case mine.toml --set initial.z1=0.002"));
  }
  output("--progress --output x.csv simulate --duration 0.1");
  EXPECT_TRUE(std::filesystem::exists(folder / "x.csv"));
}

TEST(Help, OptionsWithoutAJobAreToldToHaveNone) {
  expect_refused("--case mine.toml", {"no job is given"});
  expect_refused("", {"no job is given"});
  expect_refused("--case margins", {"no job is given"});
  expect_refused("--duration 1 simulate", {"--duration", "after"});
  expect_refused("--quiet margns", {"margins"});
  expect_refused("simulat", {"simulate"});
  expect_refused("max_delay", {"max-delay"});
  expect_refused("-x", {"-x"});
}

/// What bash offers for the last of some words.
std::string completed(const std::string& words, int last) {
  const TemporaryFolder folder;
  const std::string script = (folder / "holdfast.bash").string();
  const std::string output = (folder / "out").string();
  run_holdfast("completion bash", ">'" + script + "'");
  const std::string command = "bash -c 'source \"" + script + "\"; COMP_WORDS=(" + words +
                              "); COMP_CWORD=" + std::to_string(last) +
                              "; _holdfast 2>/dev/null; echo \"${COMPREPLY[*]}\"' > '" + output +
                              "'";
  EXPECT_EQ(std::system(command.c_str()), 0);
  return read_text(output);
}

TEST(Completion, OffersJobsOptionsWordsAndKeys) {
  EXPECT_EQ(completed("holdfast sim", 1), "simulate\n");
  EXPECT_EQ(completed("holdfast --case mine.toml sim", 3), "simulate\n");
  EXPECT_EQ(completed("holdfast --quiet simulate --sw", 3), "--switching\n");
  EXPECT_EQ(completed("holdfast simulate --sw", 2), "--switching\n");
  EXPECT_EQ(completed("holdfast simulate --switching e", 3), "exact\n");
  EXPECT_EQ(completed("holdfast sweep --axis backlash.w", 3), "backlash.width=\n");
  EXPECT_EQ(completed("holdfast lyapunov --durat", 2), "--duration\n");
  EXPECT_EQ(completed("holdfast completion z", 2), "zsh\n");
}

TEST(Completion, IsGoodForZshToo) {
  const std::string text = run_holdfast("completion zsh").output;
  EXPECT_EQ(text.rfind("#compdef holdfast\n", 0), 0U);
  for (const std::string& job : jobs()) expect_holds(text, {"    " + job + ")\n      _arguments"});
  expect_refused("completion fish", {});
}

TEST(Manual, HasEveryJobAndEveryKey) {
  const std::string page = run_holdfast("manual").output;
  EXPECT_EQ(page.rfind(".TH HOLDFAST 1", 0), 0U);
  const auto escaped = [](std::string text) {
    for (std::size_t at = 0; (at = text.find('-', at)) != std::string::npos; at += 2)
      text.replace(at, 1, "\\-");
    return text;
  };
  for (const std::string& job : jobs())
    expect_holds(page, {"\\fBholdfast " + escaped(job) + "\\fR"});
  for (const program::CaseKey& key : program::case_keys())
    expect_holds(page, {"\n\\fB" + key.short_name() + "\\fR"});
  for (const std::string& line : lines_of(page))
    EXPECT_FALSE(line.rfind("'", 0) == 0) << "a request by accident: " << line;
}

}  // namespace
}  // namespace holdfast::tests
