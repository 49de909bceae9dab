#pragma once

#include <string>
#include <utility>
#include <vector>

#include "case/job_context.hpp"
#include "output/grid/grid_output.hpp"

namespace holdfast::program {

/// Attributes of a file of cells, or of an array in it, name and text, as the conventions CF 1.10
/// want them.
using Attributes = std::vector<std::pair<std::string, std::string>>;

/// Version, job, options and the full case as TOML. There is no date: the same question gives the
/// same attributes.
Attributes origin_attributes(const JobContext& context);

/// `long_name` and `units` of an axis, and its `key` where the file has it under another name.
Attributes axis_attributes(const Column& column);

/// `long_name` and `units` of a column, or `flag_meanings` of one with words; whose numbers are the
/// file's to write.
Attributes column_attributes(const CellColumn& column);

/// A name as such files have it (CF 2.3): a dot becomes an underscore.
std::string cf_name(std::string name);

/// A unit of the program's columns, `N.s/m`, as UDUNITS likes it: `N s m-1`; "1" for none.
std::string udunits(const std::string& unit);

}  // namespace holdfast::program
