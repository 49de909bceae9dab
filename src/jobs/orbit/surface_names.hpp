#pragma once

#include "holdfast/orbit/switching_borders.hpp"
#include "io/text/names.hpp"

namespace holdfast::program {

/// Switching surfaces, in tables and messages.
inline constexpr Named<SwitchingSurface> surface_names[] = {
    {SwitchingSurface::reversal, "reversal"},
    {SwitchingSurface::gap_lower, "gap_lower"},
    {SwitchingSurface::gap_upper, "gap_upper"}};

}  // namespace holdfast::program
