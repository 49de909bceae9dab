#pragma once

#include <vector>

#include "holdfast/stability/boundary/boundary_point.hpp"
#include "process/job_context.hpp"

namespace holdfast::program {

/// Writes the points of the curves on which a root leaves the stable region.
/// @param continuous  the loop without sampling
/// Throws InvalidParameter for a range without extent, and what Table throws.
void write_boundary(const JobContext& context, const ProportionalRange& gains, bool continuous);

/// Writes the special points of those curves within the window: tangents, cusps, crossings, ends.
/// Throws InvalidParameter for a window without extent, and what Table throws.
void write_boundary_features(const JobContext& context, const GainWindow& window, bool continuous);

/// Gains at which the stable intervals of the other gain are asked for.
struct FixedGains {
  std::vector<double> proportional;  ///< P (N/m): the intervals of D
  std::vector<double> differential;  ///< D (N s/m): the intervals of P
};

/// Writes one row for every stable interval: of D at each P, then of P at each D; the ends are
/// computed in extended precision.
///
/// A gain at which nothing stabilises the loop is warned of, since its row is missing.
/// Throws NoAnswer when there is no interval at all, and what Table throws.
void write_stable_intervals(const JobContext& context, const FixedGains& fixed, bool continuous);

/// Writes one row for every region of the window, the stable ones first, the larger first.
///
/// Throws InvalidParameter for a window without extent, and what Table throws.
void write_gain_regions(const JobContext& context, const GainWindow& window, bool continuous);

}  // namespace holdfast::program
