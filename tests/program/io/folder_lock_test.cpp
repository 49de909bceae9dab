#include "io/file/folder_lock.hpp"

#include "process/errors.hpp"
#include "program/child_process.hpp"
#include "support/message_of.hpp"
#include "support/temporary_folder.hpp"

namespace holdfast::program {
namespace {

using tests::exit_code_of_child;
using tests::message_of;
using tests::TemporaryFolder;

/// 0 where another process can hold the folder, 1 where it is told that it is in use.
int try_to_lock_in_child(const std::filesystem::path& folder) {
  return exit_code_of_child([&] {
    try {
      const FolderLock lock(folder);
      return 0;
    } catch (const OutputError&) {
      return 1;
    }
  });
}

TEST(FolderLock, KeepsAnotherProcessAwayWhileItLives) {
  const TemporaryFolder folder;
  {
    const FolderLock lock(folder.path());
    EXPECT_EQ(try_to_lock_in_child(folder.path()), 1);
  }
  EXPECT_EQ(try_to_lock_in_child(folder.path()), 0);
}

TEST(FolderLock, KeepsASecondHolderInOneProcessAway) {
  const TemporaryFolder folder;
  const FolderLock lock(folder.path());
  EXPECT_EQ(message_of<OutputError>([&] { FolderLock second(folder.path()); }),
            folder.path().string() + " is in use by another program; wait until that program ends");
}

TEST(FolderLock, MovesWithItsObject) {
  const TemporaryFolder folder;
  std::optional<FolderLock> lock;
  {
    FolderLock first(folder.path());
    lock = std::move(first);
  }
  EXPECT_EQ(try_to_lock_in_child(folder.path()), 1);
  lock.reset();
  EXPECT_EQ(try_to_lock_in_child(folder.path()), 0);
}

TEST(FolderLock, IsGoneWithAKilledProcess) {
  const TemporaryFolder folder;
  const int code = exit_code_of_child([&] {
    const FolderLock lock(folder.path());
    raise(SIGKILL);
    return 0;
  });
  EXPECT_EQ(code, -SIGKILL);
  EXPECT_TRUE(std::filesystem::exists(folder / FolderLock::file_name));
  EXPECT_NO_THROW(FolderLock{folder.path()});
}

TEST(FolderLock, IsOfTheFileThatHasTheNameNow) {
  const TemporaryFolder folder;
  const FolderLock first(folder.path());
  std::filesystem::remove(folder / FolderLock::file_name);
  const FolderLock second(folder.path());
  EXPECT_EQ(try_to_lock_in_child(folder.path()), 1);
}

TEST(FolderLock, DoesNotFollowALink) {
  const TemporaryFolder folder, elsewhere;
  std::filesystem::create_symlink(elsewhere / "file", folder / "lock");
  const std::string words = message_of<WrongInput>([&] { FolderLock lock(folder.path()); });
  EXPECT_NE(words.find("symbolic link"), std::string::npos) << words;
  EXPECT_EQ(elsewhere.files(), 0);
}

TEST(FolderLock, SaysWhyThereCanBeNone) {
  const TemporaryFolder folder;
  EXPECT_EQ(
      message_of<WrongInput>([&] { FolderLock lock(folder / "missing"); }),
      "cannot write " + (folder / "missing" / "lock").string() + ": No such file or directory");
}

}  // namespace
}  // namespace holdfast::program
