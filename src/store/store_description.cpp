#include "store/store_description.hpp"

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>
#include <stdexcept>

#include "case/case_file.hpp"
#include "case/device/impedance_table.hpp"
#include "holdfast/excitation/recorded_force.hpp"
#include "io/file/folder_lock.hpp"
#include "output/grid/grid_attributes.hpp"
#include "process/errors.hpp"
#include "text/checksum.hpp"

namespace holdfast::program {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string shown(const StorePlan& plan, const std::string& name) {
  const auto entry = plan.find(name);
  return entry == plan.end() ? "not given" : entry->second;
}

std::string_view bytes_of(const std::vector<double>& numbers) {
  return {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(double)};
}

/// Checksum of lists of numbers, by which another record of the same name is noticed.
template <class... Lists>
std::string checksum_of(const Lists&... lists) {
  std::uint64_t sum = 0;
  ((sum = checksum(bytes_of(lists), sum)), ...);
  return std::to_string(sum);
}

Json json_of(const Attributes& attributes) {
  Json json = Json::object();
  for (const auto& [name, text] : attributes) json[name] = text;
  return json;
}

Json json_of(const Column& column) {
  return {{"name", column.name},
          {"unit", column.unit},
          {"description", column.description},
          {"datatype", column.datatype}};
}

Column column_of(const Json& json) {
  return {json.at("name").get<std::string>(), json.at("unit").get<std::string>(),
          json.at("description").get<std::string>(), json.at("datatype").get<std::string>()};
}

/// Attribute from which holdfast continues or converts the store, in addition to those of CF.
Json holdfast_attribute(const StoreDescription& store) {
  const JobContext& origin = store.origin;
  Json json = {{"version", computed_by(origin)}, {"job", origin.job}};
  json["options"] = origin.options;
  if (origin.case_source.text) json["case_file"] = origin.case_source.name;
  json["set"] = origin.case_source.overrides;
  if (origin.on_packs) json["instructions"] = name_of(origin.instructions);
  json["axes"] = Json::array();
  for (const GridAxis& axis : store.axes) json["axes"].push_back(json_of(axis.column));
  json["columns"] = Json::array();
  for (const CellColumn& cells : store.columns) {
    Json column = json_of(cells.column);
    if (!cells.words.empty()) column["words"] = cells.words;
    json["columns"].push_back(column);
  }
  json["table_columns"] = store.table_columns;
  json["shape"] = store.grid.shape;
  json["chunk"] = store.grid.chunk;
  json["packing"] = store.packing == ChunkPacking::zstd ? "zstd" : "crc32c";
  json["plan"] = store.plan;
  return json;
}

Json root_attributes(const StoreDescription& store) {
  Json attributes = json_of(origin_attributes(store.origin));
  attributes["holdfast"] = holdfast_attribute(store);
  return attributes;
}

ElementType element_type_of(const CellColumn& column) {
  if (!column.words.empty()) return ElementType::byte;
  return column.column.datatype == "integer" ? ElementType::integer : ElementType::real;
}

Json attributes_of(const CellColumn& column) {
  Json attributes = json_of(column_attributes(column));
  if (column.words.empty()) return attributes;
  std::vector<int> numbers(column.words.size());
  std::iota(numbers.begin(), numbers.end(), 0);
  attributes["flag_values"] = numbers;
  return attributes;
}

/// An array with its dimensions and attributes.
struct ArrayDescription : StoreArray {
  std::vector<std::string> dimensions;
  Json attributes;
};

std::vector<ArrayDescription> described_arrays(const StoreDescription& store) {
  const std::vector<StoreArray> arrays = arrays_of(store);
  std::vector<ArrayDescription> described;
  std::vector<std::string> dimensions;
  for (std::size_t k = 0; k < store.axes.size(); ++k) {
    dimensions.push_back(arrays[k].name);
    described.push_back(
        {arrays[k], {arrays[k].name}, json_of(axis_attributes(store.axes[k].column))});
  }
  for (std::size_t k = 0; k < store.columns.size(); ++k)
    described.push_back(
        {arrays[store.axes.size() + k], dimensions, attributes_of(store.columns[k])});
  return described;
}

Json fill_value(ElementType type) {
  if (type == ElementType::real) return "NaN";
  if (type == ElementType::integer) return std::numeric_limits<std::int64_t>::min();
  return -1;
}

Json codecs_of(ElementType type, ChunkPacking packing) {
  Json bytes = {{"name", "bytes"}};
  if (type != ElementType::byte) bytes["configuration"] = {{"endian", "little"}};
  Json last = {{"name", "crc32c"}};
  if (packing == ChunkPacking::zstd)
    last = {{"name", "zstd"}, {"configuration", {{"level", zstd_level}, {"checksum", true}}}};
  return Json::array({bytes, last});
}

Json json_of(const ArrayDescription& array, ChunkPacking packing) {
  constexpr std::array<const char*, 3> names = {"float64", "int64", "int8"};
  Json json = {{"zarr_format", 3}, {"node_type", "array"}};
  json["shape"] = array.grid.shape;
  json["data_type"] = names.at(static_cast<std::size_t>(array.type));
  json["chunk_grid"] = {{"name", "regular"},
                        {"configuration", {{"chunk_shape", array.grid.chunk}}}};
  json["chunk_key_encoding"] = {{"name", "default"}, {"configuration", {{"separator", "."}}}};
  json["fill_value"] = fill_value(array.type);
  json["codecs"] = codecs_of(array.type, packing);
  json["attributes"] = array.attributes;
  json["dimension_names"] = array.dimensions;
  json["storage_transformers"] = Json::array();
  return json;
}

std::string text_of(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

/// The root document with an added checksum of its other content.
Json sealed(Json root) {
  // Parsed again, since text_of() has replaced bytes that are not UTF-8.
  root = Json::parse(text_of(root));
  const std::string sum = std::to_string(checksum(text_of(root)));
  root["attributes"]["holdfast"]["checksum"] = sum;
  return root;
}

void require(bool holds) {
  if (!holds) throw std::invalid_argument("its description is not one that holdfast writes");
}

/// The root document without its checksum. Throws std::invalid_argument if the checksum is wrong.
Json unsealed(Json root) {
  Json& part = root.at("attributes").at("holdfast");
  const auto sum = part.at("checksum").get<std::string>();
  part.erase("checksum");
  require(sum == std::to_string(checksum(text_of(root))));
  return root;
}

/// Whether a name is valid for an array and its folder: letters, digits and underscores, and
/// different from all names before.
bool is_array_name(const std::string& name, std::set<std::string>& before) {
  const auto is_of_name = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  };
  return !name.empty() && name.size() < 200 && name != FolderLock::file_name &&
         std::all_of(name.begin(), name.end(), is_of_name) && before.insert(name).second;
}

CellColumn cells_of(const Json& json) {
  CellColumn cells{column_of(json), {}};
  if (json.contains("words")) cells.words = json["words"].get<std::vector<std::string>>();
  return cells;
}

JobContext origin_of(const Json& attributes, const Json& json) {
  JobContext origin;
  origin.version = json.at("version").get<std::string>();
  origin.job = json.at("job").get<std::string>();
  origin.options = json.at("options").get<decltype(origin.options)>();
  if (json.contains("case_file")) {
    origin.case_source.name = json["case_file"].get<std::string>();
    origin.case_source.text = "";
  }
  origin.case_source.overrides = json.at("set").get<std::vector<std::string>>();
  if (json.contains("instructions")) {
    origin.on_packs = true;
    origin.instructions = instruction_set_named(json["instructions"].get<std::string>());
  }
  origin.case_data =
      load_case_text(attributes.at("case").get<std::string>(), "the case of the store", {});
  return origin;
}

/// Whether the chunks have a shape that chunk_shape() gives, so that each is a run of cells.
bool is_sound(const ChunkGrid& grid) {
  const auto positive = [](std::size_t count) { return count > 0; };
  if (grid.shape.empty() || grid.shape.size() != grid.chunk.size()) return false;
  if (!std::all_of(grid.shape.begin(), grid.shape.end(), positive)) return false;
  if (!std::all_of(grid.chunk.begin(), grid.chunk.end(), positive)) return false;
  constexpr double most_cells = 9007199254740992.0, most_of_file = 16777216.0;  // 2^53, 2^24
  double cells = 1.0, of_file = 1.0;
  for (std::size_t axis = 0; axis < grid.shape.size(); ++axis) {
    cells *= static_cast<double>(grid.shape[axis]);
    of_file *= static_cast<double>(grid.chunk[axis]);
    if (grid.chunk[axis] > grid.shape[axis]) return false;
  }
  if (cells > most_cells || of_file > most_of_file) return false;
  return grid.chunk == chunk_shape(grid.shape, static_cast<std::size_t>(of_file));
}

StoreDescription description_of(const Json& attributes) {
  const Json& json = attributes.at("holdfast");
  StoreDescription store;
  store.origin = origin_of(attributes, json);
  for (const Json& axis : json.at("axes")) store.axes.push_back({column_of(axis), {}});
  for (const Json& column : json.at("columns")) store.columns.push_back(cells_of(column));
  store.table_columns = json.at("table_columns").get<std::size_t>();
  store.grid.shape = json.at("shape").get<std::vector<std::size_t>>();
  store.grid.chunk = json.at("chunk").get<std::vector<std::size_t>>();
  store.plan = json.at("plan").get<StorePlan>();
  const auto packing = json.at("packing").get<std::string>();
  require(packing == "zstd" || packing == "crc32c");
  store.packing = packing == "zstd" ? ChunkPacking::zstd : ChunkPacking::checksum;
  require(is_sound(store.grid) && store.axes.size() == store.grid.shape.size());
  require(store.table_columns > 0 && store.table_columns <= store.columns.size());
  std::set<std::string> names;
  for (const StoreArray& array : arrays_of(store)) require(is_array_name(array.name, names));
  return store;
}

}  // namespace

