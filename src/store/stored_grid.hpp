#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>

#include "case/job_context.hpp"
#include "output/grid/grid_output.hpp"
#include "store/store_description.hpp"
#include "store/store_folder.hpp"

namespace holdfast::program {

/// Description of a store for a job's grid. Its plan consists of the job, its options as given, and
/// the case. Throws WrongInput for a case with a user-defined plant.
/// @param most  largest number of cells of a chunk
StoreDescription store_description(const JobContext& context, const GridLayout& layout,
                                   std::size_t most = values_in_chunk);

/// Throws NoAnswer, which names the chunk's file and says whether it is missing or damaged.
[[noreturn]] void refuse_chunk(const StoreFolder& store, std::int64_t chunk);

/// Appends the cells of a store to an output, in order, with the columns of the job's table.
/// Throws NoAnswer for the first missing or damaged chunk, and the exceptions of GridOutput.
void append_stored(const StoreFolder& store, GridOutput& output);

/// Writes a store as a table or a netCDF file, as the job itself would have.
/// Throws the exceptions of StoreFolder::open() and append_stored().
/// @param context  context of the job `convert`, with its output
void convert_store(const JobContext& context, const std::filesystem::path& folder);

}  // namespace holdfast::program
