#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>
#include <string>

#include "cli/program.hpp"

namespace holdfast::tests {
namespace {

const std::filesystem::path source = HOLDFAST_SOURCE_DIR;

/// The code block behind the comment `<!-- FILE -->`.
std::string block_of(const std::string& readme, const std::string& file) {
  const std::size_t mark = readme.find("<!-- " + file + " -->");
  EXPECT_NE(mark, std::string::npos) << file;
  const std::size_t fence = readme.find("```", mark);
  const std::size_t begin = readme.find('\n', fence) + 1;
  return readme.substr(begin, readme.find("```", begin) - begin);
}

TEST(Readme, ShowsTheProgramThatIsCompiledAndWhatItPrints) {
  const std::string readme = read_text(source / "README.md");
  for (const std::string file : {"examples/first_program.cpp", "examples/first_program.txt"}) {
    EXPECT_EQ(block_of(readme, file), read_text(source / file)) << file;
  }
}

/// A job that needs an optional package says so where the build has none.
bool asks_for_a_package(const Outcome& outcome) {
  return outcome.exit_code == 1 &&
         outcome.errors.find("install the package lib") != std::string::npos;
}

TEST(Readme, CommandLinesOfTheProgramAreAccepted) {
  const TemporaryFolder folder;
  std::filesystem::create_directory_symlink(source / "data", folder / "data");
  std::istringstream readme(read_text(source / "README.md"));
  int tried = 0;
  for (std::string line; std::getline(readme, line);) {
    if (line.rfind("holdfast ", 0) != 0 || line.find("my-") != std::string::npos) continue;
    const std::string arguments = line.substr(9, line.find('#') - 9);
    const Outcome outcome = run_holdfast(arguments, ">/dev/null", folder.path().string());
    if (!both_packages && asks_for_a_package(outcome)) continue;
    EXPECT_EQ(outcome.exit_code, 0) << line << "\n" << outcome.errors;
    ++tried;
  }
  EXPECT_GE(tried, 5);
}

TEST(Readme, LinksLeadToFilesThatExist) {
  for (const std::string page : {"README.md", "docs/theory.md", "docs/notation.md",
                                 "docs/reading-the-paper.md", "docs/performance.md"}) {
    const std::string text = read_text(source / page);
    for (std::size_t at = text.find("]("); at != std::string::npos; at = text.find("](", at + 2)) {
      const std::string target = text.substr(at + 2, text.find(')', at) - at - 2);
      if (target.find("://") != std::string::npos) continue;
      EXPECT_TRUE(std::filesystem::exists((source / page).parent_path() / target))
          << page << ": " << target;
    }
  }
}

}  // namespace
}  // namespace holdfast::tests
