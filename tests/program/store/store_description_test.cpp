#include "store/store_description.hpp"

#include <nlohmann/json.hpp>

#include "program/store/small_store.hpp"
#include "support/testing.hpp"
#include "text/checksum.hpp"

namespace holdfast::program {
namespace {

using Json = nlohmann::ordered_json;

/// A root with the checksum that belongs to it, which a crafted one would have too.
std::string sealed(Json root) {
  root["attributes"]["holdfast"].erase("checksum");
  const std::string sum = std::to_string(checksum(root.dump(2) + "\n"));
  root["attributes"]["holdfast"]["checksum"] = sum;
  return root.dump();
}

StoreDescription read_back(const StoreDescription& store) {
  return read_description(store_documents(store).back().second);
}

TEST(StoreDescription, ReadsWhatItsRootTells) {
  const StoreDescription store = small_store();
  StoreDescription read = read_back(store);
  EXPECT_EQ(read.origin.job, "sweep");
  EXPECT_EQ(read.origin.options, store.origin.options);
  EXPECT_EQ(read.origin.case_source.name, "my.toml");
  EXPECT_EQ(read.origin.case_source.overrides, store.origin.case_source.overrides);
  EXPECT_EQ(case_to_toml(read.origin.case_data), case_to_toml(store.origin.case_data));
  EXPECT_EQ(read.grid.shape, store.grid.shape);
  EXPECT_EQ(read.grid.chunk, store.grid.chunk);
  EXPECT_EQ(read.table_columns, 2U);
  EXPECT_EQ(read.plan, store.plan);
  ASSERT_EQ(read.columns.size(), 3U);
  EXPECT_EQ(read.columns[0].column.unit, "N.s/m");
  EXPECT_EQ(read.columns[2].words, store.columns[2].words);
  read.axes = store.axes;  // whose values lie in arrays of their own
  EXPECT_EQ(store_documents(read).back().second, store_documents(store).back().second);
}

TEST(StoreDescription, ItsRootLastHoldsWhatTheArraysSay) {
  const auto documents = store_documents(small_store());
  EXPECT_EQ(documents.back().first, "zarr.json");
  const auto root = nlohmann::json::parse(documents.back().second);
  const auto& all = root["consolidated_metadata"]["metadata"];
  EXPECT_EQ(all.size(), documents.size() - 1);
  for (std::size_t k = 0; k + 1 < documents.size(); ++k)
    EXPECT_EQ(all[documents[k].first.parent_path().string()],
              nlohmann::json::parse(documents[k].second));
  EXPECT_EQ(all["steady_peak"]["attributes"]["units"], "N s m-1");
  EXPECT_EQ(all["steady_peak"]["chunk_grid"]["configuration"]["chunk_shape"],
            (std::vector<int>{2, 5}));
  EXPECT_EQ(all["kind"]["attributes"]["flag_meanings"], "periodic chaotic");
  EXPECT_EQ(all["backlash_width"]["attributes"]["key"], "backlash.width");
}

TEST(StoreDescription, OfAnythingElseIsRefused) {
  const std::string root = store_documents(small_store()).back().second;
  EXPECT_NO_THROW(read_description(root));
  for (const std::string& text :
       {std::string(), std::string("{}"), std::string("[1,2"), root.substr(0, root.size() / 2)})
    EXPECT_THROW(read_description(text), std::invalid_argument) << text.substr(0, 40);
  const auto with = [&](const std::string& key, const Json& value) {
    Json json = Json::parse(root);
    json["attributes"]["holdfast"][key] = value;
    return sealed(json);
  };
  EXPECT_NO_THROW(read_description(with("chunk", {2, 5})));
  const std::vector<std::pair<const char*, Json>> refused = {
      {"chunk", {2, 4}},    {"chunk", Json::array({2})},
      {"chunk", {0, 5}},    {"shape", {7, 5000000000000000000}},
      {"table_columns", 4}, {"packing", "gzip"},
      {"plan", 3}};
  for (const auto& [key, value] : refused)
    EXPECT_THROW(read_description(with(key, value)), std::invalid_argument) << key << value;
}

// Names become those of folders, in which files are written and removed.
TEST(StoreDescription, ANameThatCouldBeAPathIsNone) {
  const Json root = Json::parse(store_documents(small_store()).back().second);
  const auto named = [&](const char* list, const std::string& name) {
    Json crafted = root;
    crafted["attributes"]["holdfast"][list].back()["name"] = name;
    return sealed(crafted);
  };
  for (const char* list : {"axes", "columns"}) {
    EXPECT_NO_THROW(read_description(named(list, "another.name_2")));
    for (const char* name : {"", "/", "/home/me", "../other", "l/thesis", "a/../b", "steady_peak",
                             "lock", "c d", "\n", "a\\b", "\u00fc"})
      EXPECT_THROW(read_description(named(list, name)), std::invalid_argument) << name;
    EXPECT_THROW(read_description(named(list, std::string(4096, 'a'))), std::invalid_argument);
  }
}

TEST(StoreDescription, ARootOfWhichOneByteIsAnotherIsNone) {
  const std::string root = store_documents(small_store()).back().second;
  for (std::size_t place = 0; place < root.size(); place += 7) {
    std::string damaged = root;
    damaged[place] = damaged[place] == '1' ? '2' : '1';
    EXPECT_THROW(read_description(damaged), std::invalid_argument) << place;
  }
}

TEST(StorePlan, TellsEachEntryThatDiffers) {
  const StorePlan before = {{"--duration", "20"}, {"--kick", "1:0.1"}, {"version", "1"}};
  EXPECT_EQ(plan_differences(before, before), "");
  EXPECT_EQ(plan_differences(before, {{"--duration", "60"}, {"version", "1"}, {"x", "y"}}),
            "--duration was 20, is 60; --kick was 1:0.1, is not given; x was not given, is y");
}

}  // namespace
}  // namespace holdfast::program
