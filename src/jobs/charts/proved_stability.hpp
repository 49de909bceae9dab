#pragma once

#include "case/case.hpp"
#include "holdfast/stability/chart/proved_chart.hpp"
#include "io/text/names.hpp"

namespace holdfast::program {

/// What is proved, in tables.
inline constexpr Named<ProvedStability> proved_names[] = {
    {ProvedStability::stable, "stable"},
    {ProvedStability::unstable, "unstable"},
    {ProvedStability::undecided, "undecided"}};

/// The proved chart of a case of two masses. Throws Interrupted, and InvalidParameter for a grid
/// without cells.
ProvedChart proved_stability_of(const Case& the_case, const GainGrid& grid, bool continuous,
                                double undecided);

}  // namespace holdfast::program
