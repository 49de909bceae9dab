#pragma once

#include <memory>

#include "process/job_context.hpp"
#include "sweep/sweep_output.hpp"

namespace holdfast::program {

/// A sweep as CSV with its metadata: the bytes of a Table with a column for each axis, then the
/// columns of the layout, at less cost.
///
/// The texts of the axes stay from cell to cell, and only those that change are formed again; per
/// cell there remain two copies and the digits of each value. Throws what Table throws.
std::unique_ptr<SweepWriter> sweep_csv(const JobContext& context, SweepLayout layout);

}  // namespace holdfast::program
