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

/// Kernels of the program on SIMD packs, compiled once for each instruction set.
///
/// Everything that depends on the instruction set is behind this interface; all other code is
/// compiled once, for the baseline. A unit for a wider set contains the kernels on its packs; the
/// type of pack is part of their names. For other functions that the compiler does not inline, the
/// linker takes the copies of the baseline's units, which come first (cmake/kernels.cmake).
/// tests/architecture/instructions_test.cmake checks this.

namespace holdfast::program {

/// Kernel that fills `count` rows of a stability chart from row `first` on: StabilityChartRows, and
/// RadiusChartRows if the spectral radius is requested. Each tile of a chart has its own copy.
using ChartKernel = std::function<void(std::int64_t first, std::int64_t count, std::uint8_t* stable,
                                       double* radius)>;

/// Interface that gives matrices to the kernels of metrics and can interrupt them.
class MotionSource {
 public:
  virtual ~MotionSource() = default;
  /// Matrices of a loop; valid until the next call.
  virtual const detail::SweepMatrices::Matrices& of(const IdealLoop<double>& loop) = 0;
  /// Called after every few hundred samples; may throw to end the computation.
  virtual void pause() = 0;
};

/// Test which orbit a motion is guaranteed to approach: its number, or −1; see AttractorSet.
struct AttractionTest {
  std::function<int(const ForcedMotionMemory<double>& memory)> attracted_by;
};

/// Kernel that advances `count` motions over `samples` samples. Each thread uses its own copy.
using MotionKernel = std::function<void(ActiveTrajectory* motions, std::size_t count,
                                        std::int64_t samples, const AttractionTest& test)>;

/// The kernels of one instruction set.
struct PackKernels {
  /// Creates the kernel of a chart. Throws InvalidParameter if the chart is not admissible.
  ChartKernel (*chart)(const LoopChart& chart, bool radius);
  /// Computes the metrics of sampled motions by detail::group_metrics().
  void (*metrics)(const SweepMotion* motions, const detail::SampleSpan* spans, std::size_t count,
                  MotionMetrics* results, MotionSource& source);
  /// Computes metrics by detail::group_event_metrics(); of the source only pause() is used.
  void (*event_metrics)(const detail::PreparedEventMotion* motions, std::size_t count,
                        MotionMetrics* results, MotionSource& source);
  /// Runs motions of a loop on SIMD lanes by run_on_lanes().
  void (*run_on_lanes)(const ImplementedLoop& loop, LaneScheduler& scheduler);
  MotionKernel (*propagate)(const PeriodicallyForcedMotion<double>& motion);
};

/// Kernels of one instruction set; each of the three functions is compiled in a unit of its own.
/// A set that the program lacks has none defined. Call only a set that the processor has.
const PackKernels& baseline_kernels();
const PackKernels& avx2_kernels();
const PackKernels& avx512_kernels();

/// Kernels of an available instruction set, see available_instruction_sets().
const PackKernels& pack_kernels(InstructionSet set);

}  // namespace holdfast::program
