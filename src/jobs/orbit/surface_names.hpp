#pragma once

#include "holdfast/orbit/proof/enclosed_modes.hpp"
#include "holdfast/orbit/switching_borders.hpp"
#include "text/names.hpp"

namespace holdfast::program {

/// Switching surfaces, in tables and messages.
inline constexpr Named<SwitchingSurface> surface_names[] = {
    {SwitchingSurface::reversal, "reversal"},
    {SwitchingSurface::gap_lower, "gap_lower"},
    {SwitchingSurface::gap_upper, "gap_upper"}};

/// Those of a drive that switches between the samples.
inline constexpr Named<ContactSurface> contact_surface_names[] = {
    {ContactSurface::reversal, "reversal"},
    {ContactSurface::gap_lower, "gap_lower"},
    {ContactSurface::gap_upper, "gap_upper"},
    {ContactSurface::free_acceleration, "free_acceleration"},
    {ContactSurface::driven_acceleration, "driven_acceleration"},
    {ContactSurface::sampling_instant, "sampling_instant"}};

}  // namespace holdfast::program
