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

/// Everything that determines the numbers of a store, by name and text: {"version", "0.9.0"},
/// {"--axis 1", "backlash.width=0:0.003:61"}. Processes with equal plans may fill one store.
using StorePlan = std::map<std::string, std::string>;

/// Checksum of a plan, which identifies the plan in the seals of a store's files.
std::string plan_identity(const StorePlan& plan);

/// Differences of two plans, each entry with both texts: "--duration was 20, is 60; --kick was
/// 1:0.1, is not given". Empty for equal plans.
std::string plan_differences(const StorePlan& before, const StorePlan& now);

/// Appends every key of the case, and checksums of the data that it reads from files, to a plan.
void append_case(StorePlan& plan, const Case& the_case);

/// Number type of an array, with the value of cells that are not computed yet.
enum class ElementType {
  real,     ///< double; NaN if not computed
  integer,  ///< 64 bits; −2⁶³ if not computed
  byte,     ///< 8 bits, the index of a word; −1 if not computed
};

std::size_t size_of(ElementType type);

/// Contents of a store of cells.
struct StoreDescription {
  JobContext origin;  ///< job, options and case of the store
  std::vector<GridAxis> axes;
  std::vector<CellColumn> columns;  ///< columns; those of the job's table come first
  std::size_t table_columns = 0;    ///< number of columns of the job's table
  ChunkGrid grid;
  StorePlan plan;
  ChunkPacking packing = usual_packing();
};

/// One array of a store.
struct StoreArray {
  std::string name;  ///< name of the array and of its folder
  ElementType type;
  ChunkGrid grid;
};

/// The arrays of a store: the coordinates of each axis, then the columns.
std::vector<StoreArray> arrays_of(const StoreDescription& store);

/// Paths of files, with their texts.
using Documents = std::vector<std::pair<std::filesystem::path, std::string>>;

/// The files that describe a store, with paths relative to its folder, and their texts. The root is
/// last: without the root there is no store. Readers find all descriptions in one file, the
/// consolidated metadata.
Documents store_documents(const StoreDescription& store);

/// Name of the root file of a store.
inline constexpr const char* store_root = "zarr.json";

/// Description of a store from the text of its root file, which lacks the values of the axes.
/// Throws only std::invalid_argument, if the text is damaged or not by holdfast, for example with
/// paths as array names.
StoreDescription read_description(std::string_view root);

}  // namespace holdfast::program
