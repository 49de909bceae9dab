#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "case/case.hpp"
#include "case/model/moving_loop.hpp"
#include "holdfast/chaos/classification.hpp"
#include "holdfast/chaos/lyapunov_run.hpp"
#include "holdfast/orbit/orbit_search.hpp"
#include "holdfast/sweep/motion_metrics.hpp"
#include "jobs/motion/case_motion.hpp"
#include "kernels/instruction_set.hpp"

namespace holdfast::program {

/// The motion of one cell of a sweep. Throws InvalidParameter where the loop is not admissible,
/// WrongInput where a recorded force ends before the duration; NoAnswer where natural motions
/// cannot be told apart.
MovingLoop cell_motion(const Case& the_case, Switching switching, double duration);

/// The metrics of each motion; those of the paper's model side by side, on the packs of the
/// instruction set. A motion that passes the divergence_bound() of its loop has diverged. Throws
/// Interrupted.
std::vector<MotionMetrics> metrics_of(const std::vector<MovingLoop>& motions, double duration,
                                      InstructionSet set);

/// The metrics of a motion that is known to diverge beyond the samples that were taken of it.
MotionMetrics diverging(const MotionMetrics& metrics);

/// The exponents of a motion and where it ended: of one from sample to sample the time alone.
struct ExponentsOfMotion {
  LyapunovResult result;
  ReachedState end;
};

/// The exponents of any moving loop; throws Interrupted.
/// @param tangents  sampling of the loop whose S and S* are the tangents of sampled masses; else
///                  that of the motion
ExponentsOfMotion exponents_of(const MovingLoop& motion, const LyapunovRun& run,
                               const std::optional<Sampling<double>>& tangents = {});

/// The run of the largest exponent alone over so many samples; nothing where the motion diverges or
/// the samples are none.
std::optional<LyapunovResult> run_largest_exponent(const MovingLoop& motion, std::int64_t samples);

/// Per sample, over the whole duration; NaN where the motion diverges or is a single sample.
double largest_exponent_of(const MovingLoop& motion, double duration);

/// Samples of the certified orbit; 0 where none is found.
std::int64_t period_of(const MovingLoop& motion, const OrbitLimits& limits);

/// The verdict and the period of its certified orbit.
struct CellVerdict {
  AttractorType kind;
  std::int64_t period;  ///< samples; 0: none
};
CellVerdict verdict_of(const MovingLoop& motion, const OrbitLimits& limits);

}  // namespace holdfast::program
