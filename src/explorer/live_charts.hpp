#pragma once

#include <cstdint>
#include <vector>

#include "case/case.hpp"
#include "holdfast/core/axis.hpp"
#include "holdfast/stability/chart/chart.hpp"

namespace holdfast::program {

// Charts that the explorer redraws while the user moves a control: the numbers of the jobs
// `stability` and `response` without their tables.

/// Cells of a stability chart over the gains P and D, P slowest: 1 if the loop without play is
/// stable, else 0. Any plant of a case is possible. Throws InvalidParameter, WrongInput.
std::vector<std::uint8_t> stable_cells(const Case& the_case, const GainGrid& grid);

/// Steady amplitudes of the conductor (m) at a frequency (Hz), without play.
struct AmplitudesAt {
  double frequency;
  double controlled;    ///< with control; NaN if unstable, or at two samples per period or less
  double uncontrolled;  ///< amplitude without control
};

/// Steady amplitudes over the excitation frequency, for the case's force amplitude and gains.
struct Amplitudes {
  bool stable;  ///< whether the loop without play is stable
  std::vector<AmplitudesAt> at;
};

/// Computes the amplitudes. @param frequencies  frequencies (Hz), > 0
Amplitudes amplitudes_over(const Case& the_case, const Axis& frequencies);

}  // namespace holdfast::program
