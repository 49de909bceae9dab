#include "case/toml_values.hpp"

#include "case/case_file.hpp"
#include "process/errors.hpp"
#include "support/message_of.hpp"
#include "support/random.hpp"

namespace holdfast::program {
namespace {

using test::Random;
using tests::message_of;

std::string repeated(const std::string& part, std::size_t times) {
  std::string text;
  for (std::size_t k = 0; k < times; ++k) text += part;
  return text;
}

TEST(TomlDepth, WhatIsNestedDeeperThanAnyCaseIsFoundWithItsLine) {
  for (const std::size_t levels : {17U, 300U, 60'000U}) {
    for (const std::string& deep :
         {"x = " + repeated("[", levels), "x = " + repeated("{a=", levels),
          "a" + repeated(".a", levels) + " = 1", "[a" + repeated(" . \"b\"", levels) + "]",
          "[[a" + repeated(".'b'", levels) + "]]", "x = [\n" + repeated("[", levels)}) {
      const auto excess = toml_excess("# ]\n[control]\n" + deep);
      ASSERT_TRUE(excess) << deep.substr(0, 40);
      EXPECT_EQ(excess->line, deep.find('\n') == std::string::npos ? 3U : 4U);
      const std::string words = message_of<WrongInput>(
          [&] { load_case_text("# ]\n[control]\n" + deep, "mine.toml", {}); });
      EXPECT_EQ(words.rfind("mine.toml:", 0), 0U) << words;
    }
    EXPECT_THROW(load_case({}, {"excitation.harmonics=" + repeated("[", levels)}), WrongInput);
    EXPECT_THROW(load_case({}, {"backlash.width=1\na" + repeated(".a", levels) + "=1"}),
                 WrongInput);
  }
}

TEST(TomlDepth, WhatCasesHaveIsNotDeep) {
  for (const std::string text :
       {"", "[excitation]\nharmonics = [[0.1, 20.0, 0.5], [0.1, 30.0]]\n",
        "record = \"../../../../../../../../../../../../../../../../../../x.csv\"\n",
        "s = '[[[[[[[[[[[[[[[[[[[['\n",
        "# [[[[[[[[[[[[[[[[[[[[ a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a\n",
        "s = \"\"\"\n[[[[[[[[[[[[[[[[[[[[\n\"\"\"\n",
        "x = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, "
        "0.9, 1.0, 1.1, 1.2, 1.3, 1.4, 1.5, 1.6, 1.7, 1.8, 1.9, 2.0]\n"}) {
    EXPECT_FALSE(toml_excess(text)) << text;
  }
  EXPECT_FALSE(toml_excess(repeated("[[device]]\nposition = 0.5\n", 1000)));
}

/// A string of TOML, or nearly one, with all that could hide what comes behind it.
std::string some_string(Random& random) {
  static const std::vector<std::string> quotes = {"\"", "'", "\"\"\"", "'''"};
  static const std::vector<std::string> parts = {"\"", "'",  "\"\"", "''", "\\\"", "\\\\", "\\",
                                                 "#",  "\n", "[",    "]",  "{",    "a",    "."};
  const std::string quote = quotes[random.index(quotes.size())];
  std::string text = quote;
  for (std::size_t k = random.index(6); k > 0; --k) text += parts[random.index(parts.size())];
  return text + quote;
}

TEST(TomlDepth, NoStringHidesWhatComesBehindIt) {
  Random random(16);
  int parsed = 0;
  for (int trial = 0; trial < 20'000; ++trial) {
    const std::string before = "s = " + some_string(random) + (random.index(2) == 0 ? " # x" : "");
    const std::string inside = "t = [" + some_string(random) + ", ";
    try {
      const toml::table table = toml::parse(before + "\n" + inside + "0]\n");
      const toml::array* list = table["t"].as_array();
      if (table.size() != 2 || list == nullptr || list->size() != 2) continue;
    } catch (const toml::parse_error&) {
      continue;
    }
    ++parsed;
    const std::string deep = repeated("[", 20) + repeated("]", 20);
    EXPECT_TRUE(toml_excess(before + "\nx = " + deep)) << before;
    EXPECT_TRUE(toml_excess(before + "\n" + inside + deep + "]\n")) << before << '\n' << inside;
    EXPECT_FALSE(toml_excess(before + "\n" + inside + "0]\n")) << before << '\n' << inside;
  }
  EXPECT_GE(parsed, 1000);
}

}  // namespace
}  // namespace holdfast::program
