#pragma once

#include <memory>

#include "case/axes/grid.hpp"
#include "process/job_context.hpp"

namespace holdfast::program {

/// A chart as CSV with its metadata: the bytes of a Table with the columns slow axis, fast axis,
/// values, at less cost.
///
/// The text of an axis' value is formed once and copied into every row that it stands in; per cell
/// there remain two copies of fixed length, one character a flag and the digits of each real.
/// Throws what Table throws.
std::unique_ptr<GridWriter> csv_grid(const JobContext& context, GridLayout layout);

}  // namespace holdfast::program
