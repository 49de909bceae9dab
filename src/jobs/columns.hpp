#pragma once

#include <string>
#include <vector>

#include "output/grid/grid_output.hpp"
#include "text/text.hpp"

namespace holdfast::program {

/// Columns of a table, from texts/jobs.toml.
/// @param table   name of the table, such as "gain regions"
/// @param values  replacements of @KEY@ in the texts
std::vector<Column> columns_of(const std::string& table, const Values& values = {});

/// Columns of a grid, each with the words that its integer values stand for.
std::vector<CellColumn> cell_columns_of(const std::string& table, const Values& values = {});

}  // namespace holdfast::program
