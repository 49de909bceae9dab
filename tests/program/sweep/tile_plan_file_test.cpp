#include "sweep/tiles/tile_plan_file.hpp"

#include "support/testing.hpp"

namespace holdfast::program {
namespace {

TilePlan plan_of_test() {
  return {{{"version", "0.6.0"}, {"--axis 1", "backlash.width=0:0.003:61"}, {"--duration", "20"}},
          61};
}

/// A text of few characters, so that those that mean something come often.
std::string random_text(std::mt19937& random, std::size_t longest) {
  const std::string characters("a= \\x\n\r\t\0\x7F\xC3\xA9", 12);
  std::uniform_int_distribution<std::size_t> size(0, longest);
  std::uniform_int_distribution<std::size_t> index(0, characters.size() - 1);
  std::string text(size(random), ' ');
  for (char& character : text) character = characters[index(random)];
  return text;
}

TEST(TilePlanFile, IsPlainTextInTheOrderOfTheNames) {
  const std::string text = tile_plan_text(plan_of_test());
  const std::string expected =
      "holdfast tiles, format 1\n61 tiles\n--axis 1 = backlash.width=0:0.003:61\n"
      "--duration = 20\nversion = 0.6.0\nchecksum ";
  EXPECT_EQ(text.substr(0, expected.size()), expected);
  EXPECT_EQ(text.size(), expected.size() + 17);
}

TEST(TilePlanFile, IsReadBack) {
  const auto read = parse_tile_plan(tile_plan_text(plan_of_test()));
  ASSERT_TRUE(read);
  EXPECT_EQ(read->tiles, 61);
  EXPECT_EQ(read->entries.begin()->first, "--axis 1");
  EXPECT_EQ(tile_plan_differences(plan_of_test(), *read), "");
}

TEST(TilePlanFile, KeepsAnyTextAndName) {
  std::mt19937 random(1);
  for (int i = 0; i < 2000; ++i) {
    TilePlan plan;
    plan.tiles = i;
    plan.entries = {{"1" + random_text(random, 8), random_text(random, 8)},
                    {"2" + random_text(random, 8), random_text(random, 8)}};
    const std::string text = tile_plan_text(plan);
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 5);
    const auto read = parse_tile_plan(text);
    ASSERT_TRUE(read) << text;
    EXPECT_EQ(read->entries, plan.entries);
    EXPECT_EQ(read->tiles, plan.tiles);
  }
}

TEST(TilePlanFile, MayBeWithoutEntries) {
  const auto read = parse_tile_plan(tile_plan_text({{}, 3}));
  ASSERT_TRUE(read);
  EXPECT_TRUE(read->entries.empty());
}

TEST(TilePlanFile, IsRefusedWhenTruncatedOrContinued) {
  const std::string text = tile_plan_text(plan_of_test());
  for (std::size_t length = 0; length < text.size(); ++length) {
    EXPECT_FALSE(parse_tile_plan(text.substr(0, length))) << length;
  }
  EXPECT_FALSE(parse_tile_plan(text + "\n"));
}

TEST(TilePlanFile, IsRefusedWhenAnyBitIsFlipped) {
  const std::string text = tile_plan_text(plan_of_test());
  for (std::size_t bit = 0; bit < 8 * text.size(); ++bit) {
    std::string altered = text;
    altered[bit / 8] = static_cast<char>(altered[bit / 8] ^ (1 << (bit % 8)));
    EXPECT_FALSE(parse_tile_plan(altered)) << bit;
  }
}

TEST(TilePlanFile, IsRefusedForAnyOtherBytes) {
  std::mt19937 random(2);
  const std::string text = tile_plan_text(plan_of_test());
  for (int i = 0; i < 2000; ++i) {
    EXPECT_FALSE(parse_tile_plan(random_text(random, 60)));
    std::string altered = text;
    altered.insert(random() % altered.size(), random_text(random, 9) + "a");
    EXPECT_FALSE(parse_tile_plan(altered));
  }
  const std::string start = "holdfast tiles, format 1\n";
  for (const char* rest : {"", "\n\n", "x tiles\n\n", "99999999999999999999 tiles\n\n",
                           "3 tiles\na = 1\na = 2\nchecksum 0123456789abcdef\n",
                           "3 tiles\na = \\\nchecksum 0123456789abcdef\n",
                           "3 tiles\na = \\xzz\nchecksum 0123456789abcdef\n"}) {
    EXPECT_FALSE(parse_tile_plan(start + rest)) << rest;
  }
}

TEST(TilePlanFile, HasAnIdentityThatEveryChangeChanges) {
  const std::uint64_t identity = tile_plan_identity(plan_of_test());
  const TilePlan plan = plan_of_test();
  for (const auto& [name, text] : plan.entries) {
    TilePlan changed = plan_of_test();
    changed.entries[name] += "0";
    EXPECT_NE(tile_plan_identity(changed), identity);
    changed = plan_of_test();
    changed.entries.erase(name);
    changed.entries[name + "0"] = text;
    EXPECT_NE(tile_plan_identity(changed), identity);
  }
  TilePlan changed = plan_of_test();
  ++changed.tiles;
  EXPECT_NE(tile_plan_identity(changed), identity);
}

TEST(TilePlanFile, NamesEachDifferenceWithBothTexts) {
  const TilePlan now{{{"--duration", "60"}, {"--kick", ""}, {"--axis 1", "a\nb"}}, 62};
  EXPECT_EQ(tile_plan_differences(plan_of_test(), now),
            "--axis 1 was backlash.width=0:0.003:61, is a\\x0ab; --duration was 20, is 60; "
            "--kick was not given, is empty; version was 0.6.0, is not given; "
            "the number of tiles was 61, is 62");
}

}  // namespace
}  // namespace holdfast::program
