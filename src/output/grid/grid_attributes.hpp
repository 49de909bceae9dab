#pragma once

#include <string>
#include <utility>
#include <vector>

#include "case/job_context.hpp"
#include "output/grid/grid_output.hpp"

namespace holdfast::program {

/// Attributes of a file of cells, or of an array in it, by CF 1.10: names and texts.
using Attributes = std::vector<std::pair<std::string, std::string>>;

/// The attributes with version, job, options and the full case as TOML. There is no date: an equal
/// job gives equal attributes.
Attributes origin_attributes(const JobContext& context);

/// The attributes `long_name` and `units` of an axis; `key`: its key of the case, if renamed.
Attributes axis_attributes(const Column& column);

/// The attributes `long_name` and `units` of a column; for a column of words `flag_meanings`
/// instead of `units`. The caller writes their `flag_values`.
Attributes column_attributes(const CellColumn& column);

/// A name for CF files (CF 2.3): every dot becomes an underscore.
std::string cf_name(const std::string& name);

/// A unit of the program's columns, `N.s/m`, in the notation of UDUNITS: `N s m-1`; "1" for none.
std::string udunits(const std::string& unit);

}  // namespace holdfast::program