std::string plan_identity(const StorePlan& plan) {
  return std::to_string(checksum(Json(plan).dump(-1, ' ', false, Json::error_handler_t::replace)));
}

std::vector<StoreArray> arrays_of(const StoreDescription& store) {
  std::vector<StoreArray> arrays;
  for (std::size_t k = 0; k < store.axes.size(); ++k) {
    const std::size_t count = store.grid.shape[k];
    arrays.push_back({cf_name(store.axes[k].column.name),
                      ElementType::real,
                      {{count}, chunk_shape({count}, values_in_chunk)}});
  }
  for (const CellColumn& cells : store.columns)
    arrays.push_back({cf_name(cells.column.name), element_type_of(cells), store.grid});
  return arrays;
}

std::string plan_differences(const StorePlan& before, const StorePlan& now) {
  StorePlan all = before;
  all.insert(now.begin(), now.end());
  std::string differences;
  for (const auto& [name, text] : all) {
    const std::string was = shown(before, name), is = shown(now, name);
    if (before.count(name) == now.count(name) && was == is) continue;
    differences += (differences.empty() ? "" : "; ") + name + " was " + was + ", is " + is;
  }
  return differences;
}

void append_case(StorePlan& plan, const Case& the_case) {
  if (the_case.force_record)
    plan.emplace("force record",
                 checksum_of(the_case.force_record->times(), the_case.force_record->forces()));
  for (std::size_t k = 0; k < the_case.devices.size(); ++k)
    if (const auto& table = the_case.devices[k].table)
      plan.emplace("impedance " + std::to_string(k + 1),
                   checksum_of(table->frequency, table->magnitude, table->phase_deg));
  const Json json = case_to_json(the_case);
  for (const auto& [table, keys] : json.items())
    for (const auto& [key, value] : keys.items()) plan.emplace(table + "." + key, value.dump());
}

std::size_t size_of(ElementType type) { return type == ElementType::byte ? 1 : 8; }

Documents store_documents(const StoreDescription& store) {
  Documents documents;
  Json consolidated = Json::object();
  for (const ArrayDescription& array : described_arrays(store)) {
    const Json json = json_of(array, store.packing);
    documents.emplace_back(fs::path(array.name) / store_root, text_of(json));
    consolidated[array.name] = json;
  }
  Json root = {{"zarr_format", 3}, {"node_type", "group"}};
  root["attributes"] = root_attributes(store);
  root["consolidated_metadata"] = {
      {"kind", "inline"}, {"must_understand", false}, {"metadata", consolidated}};
  documents.emplace_back(store_root, text_of(sealed(root)));
  return documents;
}

StoreDescription read_description(std::string_view root) {
  try {
    return description_of(unsealed(Json::parse(root)).at("attributes"));
  } catch (const Json::exception& fault) {
    throw std::invalid_argument(fault.what());
  } catch (const Refusal& fault) {
    throw std::invalid_argument(fault.what());
  }
}

}  // namespace holdfast::program
