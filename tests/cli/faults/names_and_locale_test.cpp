#include <locale.h>

#include <nlohmann/json.hpp>

#include "cli/every_job.hpp"
#include "cli/running_program.hpp"
#include "report/figures/figure.hpp"

namespace holdfast::tests {
namespace {

namespace fs = std::filesystem;

// ---- names of files ---------------------------------------------------------------------------

const std::vector<std::string> odd_names = between_bars(
    "with blank.csv|with\nline.csv|quo\"te's.csv|-dash.csv|--output.csv|per%cent%s%n.csv|"
    "not\xff utf8.csv|\xc3\xbc\xe2\x98\x83.csv|a,b;c.csv|$HOME`ls`.csv|tab\t.csv|"
    "back\\slash.csv|#.csv|*|" +
    std::string(240, 'n'));

/// Whether a job's table appears under the name, with metadata that are JSON.
void expect_table_named(const fs::path& folder, const std::string& name) {
  EXPECT_GT(fs::file_size(folder / name), 0U);
  EXPECT_TRUE(nlohmann::json::accept(read_text(folder / (name + "-metadata.json"))));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 2);
}

/// The job done in a folder, whose files it names.
Ending done_in(const TemporaryFolder& folder, const std::vector<std::string>& words) {
  return RunningProgram(words, "cd '" + folder.path().string() + "'").wait();
}

void expect_done(const Ending& ending) {
  EXPECT_EQ(ending.exit_code, 0) << ending.errors;
  EXPECT_EQ(ending.errors, "");
}

TEST(FileNames, AResultMayHaveAnyName) {
  for (const std::string& name : odd_names) {
    SCOPED_TRACE(name);
    const TemporaryFolder table, sweep;
    expect_done(done_in(table, {"simulate", "--duration", "0.1", "--output", name}));
    expect_table_named(table.path(), name);
    expect_done(done_in(
        sweep, {"sweep", "--axis", "initial.z1=0,0.001", "--duration", "0.1", "--output=" + name}));
    expect_table_named(sweep.path(), name);
  }
}

TEST(FileNames, ACaseMayHaveAnyName) {
  for (const std::string& name : odd_names) {
    SCOPED_TRACE(name);
    const TemporaryFolder folder;
    expect_done(done_in(folder, {"case", "--init", name}));
    expect_done(done_in(folder, {"margins", "--case", name}));
    write_text(folder / name, "wrong = [");
    const Ending wrong = done_in(folder, {"margins", "--case", name});
    EXPECT_EQ(wrong.exit_code, 2);
    EXPECT_EQ(std::count(wrong.errors.begin(), wrong.errors.end(), '\n'), 1) << wrong.errors;
  }
}

TEST(FileNames, ADecayRecordMayHaveAnyName) {
  for (const std::string& name : odd_names) {
    SCOPED_TRACE(name);
    const TemporaryFolder folder;
    write_text(folder / name, "time_s,displacement_m\n0,wide\n");
    const Ending ending = done_in(folder, {"fit", "--data", name});
    EXPECT_EQ(ending.exit_code, both_packages ? 2 : 1);
    EXPECT_EQ(std::count(ending.errors.begin(), ending.errors.end(), '\n'), 1) << ending.errors;
  }
}

TEST(FileNames, ANameThatIsTooLongIsRefused) {
  const TemporaryFolder folder;
  for (const std::string job : {"simulate", "sweep --axis initial.z1=0,0.001"}) {
    std::vector<std::string> words = words_of(job);
    words.insert(words.end(), {"--duration", "0.1", "--output", std::string(255, 'n')});
    const Ending ending = done_in(folder, words);
    EXPECT_EQ(ending.exit_code, 2);
    expect_holds(ending.errors, {"File name too long"});
    EXPECT_EQ(folder.names(), std::vector<std::string>{});
  }
}

// ---- numbers ----------------------------------------------------------------------------------

TEST(NegativeZero, IsZero) {
  const std::vector<std::string> keys = words_of(
      "control.proportional_gain control.differential_gain control.processing_delay "
      "backlash.width initial.z1 initial.v1 initial.z2 initial.v2 excitation.amplitude");
  for (const std::string& key : keys) {
    for (const std::string job : {"simulate --duration 0.1", "margins"}) {
      SCOPED_TRACE(job + " " + key);
      const Outcome zero = run_holdfast(job + " --set " + key + "=0");
      const Outcome negative = run_holdfast(job + " --set " + key + "=-0.0");
      EXPECT_EQ(negative.exit_code, zero.exit_code);
      EXPECT_EQ(negative.output, zero.output);
    }
  }
}

// ---- locale -----------------------------------------------------------------------------------

/// Makes the German locale in a folder of its own, and tells the C library of it while it lives.
class GermanLocale {
 public:
  GermanLocale() {
    const std::string command =
        "localedef -i de_DE -f UTF-8 '" + (folder_ / "de_DE.UTF-8").string() + "' >/dev/null 2>&1";
    const bool made = std::system(command.c_str()) == 0;
    setenv("LOCPATH", folder_.path().c_str(), 1);
    setenv("LC_ALL", "de_DE.UTF-8", 1);
    const locale_t locale = made ? newlocale(LC_ALL_MASK, "de_DE.UTF-8", nullptr) : nullptr;
    works_ = locale != nullptr && std::string(localeconv_of(locale)) == ",";
    if (locale != nullptr) freelocale(locale);
  }
  ~GermanLocale() {
    unsetenv("LC_ALL");
    unsetenv("LOCPATH");
  }
  GermanLocale(const GermanLocale&) = delete;
  GermanLocale& operator=(const GermanLocale&) = delete;
  GermanLocale(GermanLocale&&) = delete;
  GermanLocale& operator=(GermanLocale&&) = delete;

  bool works() const { return works_; }

 private:
  static std::string localeconv_of(locale_t locale) {
    const locale_t before = uselocale(locale);
    const std::string point = localeconv()->decimal_point;
    uselocale(before);
    return point;
  }

  TemporaryFolder folder_;
  bool works_ = false;
};

/// What the jobs write, by their arguments.
std::map<std::string, std::string> every_output() {
  const TemporaryFolder folder;
  write_text(folder / "case.toml", "[backlash]\nwidth = 0.0015\n");
  std::map<std::string, std::string> outputs;
  for (const JobToTry& job : tables_to_try()) {
    const Outcome outcome =
        run_holdfast(job.quick + " --case case.toml", "", folder.path().string());
    EXPECT_EQ(outcome.exit_code, 0) << job.quick << '\n' << outcome.errors;
    outputs[job.quick] = outcome.output;
  }
  for (const std::string& job : jobs_with_text) outputs[job] = run_holdfast(job).output;
  return outputs;
}

std::string picture() {
  if (!program::gnuplot_available()) return "";
  const TemporaryFolder folder;
  fs::create_directory(folder / "pictures");
  program::Figure figure;
  figure.name = "line";
  figure.plot = "plot [0:1] 0.25 * x notitle\n";
  program::draw(figure, folder.path());
  return read_text(folder / "pictures/line.svg");
}

TEST(Locale, WithADecimalCommaEveryByteIsTheSame) {
  const auto expected = every_output();
  const std::string expected_picture = picture();
  const GermanLocale german;
  if (!german.works()) GTEST_SKIP() << "localedef cannot make the locale de_DE.UTF-8";
  for (const auto& [job, output] : every_output()) EXPECT_TRUE(output == expected.at(job)) << job;
  EXPECT_EQ(picture(), expected_picture);
}

}  // namespace
}  // namespace holdfast::tests
