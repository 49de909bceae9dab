#pragma once

#include <cstdint>

#include "holdfast/motion/implemented_loop.hpp"
#include "holdfast/orbit/event/event_orbit.hpp"
#include "process/job_context.hpp"

namespace holdfast::program {

/// The tables of orbit_tables.hpp for an implemented loop.

/// The periodic orbit that the motion comes to. Warns where a switching surface is near.
/// Throws NoAnswer, saying why, where there is none, or none with a certificate.
EventOrbit certified_orbit(const JobContext& context, const ImplementedLoop& loop,
                           std::int64_t largest_period);

/// One row, as of the paper's model; the distance is that of a turn inside the gap from its ends.
void write_orbit(const JobContext& context, const ImplementedLoop& loop,
                 std::int64_t largest_period);

/// The whole certificate, one quantity a row: ratio of the frequencies, period, multipliers with
/// the saltation at the switches, margins, shares and numbers of the modes.
void write_certificate(const JobContext& context, const ImplementedLoop& loop,
                       std::int64_t largest_period);

/// The orbit's samples, with the columns of `simulate`: one period and the sample that closes it.
void write_orbit_trace(const JobContext& context, const ImplementedLoop& loop,
                       std::int64_t largest_period);

}  // namespace holdfast::program
