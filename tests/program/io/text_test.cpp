#include "text/text.hpp"

#include "support/testing.hpp"

namespace holdfast::program {
namespace {

/// A double with every pattern of bits equally likely, so of every size.
double any_double(std::mt19937_64& random) {
  const std::uint64_t bits = random();
  double value = 0.0;
  std::memcpy(&value, &bits, sizeof(value));
  return value;
}

TEST(Text, NumbersReadBackTheSame) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 100000; ++i) {
    const double value = any_double(random);
    const auto read = parse_number(format_number(value));
    ASSERT_TRUE(read.has_value()) << format_number(value);
    if (std::isnan(value)) {
      ASSERT_TRUE(std::isnan(*read));
    } else {
      ASSERT_EQ(*read, value);
      ASSERT_EQ(std::signbit(*read), std::signbit(value));
    }
  }
}

constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(Text, NumbersHaveNoDigitTooMany) {
  const std::vector<std::pair<double, const char*>> texts = {
      {0.1, "0.1"},
      {0.1 + 0.2, "0.30000000000000004"},
      {-557.0, "-557"},
      {1e-9, "1e-09"},
      {infinity, "inf"},
      {-infinity, "-inf"},
      {-std::numeric_limits<double>::quiet_NaN(), "nan"}};
  for (const auto& [number, text] : texts) EXPECT_EQ(format_number(number), text);
}

TEST(Text, ANumberIsTheWholeTextOrNone) {
  const std::vector<std::pair<const char*, double>> numbers = {
      {"+1.5", 1.5}, {"-.5e1", -5.0}, {"1e999", infinity}, {"-1e999", -infinity}, {"1e-999", 0.0}};
  for (const auto& [text, number] : numbers) EXPECT_EQ(parse_number(text), number) << text;
  for (const char* text : {"", " 1", "1 ", "1,5", "0x10", "1e", "+-1", "+", "one", "1m"})
    EXPECT_FALSE(parse_number(text).has_value()) << text;
}

TEST(Text, OneLineKeepsNoControlCharacter) {
  EXPECT_EQ(one_line("a\r\nb\x1b[1m\tc\n"), "a b [1m c");
  EXPECT_EQ(one_line("sag Höhe"), "sag Höhe");
}

TEST(Text, EditDistanceIsAMetricThatCountsASwapAsOne) {
  const std::vector<std::string> words = {"", "span", "sapn", "spans", "sag", "gravity", "width"};
  for (const auto& a : words) {
    EXPECT_EQ(edit_distance(a, a), 0u);
    EXPECT_EQ(edit_distance(a, ""), a.size());
    for (const auto& b : words) EXPECT_EQ(edit_distance(a, b), edit_distance(b, a));
  }
  EXPECT_EQ(edit_distance("span", "sapn"), 1u);
  EXPECT_EQ(edit_distance("span", "spans"), 1u);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
}

TEST(Text, SplitKeepsEmptyParts) {
  const std::vector<std::string_view> expected = {"a", "", "b", ""};
  EXPECT_EQ(split("a::b:", ':'), expected);
  EXPECT_EQ(split("", ':').size(), 1u);
}

TEST(Text, Utf8IsToldFromOtherBytes) {
  for (const char* good : {"", "abc", "\xC3\xA9", "\xE2\x82\xAC", "\xF0\x9F\x99\x82", "\x7F"})
    EXPECT_TRUE(is_utf8(good)) << good;
  for (const char* bad : {"r\xEA.csv", "\xC3", "\x80", "\xC0\x80", "\xE0\x80\x80", "\xED\xA0\x80",
                          "\xF4\x90\x80\x80", "\xFF", "a\xE2\x82"})
    EXPECT_FALSE(is_utf8(bad)) << bad;
}

TEST(NearestName, IsThatOfFewestEdits) {
  const std::vector<std::string> names = {"immediate", "play", "dead_zone", "none"};
  for (const std::string& name : names) {
    EXPECT_EQ(nearest_name(names, name), name);
    EXPECT_EQ(nearest_name(names, name.substr(1)), name);
    EXPECT_EQ(nearest_name(names, name + "s"), name);
  }
  EXPECT_EQ(nearest_name(names, "deadzone"), "dead_zone");
  EXPECT_EQ(nearest_name({"b", "a"}, "c"), "b");
}

TEST(Text, ARangeWhoseEndsReadAlikeIsOneNumber) {
  EXPECT_EQ(range_text("3", "5"), "3 to 5");
  EXPECT_EQ(range_text("3", "5", "from "), "from 3 to 5");
  EXPECT_EQ(range_text("6.5", "6.5", "from "), "6.5");
}

TEST(Text, ALongTextIsCutBetweenCharacters) {
  EXPECT_EQ(shortened("abc", 3), "abc");
  EXPECT_EQ(shortened("abcd", 3), "abc...");
  EXPECT_EQ(shortened("ab\xC3\xA9", 3), "ab...");
  EXPECT_EQ(shortened("\xC3\xA9x", 2), "\xC3\xA9...");
}

TEST(FormatRounded, GivesFiveDigitsAtMost) {
  const std::vector<std::pair<double, const char*>> texts = {
      {0.6000000000000001, "0.6"}, {1354.087523, "1354.1"}, {-2e-7, "-2e-07"}, {100.0, "100"}};
  for (const auto& [number, text] : texts) EXPECT_EQ(format_rounded(number), text);
}

}  // namespace
}  // namespace holdfast::program
