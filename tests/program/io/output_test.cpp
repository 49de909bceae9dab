#include "io/file/output.hpp"

#include <fcntl.h>
#include <sys/stat.h>

#include "process/errors.hpp"
#include "program/child_process.hpp"
#include "support/message_of.hpp"
#include "support/temporary_folder.hpp"

namespace holdfast::program {
namespace {

namespace fs = std::filesystem;
using namespace tests;

/// Runs the work in a child whose standard output is `descriptor`; gives how the child ended.
template <typename Work>
int status_of_child(int descriptor, const Work& work) {
  return tests::exit_code_of_child([&] {
    if (descriptor >= 0) dup2(descriptor, STDOUT_FILENO);
    install_signal_handlers();
    return work();
  });
}

int write_to_standard_output() {
  try {
    OutputFile output(std::nullopt);
    output.write(std::string(1 << 20, 'x'));
    output.commit();
  } catch (const OutputError&) {
    return 7;
  }
  return 0;
}

TEST(OutputFile, AppearsWholeAtCommitAndNotBefore) {
  const TemporaryFolder folder;
  OutputFile output(folder / "out.csv");
  output.write("first ");
  EXPECT_FALSE(fs::exists(folder / "out.csv"));
  output.write("second");
  output.commit();
  EXPECT_EQ(read_text(folder / "out.csv"), "first second");
  EXPECT_EQ(folder.files(), 1);
}

TEST(OutputFile, LeavesNothingWithoutCommit) {
  const TemporaryFolder folder;
  write_text(folder / "out.csv", "older");
  {
    OutputFile output(folder / "out.csv");
    output.write("newer");
    EXPECT_EQ(folder.files(), 2);
  }
  EXPECT_EQ(read_text(folder / "out.csv"), "older");
  EXPECT_EQ(folder.files(), 1);
}

/// Begins an output in a child that is killed then.
void leave_unfinished(const fs::path& file) {
  const auto killed = [&] {
    OutputFile output(file);
    output.write("half");
    raise(SIGKILL);
    return 0;
  };
  EXPECT_EQ(status_of_child(-1, killed), -SIGKILL);
}

TEST(OutputFile, RemovesWhatAKilledProcessLeftOfTheSameFileAndNoOther) {
  const TemporaryFolder folder;
  leave_unfinished(folder / "out.csv");
  leave_unfinished(folder / "other.csv");
  EXPECT_EQ(folder.files(), 2);
  OutputFile at_work(folder / "out.csv");
  EXPECT_EQ(folder.files(), 2);
  OutputFile second(folder / "out.csv");
  EXPECT_EQ(folder.files(), 3);
  second.commit();
  at_work.commit();
  std::vector<std::string> names = folder.names();
  EXPECT_EQ(names.size(), 2U);
  EXPECT_EQ(std::count(names.begin(), names.end(), "out.csv"), 1);
}

TEST(OutputFile, IsNobodyElsesBetweenItsLastByteAndItsName) {
  const TemporaryFolder folder;
  OutputFile first(folder / "out.csv");
  first.write("first");
  first.finish();
  OutputFile second(folder / "out.csv");
  second.write("second");
  second.commit();
  first.commit();
  EXPECT_EQ(read_text(folder / "out.csv"), "first");
  EXPECT_EQ(folder.files(), 1);
}

TEST(OutputFile, DoesNotWriteThroughALinkInThePlaceOfItsTemporaryFile) {
  const TemporaryFolder folder, elsewhere;
  write_text(elsewhere / "file", "precious");
  fs::path temporary;
  {
    OutputFile output(folder / "out.csv");
    temporary = output.temporary();
  }
  fs::create_symlink(elsewhere / "file", temporary);
  OutputFile output(folder / "out.csv");
  output.write("new");
  output.commit();
  EXPECT_EQ(read_text(folder / "out.csv"), "new");
  EXPECT_EQ(read_text(elsewhere / "file"), "precious");
  EXPECT_TRUE(fs::is_symlink(temporary));
}

TEST(OutputFile, ReplacesAnOlderFileAndFollowsLinks) {
  const TemporaryFolder folder;
  write_text(folder / "real.csv", "older");
  fs::create_symlink("real.csv", folder / "link.csv");
  OutputFile output(folder / "link.csv");
  output.write("newer");
  output.commit();
  EXPECT_TRUE(fs::is_symlink(folder / "link.csv"));
  EXPECT_EQ(read_text(folder / "real.csv"), "newer");
}

TEST(OutputFile, MayBeReadAsTheUsersMaskAllows) {
  const TemporaryFolder folder;
  const mode_t before = umask(022);
  OutputFile output(folder / "out.csv");
  output.commit();
  umask(before);
  struct stat status {};
  ASSERT_EQ(stat((folder / "out.csv").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777u, 0644u);
}

TEST(OutputFile, PathsThatCannotBeWrittenAreWrongInput) {
  const TemporaryFolder folder;
  write_text(folder / "file", "");
  const std::vector<std::pair<fs::path, std::string>> refused = {
      {folder.path(), "is a folder"},
      {folder.path() / "", "is a folder"},
      {folder / "absent/out.csv", "No such file"},
      {folder / "file/out.csv", "Not a directory"},
      {folder / std::string(300, 'a'), "too long"},
      {"", "without a name"}};
  for (const auto& [path, words] : refused) {
    const auto said = message_of<WrongInput>([&file = path] { OutputFile output(file); });
    EXPECT_NE(said.find(words), std::string::npos) << said;
  }
  EXPECT_EQ(folder.files(), 1);
}

TEST(OutputFile, AFolderThatMayNotBeWrittenIsWrongInput) {
  if (geteuid() == 0) GTEST_SKIP() << "the superuser may write everywhere";
  const TemporaryFolder folder;
  fs::permissions(folder.path(), fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_THROW(OutputFile(folder / "out.csv"), WrongInput);
  fs::permissions(folder.path(), fs::perms::owner_all);
}

TEST(OutputFile, ADeviceIsWrittenAndNotReplaced) {
  OutputFile output("/dev/null");
  output.write("gone");
  output.commit();
  EXPECT_FALSE(output.is_file());
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST(OutputFile, AFullDeviceIsAnOutputError) {
  OutputFile output("/dev/full");
  const auto message = message_of<OutputError>([&] { output.write("too much"); });
  EXPECT_NE(message.find("/dev/full: No space left"), std::string::npos) << message;
}

TEST(StandardOutput, ThatCannotBeWrittenIsAnOutputErrorAndNoSignal) {
  const int full = open("/dev/full", O_WRONLY);
  EXPECT_EQ(status_of_child(full, write_to_standard_output), 7);
  close(full);
  int ends[2];  // of a pipe that nobody reads
  ASSERT_EQ(pipe(ends), 0);
  close(ends[0]);
  EXPECT_EQ(status_of_child(ends[1], write_to_standard_output), 7);
  close(ends[1]);
  const auto never_open = [] {
    close(STDOUT_FILENO);
    return write_to_standard_output();
  };
  EXPECT_EQ(status_of_child(-1, never_open), 7);
}

TEST(Interrupt, OneSignalLeavesNoFileAndIsThrownAtCommit) {
  const TemporaryFolder folder;
  for (const int signal_number : {SIGINT, SIGTERM}) {
    const auto interrupted_work = [&] {
      try {
        OutputFile output(folder / "out.csv");
        output.write("half");
        raise(signal_number);
        output.commit();
      } catch (const Interrupted&) {
        return 130;
      }
      return 0;
    };
    EXPECT_EQ(status_of_child(-1, interrupted_work), 130);
    EXPECT_EQ(folder.files(), 0);
  }
}

TEST(Interrupt, ASecondSignalEndsAtOnceAndLeavesNoFile) {
  const TemporaryFolder folder;
  const auto stubborn_work = [&] {
    OutputFile output(folder / "out.csv");
    output.write("half");
    raise(SIGINT);
    raise(SIGINT);
    return 0;
  };
  EXPECT_EQ(status_of_child(-1, stubborn_work), 130);
  EXPECT_EQ(folder.files(), 0);
}

TEST(Interrupt, AnIgnoredInterruptIsStillHonoured) {
  const auto work = [] {
    signal(SIGINT, SIG_IGN);  // as a shell does for a command in the background
    install_signal_handlers();
    raise(SIGINT);
    return interrupted() ? 130 : 0;
  };
  EXPECT_EQ(status_of_child(-1, work), 130);
}

}  // namespace
}  // namespace holdfast::program
