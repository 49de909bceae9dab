#pragma once

#include <memory>

#include "case/axes/grid.hpp"
#include "process/job_context.hpp"

namespace holdfast::program {

/// A chart as netCDF-4, after the CF conventions 1.10, readable as it is by xarray and ncdump.
///
/// The two axes are dimensions with coordinate variables of their names, the columns variables over
/// (slow, fast). The file's attributes hold version, job, options and the full case as TOML, so
/// that there is no metadata file beside it. Rows are written in blocks of 2^16 values, or one row
/// where that is more; no more than that and the library's caches is kept in memory.
///
/// Throws NoAnswer in a program without netCDF, WrongInput where the output is no file.
std::unique_ptr<GridWriter> netcdf_grid(const JobContext& context, GridLayout layout);

}  // namespace holdfast::program
