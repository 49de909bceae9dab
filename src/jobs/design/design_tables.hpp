#pragma once

#include <optional>

#include "case/axes/axis.hpp"
#include "process/job_context.hpp"

namespace holdfast::program {

/// Writes the best D at each frequency, P tuned to each by Eq. 6; without frequencies at the
/// case's own frequency and P.
/// @param largest_radius  the D of minimum amplitude keeps the spectral radius below it, > 0
/// Throws InvalidParameter for a frequency or radius that is not > 0, and what Table throws.
void write_best_gains(const JobContext& context, const std::optional<Axis>& frequencies,
                      double largest_radius);

/// Writes the one D whose largest amplitude over a band of frequencies (Hz) is least, at the
/// case's P.
/// Throws NoAnswer where no D is admissible, InvalidParameter for no band, and what Table throws.
void write_band_gain(const JobContext& context, const Range& band, double largest_radius);

/// Writes the P and D of minimum spectral radius.
/// Throws what Table throws.
void write_best_pair(const JobContext& context);

}  // namespace holdfast::program
