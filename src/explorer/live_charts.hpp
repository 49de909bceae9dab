#pragma once

#include <cstdint>
#include <vector>

#include "case/case.hpp"
#include "holdfast/core/axis.hpp"
#include "holdfast/stability/chart/chart.hpp"

namespace holdfast::program {

// Charts that the explorer draws anew while the hand still moves: the numbers of the jobs
// `stability` and `response` without their tables.

/// The cells of the job `stability` over P and D, P slowest: 1 where the loop without play is
/// stable. On any plant of the case. Throws InvalidParameter, WrongInput.
std::vector<std::uint8_t> stable_cells(const Case& the_case, const GainGrid& grid);

/// Steady amplitudes of the conductor (m) at a frequency (Hz), without play.
struct AmplitudesAt {
  double frequency;
  double controlled;    ///< NaN where the loop is not stable, or there are two samples a period
  double uncontrolled;  ///< under the true force
};

/// Amplitudes under forces of other frequencies than the case's, its gains as they are.
struct Amplitudes {
  bool stable;  ///< the loop without play
  std::vector<AmplitudesAt> at;
};

/// @param frequencies  above 0 Hz
Amplitudes amplitudes_over(const Case& the_case, const Axis& frequencies);

}  // namespace holdfast::program
