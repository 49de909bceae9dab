#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "case/case.hpp"
#include "holdfast/chaos/classification.hpp"
#include "holdfast/chaos/lyapunov_run.hpp"
#include "holdfast/motion/implemented_loop.hpp"
#include "holdfast/motion/modal/modal_motion.hpp"
#include "holdfast/orbit/orbit_search.hpp"
#include "holdfast/sweep/motion_metrics.hpp"
#include "holdfast/sweep/sweep_motion.hpp"
#include "kernels/instruction_set.hpp"

namespace holdfast::program {

/// The motion of a conductor by its modes.
struct ConductorMotion {
  ModalLoop loop;
  std::vector<PlantPole> poles;
  ModalMotion::Full state;  ///< the initial one
};

/// The motion of such a conductor, or of one mass, under a computer and a drive as they are built.
struct BuiltConductor {
  ImplementedLoopOf<ControlledPlant> loop;
  Vector<double, Eigen::Dynamic> state;  ///< the initial one
};

/// The motion of one cell of a sweep.
struct CellMotion {
  /// The motion of the paper's model; of another loop what that has of it: plant, sampling, gains
  /// and main harmonic, which the best gain depends on.
  SweepMotion of_paper;
  std::optional<ImplementedLoop> built;  ///< the loop, where it is another one
  /// The conductor, where the absorber hangs on that: then `of_paper` has the loop's numbers.
  std::shared_ptr<const ConductorMotion> conductor;
  /// The same with all that is built, where that is another loop: then `conductor` is of the plant.
  std::shared_ptr<const BuiltConductor> built_conductor;
};

/// Throws InvalidParameter where the loop is not admissible, WrongInput where a recorded force ends
/// before the duration; NoAnswer where natural motions cannot be told apart.
CellMotion cell_motion(const Case& the_case, Switching switching, double duration);

/// Of the two masses of the paper; throws WrongInput of other plants.
void set_differential_gain(CellMotion& motion, double gain);

/// The plant alone under the force that acts on it, which no computer holds: P = D = 0, a drive
/// without backlash, and samples that show the peaks of the motion; of the paper's model where
/// nothing else of the loop is left.
/// @param duration  s, of the motion
CellMotion without_control(const CellMotion& motion, double duration);

/// The metrics of each motion; those of the paper's model side by side, on the packs of the
/// instruction set. A motion that passes the divergence_bound() of its loop has diverged. Throws
/// Interrupted.
std::vector<MotionMetrics> metrics_of(const std::vector<CellMotion>& motions, double duration,
                                      InstructionSet set);

/// The metrics of a motion that is known to diverge beyond the samples that were taken of it.
MotionMetrics diverging(const MotionMetrics& metrics);

/// The run of the largest exponent alone over so many samples; nothing where the motion diverges or
/// the samples are none.
std::optional<LyapunovResult> run_largest_exponent(const CellMotion& motion, std::int64_t samples);

/// Per sample, over the whole duration; NaN where the motion diverges or is a single sample. This
/// and the following are of two masses.
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
