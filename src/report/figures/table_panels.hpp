#pragma once

#include <cstddef>
#include <vector>

#include "io/text/csv.hpp"
#include "report/figures/figure.hpp"
#include "text/text.hpp"

namespace holdfast::program {

/// The largest finite |value| (m) of the columns of a table whose unit is the metre; 0 for none.
double largest_length(const CsvTable& table);

/// What the texts leave open of the panels of a table over axes, one for each column behind those:
/// its label, its values, what its shades or, over one axis, its ordinate span, how it is drawn. A
/// column of words is drawn with a shade, or a height, a word.
std::vector<Values> panels_of(const CsvTable& table, std::size_t axes, const LengthUnit& unit);

}  // namespace holdfast::program
