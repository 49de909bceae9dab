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

/// Loop and initial state of one cell of a sweep. Throws InvalidParameter where the loop is not
/// admissible, WrongInput without absorber or where a recorded force ends before the duration (s),
/// NoAnswer where two poles nearly coincide.
MovingLoop cell_motion(const Case& the_case, Switching switching, double duration);

/// Metrics of each motion over a duration (s). Two masses are computed in SIMD lanes of `set` where
/// possible. A motion beyond its loop's divergence_bound() counts as diverged. Throws Interrupted.
std::vector<MotionMetrics> metrics_of(const std::vector<MovingLoop>& motions, double duration,
                                      InstructionSet set);

/// Metrics of a motion that diverges, although the computed samples do not overflow.
MotionMetrics diverging(const MotionMetrics& metrics);

/// Lyapunov exponents of a motion, and its end; in the paper's model only the end's time is set.
struct ExponentsOfMotion {
  LyapunovResult result;
  ReachedState end;
};

/// Lyapunov exponents of any moving loop; throws Interrupted.
/// @param tangents  sampling whose matrices S and S* are the tangent maps of two masses switching
///                  at samples; nullopt: the sampling of the motion
ExponentsOfMotion exponents_of(const MovingLoop& motion, const LyapunovRun& run,
                               const std::optional<Sampling<double>>& tangents = {});

/// Largest Lyapunov exponent; nullopt where the motion diverges or `samples` is below 1.
std::optional<LyapunovResult> run_largest_exponent(const MovingLoop& motion, std::int64_t samples);

/// Largest Lyapunov exponent per sample over a duration (s); NaN for divergence or a single sample.
double largest_exponent_of(const MovingLoop& motion, double duration);

/// Period of the certified orbit, in samples; 0 where none is found.
std::int64_t period_of(const MovingLoop& motion, const OrbitLimits& limits);

/// Verdict on a motion and the period of its certified orbit.
struct CellVerdict {
  AttractorType kind;
  std::int64_t period;  ///< period (samples); 0: no certified orbit
};
CellVerdict verdict_of(const MovingLoop& motion, const OrbitLimits& limits);

}  // namespace holdfast::program
