#include "io/file/build_record.hpp"

#include "support/testing.hpp"

#include <nlohmann/json.hpp>

namespace holdfast::program {
namespace {

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return text;
}

TEST(BuildRecord, NamesEachDependencyOnceWithAVersionAndALicence) {
  const auto all = dependencies();
  EXPECT_GE(all.size(), 4U) << "Eigen, CLI11, toml++ and nlohmann-json there always are";
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (k > 0) {
      EXPECT_LT(lower(all[k - 1].name), lower(all[k].name));
    }
    EXPECT_NE(std::count_if(all[k].version.begin(), all[k].version.end(), ::isdigit), 0)
        << all[k].name;
    EXPECT_NE(all[k].licence, "") << all[k].name;
  }
}

TEST(BuildRecord, TheVersionComesFirst) {
  const std::string text = version_text();
  EXPECT_EQ(text.substr(0, text.find('\n')), "holdfast " HOLDFAST_VERSION);
  for (const Dependency& dependency : dependencies())
    EXPECT_NE(text.find("\n  " + dependency.name + " " + dependency.version), std::string::npos);
}

TEST(BuildRecord, TheBillOfMaterialsHasWhatTheVersionTextHas) {
  const auto bill = nlohmann::json::parse(bill_of_materials());
  EXPECT_EQ(bill["bomFormat"], "CycloneDX");
  EXPECT_EQ(bill["metadata"]["component"]["name"], "holdfast");
  EXPECT_EQ(bill["metadata"]["component"]["version"], HOLDFAST_VERSION);
  const auto all = dependencies();
  ASSERT_EQ(bill["components"].size(), all.size());
  for (std::size_t k = 0; k < all.size(); ++k) {
    EXPECT_EQ(bill["components"][k]["name"], all[k].name);
    EXPECT_EQ(bill["components"][k]["version"], all[k].version);
    EXPECT_EQ(bill["components"][k]["licenses"][0]["expression"], all[k].licence);
  }
}

}  // namespace
}  // namespace holdfast::program
