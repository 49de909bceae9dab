#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

#include "holdfast/phase_space/lane_scheduler.hpp"
#include "holdfast/phase_space/motion_batch.hpp"
#include "holdfast/stability/chart/loop_chart.hpp"
#include "holdfast/sweep/event_metric_batch.hpp"
#include "holdfast/sweep/metric_observer.hpp"
#include "holdfast/sweep/sweep_matrices.hpp"
#include "kernels/instruction_set.hpp"

/// The loops of the program that run on packs, compiled once for each instruction set.
///
/// Everything that differs between the sets is behind this interface; everything around it is
/// compiled once, for the baseline. A unit for a wider set holds the kernels on its packs, whose
/// names bear the set because their type of pack does. What else the compiler leaves in it out of
/// line the linker takes from the baseline's units, which come first, wherever those have it
/// (cmake/kernels.cmake); tests/architecture/instructions_test.cmake looks that it did.

namespace holdfast::program {

/// Fills `count` rows of a chart of the sampled loop from `first` on: StabilityChartRows, and
/// RadiusChartRows where the spectral radius is asked for. Each tile of a chart has its own copy.
using ChartKernel = std::function<void(std::int64_t first, std::int64_t count, std::uint8_t* stable,
                                       double* radius)>;

/// Source of motions for the kernel of the metrics.
class MotionSource {
 public:
  virtual ~MotionSource() = default;
  /// The matrices of a loop, until it is asked again.
  virtual const detail::SweepMatrices::Matrices& of(const IdealLoop<double>& loop) = 0;
  /// Called every some hundred samples; may throw.
  virtual void pause() = 0;
};

/// Tells the orbit that a motion surely tends to, as AttractorSet does.
struct AttractionTest {
  std::function<int(const ForcedMotionMemory<double>& memory)> attracted_by;
};

/// Runs motions on a MotionBatch. Each tile of starts has its own copy.
using MotionKernel = std::function<void(ActiveTrajectory* motions, std::size_t count,
                                        std::int64_t samples, const AttractionTest& test)>;

/// The kernels of one instruction set.
struct PackKernels {
  /// Throws InvalidParameter where the chart is not admissible.
  ChartKernel (*chart)(const LoopChart& chart, bool radius);
  /// detail::group_metrics().
  void (*metrics)(const SweepMotion* motions, const detail::SampleSpan* spans, std::size_t count,
                  MotionMetrics* results, MotionSource& source);
  /// detail::group_event_metrics(); the source gives its pause.
  void (*event_metrics)(const detail::PreparedEventMotion* motions, std::size_t count,
                        MotionMetrics* results, MotionSource& source);
  /// run_on_lanes().
  void (*run_on_lanes)(const ImplementedLoop& loop, LaneScheduler& scheduler);
  MotionKernel (*propagate)(const PeriodicallyForcedMotion<double>& motion);
};

/// One unit each, compiled for its instruction set; those that the program does not have are not
/// defined. Call none of a set that the processor has not got.
const PackKernels& baseline_kernels();
const PackKernels& avx2_kernels();
const PackKernels& avx512_kernels();

/// Kernels of an available instruction set.
const PackKernels& pack_kernels(InstructionSet set);

}  // namespace holdfast::program
