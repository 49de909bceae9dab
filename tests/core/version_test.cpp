#include "holdfast/core/version.hpp"

#include "support/testing.hpp"

namespace holdfast {
namespace {

TEST(Version, parts_and_text_are_the_same_version) {
  const std::string joined = std::to_string(version_major) + "." + std::to_string(version_minor) +
                             "." + std::to_string(version_patch);
  EXPECT_EQ(joined, version_string);
}

TEST(Version, parts_of_more_than_one_digit_are_read_whole) {
  EXPECT_EQ(detail::version_part("10.203.4", 0), 10);
  EXPECT_EQ(detail::version_part("10.203.4", 1), 203);
  EXPECT_EQ(detail::version_part("10.203.4", 2), 4);
}

TEST(Version, header_and_build_system_agree) { EXPECT_EQ(version_string, HOLDFAST_VERSION); }

}  // namespace
}  // namespace holdfast
