#pragma once

#include <memory>

#include "process/job_context.hpp"
#include "sweep/sweep_output.hpp"

namespace holdfast::program {

/// A sweep as netCDF-4, after the CF conventions 1.10, readable as it is by xarray and ncdump.
///
/// The axes are dimensions with coordinate variables of their names, the columns variables over
/// all of them: doubles, integers of 64 bits, and for words bytes with their meanings. There is no
/// metadata file beside it (NetcdfDataset). Cells are written 2^16 at a time, in chunks of so
/// many at most that are contiguous in their order, so that each chunk is compressed once; memory
/// holds a chunk and a portion of every column, for any grid.
///
/// Throws NoAnswer in a program without netCDF, and what NetcdfDataset throws.
std::unique_ptr<SweepWriter> sweep_netcdf(const JobContext& context, SweepLayout layout);

}  // namespace holdfast::program
