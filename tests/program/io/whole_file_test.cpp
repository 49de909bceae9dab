#include <sys/stat.h>

#include "io/file/whole_file.hpp"
#include "support/temporary_folder.hpp"
#include "support/testing.hpp"
#include "text/checksum.hpp"

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

std::string random_bytes(std::mt19937& random, std::size_t size) {
  std::uniform_int_distribution<int> byte(0, 255);
  std::string bytes;
  for (std::size_t i = 0; i < size; ++i) bytes += static_cast<char>(byte(random));
  return bytes;
}

/// The division written out bit by bit, highest power first, on reflected bytes.
std::uint64_t checksum_by_long_division(const std::string& bytes) {
  constexpr std::uint64_t polynomial = 0x42F0E1EBA9EA3693;  // as ECMA-182 prints it
  std::uint64_t remainder = ~std::uint64_t{0};
  for (const char character : bytes) {
    for (int bit = 0; bit < 8; ++bit) {
      const auto next =
          static_cast<std::uint64_t>(static_cast<unsigned char>(character) >> bit & 1);
      const std::uint64_t top = remainder >> 63;
      remainder = (remainder << 1) ^ (top != next ? polynomial : 0);
    }
  }
  std::uint64_t reflected = 0;
  for (int bit = 0; bit < 64; ++bit) reflected |= (remainder >> bit & 1) << (63 - bit);
  return ~reflected;
}

TEST(Checksum, HasThePublishedCheckValue) {
  // Catalogue of parametrised CRC algorithms, CRC-64/XZ.
  EXPECT_EQ(checksum("123456789"), 0x995DC9BBDF1939FA);
  EXPECT_EQ(checksum(""), 0U);
}

TEST(Checksum, IsTheRemainderOfALongDivision) {
  std::mt19937 random(1);
  for (std::size_t size = 0; size < 70; ++size) {
    const std::string bytes = random_bytes(random, size);
    EXPECT_EQ(checksum(bytes), checksum_by_long_division(bytes)) << size;
  }
}

TEST(Checksum, GoesOnFromThePartBefore) {
  std::mt19937 random(2);
  const std::string bytes = random_bytes(random, 100);
  for (std::size_t cut = 0; cut <= bytes.size(); ++cut) {
    EXPECT_EQ(checksum(bytes.substr(cut), checksum(bytes.substr(0, cut))), checksum(bytes));
  }
}

}  // namespace
}  // namespace holdfast::program
