#include "io/file/whole_file.hpp"

#include <sys/stat.h>

#include "support/temporary_folder.hpp"
#include "support/testing.hpp"

namespace holdfast::program {
namespace {

using tests::read_text;
using tests::TemporaryFolder;
using tests::write_text;

TEST(WholeFile, IsReadAsItWasWrittenAndLeavesNothingElse) {
  const TemporaryFolder folder;
  const std::string large(3 << 20, '\xA5');
  for (const std::string& bytes : {std::string(), std::string("a\0b\n", 4), large}) {
    ASSERT_EQ(write_whole_file(folder / "file", bytes), 0);
    int error = -1;
    EXPECT_EQ(read_whole_file(folder / "file", error), bytes);
    EXPECT_EQ(error, 0);
    EXPECT_EQ(folder.files(), 1);
  }
}

TEST(WholeFile, SaysWhyItCannotBeWritten) {
  const TemporaryFolder folder;
  EXPECT_EQ(write_whole_file(folder / "missing" / "file", "x"), ENOENT);
  std::filesystem::create_directory(folder / "file");
  EXPECT_EQ(write_whole_file(folder / "file", "x"), EISDIR);
  EXPECT_EQ(folder.names(), std::vector<std::string>{"file"});
}

TEST(WholeFile, SaysWhyItCannotBeRead) {
  const TemporaryFolder folder;
  int error = 0;
  EXPECT_FALSE(read_whole_file(folder / "missing", error));
  EXPECT_EQ(error, ENOENT);
  EXPECT_FALSE(read_whole_file(folder.path(), error));
  EXPECT_EQ(error, EISDIR);
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_FALSE(read_whole_file(folder / "pipe", error));
  EXPECT_EQ(error, EINVAL);
}

TEST(WholeFile, IsOneOfThoseThatThreadsWriteAtOnce) {
  const TemporaryFolder folder;
  constexpr std::size_t size = 100000;
  std::vector<std::thread> threads;
  for (const char letter : {'a', 'b', 'c', 'd'}) {
    threads.emplace_back([&folder, letter] {
      for (int i = 0; i < 20; ++i) write_whole_file(folder / "file", std::string(size, letter));
    });
  }
  for (std::thread& thread : threads) thread.join();
  const std::string text = read_text(folder / "file");
  EXPECT_EQ(text, std::string(size, text.at(0)));
  EXPECT_EQ(folder.files(), 1);
}

TEST(WholeFile, KnowsTheTemporariesOfWhichFile) {
  EXPECT_EQ(name_behind_temporary(".plan-12-0.tmp"), "plan");
  EXPECT_EQ(name_behind_temporary(".chunk-3-4711-22.tmp"), "chunk-3");
  for (const char* name :
       {"", ".", ".tmp", "plan-12-0.tmp", ".plan-12-0", ".plan-12.tmp", ".plan-12-.tmp",
        ".plan--0.tmp", ".plan-a-0.tmp", ".plan-12-0x.tmp", ".-12-0.tmp", ".plan-12-0.tmp~"}) {
    EXPECT_FALSE(name_behind_temporary(name)) << name;
  }
}

}  // namespace
}  // namespace holdfast::program
