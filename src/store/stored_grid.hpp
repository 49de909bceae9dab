#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>

#include "case/job_context.hpp"
#include "output/grid/grid_output.hpp"
#include "store/store_description.hpp"
#include "store/store_folder.hpp"

namespace holdfast::program {

/// The store of a job's grid; its plan is the job with its options as they were given, and the
/// case.
/// @param most  cells of a chunk
StoreDescription store_description(const JobContext& context, const GridLayout& layout,
                                   std::size_t most = values_in_chunk);

/// Throws NoAnswer, which names the chunk's file and says that it is missing or damaged.
[[noreturn]] void refuse_chunk(const StoreFolder& store, std::int64_t chunk);

/// Hands the cells of a store, those of the job's table, to an output, in order.
/// Throws NoAnswer where chunks are missing or damaged, naming the first, and what GridOutput
/// throws.
void append_stored(const StoreFolder& store, GridOutput& output);

/// Writes a store as a table, a netCDF file or another store, as the job itself would have.
/// Throws what StoreFolder::open() and append_stored() throw.
/// @param context  of the job `convert`; its output
void convert_store(const JobContext& context, const std::filesystem::path& folder);

}  // namespace holdfast::program
