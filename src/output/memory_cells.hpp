#pragma once

#include <memory>

#include "case/job_context.hpp"
#include "output/grid/grid_output.hpp"

namespace holdfast::program {

/// Whether the tables of a job go to the host of its thread: where it has one, and no --output.
bool is_received(const JobContext& context);

/// Cells that become a table of the host's, which there must be.
std::unique_ptr<CellWriter> memory_cells(const JobContext& context, const GridLayout& layout);

}  // namespace holdfast::program
