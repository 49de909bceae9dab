#pragma once

#include <cstdint>
#include <string>

#include "holdfast/orbit/orbit_search.hpp"
#include "process/job_context.hpp"

namespace holdfast::program {

/// The periodic orbit that the case's motion comes to. Warns where a switching surface is near.
/// Throws NoAnswer, saying why, where there is none, or none with a certificate.
PeriodicOrbit certified_orbit(const JobContext& context, std::int64_t largest_period);

/// One row: period, multiplier, closure, distance to the nearest end of the gap, engagement.
void write_orbit(const JobContext& context, std::int64_t largest_period);

/// The whole certificate, one quantity a row: ratio of the frequencies, period, multipliers,
/// distances to the switching surfaces, radius of attraction, and the same orbit in extended
/// precision.
void write_certificate(const JobContext& context, std::int64_t largest_period);

/// The orbit's samples, with the columns of `simulate`: one period and the sample that closes it.
void write_orbit_trace(const JobContext& context, std::int64_t largest_period);

/// Where the orbit ends below and above the case's value of one key, and why: two rows.
/// @param axis  KEY=MIN:MAX
/// Throws WrongInput for a key that changes f τ or a range that does not hold the case's value.
void write_branch_ends(const JobContext& context, std::int64_t largest_period,
                       const std::string& axis);

}  // namespace holdfast::program
