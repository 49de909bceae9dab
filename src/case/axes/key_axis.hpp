#pragma once

#include "case/axes/axis.hpp"
#include "case/axes/grid.hpp"
#include "case/case_keys.hpp"

namespace holdfast::program {

/// An axis over a key of the case, as a table names and describes it; units as N.s/m.
GridAxis grid_axis(const CaseKey& key, const KeyValues& axis);
GridAxis grid_axis(const KeyAxis& axis);

}  // namespace holdfast::program
