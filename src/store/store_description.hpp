#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "case/job_context.hpp"
#include "output/grid/chunk_grid.hpp"
#include "output/grid/grid_output.hpp"
#include "store/chunk_packing.hpp"

namespace holdfast::program {

/// Everything that the numbers of a store depend on, name and text: {"version", "0.9.0"},
/// {"--axis 1", "backlash.width=0:0.003:61"}. Processes that agree in it may fill one store.
using StorePlan = std::map<std::string, std::string>;

/// A number that tells one plan from others, for the seals of a store's files.
std::string plan_identity(const StorePlan& plan);

/// Differences of two plans, each entry with both texts: "--duration was 20, is 60; --kick was
/// 1:0.1, is not given". Empty for the same plan.
std::string plan_differences(const StorePlan& before, const StorePlan& now);

/// Appends the case, key by key, and what it reads from files, by their checksums.
void append_case(StorePlan& plan, const Case& the_case);

/// The kind of the numbers of an array.
enum class ElementType {
  real,     ///< doubles, NaN where nothing is computed yet
  integer,  ///< 64 bits, −2⁶³ there
  byte,     ///< 8 bits, the numbers of words, −1 there
};

std::size_t size_of(ElementType type);

/// Contents of a store of cells.
struct StoreDescription {
  JobContext origin;  ///< job, options and case that made it
  std::vector<GridAxis> axes;
  std::vector<CellColumn> columns;  ///< those of the job's table first
  std::size_t table_columns = 0;    ///< so many of them
  ChunkGrid grid;
  StorePlan plan;
  int format = 3;  ///< of Zarr, 2 or 3
  ChunkPacking packing = usual_packing();
};

/// One array of a store.
struct StoreArray {
  std::string name;  ///< and that of its folder
  ElementType type;
  ChunkGrid grid;
};

/// The arrays of a store: the coordinates of each axis, then the columns.
std::vector<StoreArray> arrays_of(const StoreDescription& store);

/// Files and their texts.
using Documents = std::vector<std::pair<std::filesystem::path, std::string>>;

/// The files that describe a store and their texts, relative to its folder, the root last, without
/// which there is no store. After them readers find all in one file, the consolidated metadata.
/// Throws NoAnswer where format 2 is asked for and the program has no codec that it knows.
Documents store_documents(const StoreDescription& store);

/// The root documents of the formats, of which every store has one.
inline constexpr const char* root_of_format_3 = "zarr.json";
inline constexpr const char* root_of_format_2 = ".zattrs";

/// The description in such a root. The values of the axes are not in it. Throws
/// std::invalid_argument, and nothing else, where it is none of holdfast's: damaged, or with names
/// of arrays that are none of its own, such as paths.
StoreDescription read_description(std::string_view root, int format);

}  // namespace holdfast::program
