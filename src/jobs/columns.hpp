#pragma once

#include <string>
#include <vector>

#include "output/grid/grid_output.hpp"
#include "text/text.hpp"

namespace holdfast::program {

/// The columns of a table, as texts/jobs.toml has them.
/// @param table   "gain regions"
/// @param values  what the texts leave open
std::vector<Column> columns_of(const std::string& table, const Values& values = {});

/// Columns of a grid with the words of their numbers.
std::vector<CellColumn> cell_columns_of(const std::string& table, const Values& values = {});

}  // namespace holdfast::program
