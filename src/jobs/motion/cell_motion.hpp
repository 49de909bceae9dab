#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "case/case.hpp"
#include "holdfast/chaos/classification.hpp"
#include "holdfast/motion/implemented_loop.hpp"
#include "holdfast/orbit/orbit_search.hpp"
#include "holdfast/sweep/motion_metrics.hpp"
#include "holdfast/sweep/sweep_motion.hpp"
#include "kernels/instruction_set.hpp"

namespace holdfast::program {

/// The motion of one cell of a sweep.
struct CellMotion {
  /// The motion of the paper's model; of another loop what that has of it: plant, sampling, gains
  /// and main harmonic, which the best gain depends on.
  SweepMotion of_paper;
  std::optional<ImplementedLoop> built;  ///< the loop, where it is another one
};

/// Throws InvalidParameter where the loop is not admissible, WrongInput where a recorded force ends
/// before the duration.
CellMotion cell_motion(const Case& the_case, Switching switching, double duration);

void set_differential_gain(CellMotion& motion, double gain);

/// The same with P = D = 0 and a drive without backlash; of the paper's model where nothing else of
/// the loop is left.
CellMotion without_control(const CellMotion& motion);

/// The metrics of each motion; those of the paper's model side by side, on the packs of the
/// instruction set. Throws Interrupted.
std::vector<MotionMetrics> metrics_of(const std::vector<CellMotion>& motions, double duration,
                                      InstructionSet set);

/// Per sample, over the whole duration; NaN where the motion diverges or is a single sample.
double largest_exponent_of(const CellMotion& motion, double duration);

/// Samples of the certified orbit; 0 where none is found.
std::int64_t period_of(const CellMotion& motion, const OrbitLimits& limits);

/// The verdict and the period of its certified orbit.
struct CellVerdict {
  AttractorType kind;
  std::int64_t period;  ///< samples; 0: none
};
CellVerdict verdict_of(const CellMotion& motion, const OrbitLimits& limits);

}  // namespace holdfast::program
