#pragma once

#include "case/case.hpp"
#include "holdfast/stability/chart/proved_chart.hpp"
#include "text/names.hpp"

namespace holdfast::program {

/// What is proved, in tables.
inline constexpr Named<ProvedStability> proved_names[] = {
    {ProvedStability::stable, "stable"},
    {ProvedStability::unstable, "unstable"},
    {ProvedStability::undecided, "undecided"}};

/// The proved chart of a case. Throws Interrupted, InvalidParameter for a grid without cells,
/// WrongInput for a plant whose poles cannot be proved, and NoAnswer where they are not apart or
/// one may lie on the boundary.
ProvedChart proved_stability_of(const Case& the_case, const GainGrid& grid, bool continuous,
                                double undecided);

}  // namespace holdfast::program
