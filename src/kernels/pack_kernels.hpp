#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>

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

/// Rows of a chart of the sampled loop on the packs of an instruction set: StabilityChartRows, and
/// RadiusChartRows where the spectral radius is asked for.
class ChartKernel {
 public:
  virtual ~ChartKernel() = default;
  virtual std::unique_ptr<ChartKernel> copy() const = 0;
  /// @param radius  not read by a kernel without the spectral radius
  virtual void fill(std::int64_t first, std::int64_t count, std::uint8_t* stable,
                    double* radius) = 0;
};

/// Source of motions for the kernel of the metrics.
class MotionSource {
 public:
  virtual ~MotionSource() = default;
  /// The matrices of a loop, until it is asked again.
  virtual const detail::SweepMatrices::Matrices& of(const IdealLoop<double>& loop) = 0;
  /// Called every some hundred samples; may throw.
  virtual void pause() = 0;
};

/// Test of the orbit that a motion surely tends to, as AttractorSet has it.
class AttractionTest {
 public:
  virtual ~AttractionTest() = default;
  virtual int attracted_by(const ForcedMotionMemory<double>& memory) const = 0;
};

/// MotionBatch on the packs of an instruction set.
class MotionKernel {
 public:
  virtual ~MotionKernel() = default;
  virtual std::unique_ptr<MotionKernel> copy() const = 0;
  virtual void run(ActiveTrajectory* motions, std::size_t count, std::int64_t samples,
                   const AttractionTest& test) = 0;
};

/// A kernel that is copied with what has it, as each tile of a chart has its own.
template <class Kernel>
class CopiedKernel {
 public:
  explicit CopiedKernel(std::unique_ptr<Kernel> kernel) : kernel_(std::move(kernel)) {}
  ~CopiedKernel() = default;
  CopiedKernel(const CopiedKernel& other) : kernel_(other.kernel_->copy()) {}
  CopiedKernel& operator=(const CopiedKernel&) = delete;
  CopiedKernel(CopiedKernel&&) noexcept = default;
  CopiedKernel& operator=(CopiedKernel&&) noexcept = default;

  Kernel* operator->() { return kernel_.get(); }

 private:
  std::unique_ptr<Kernel> kernel_;
};

/// The kernels of one instruction set.
struct PackKernels {
  /// Throws InvalidParameter where the chart is not admissible.
  std::unique_ptr<ChartKernel> (*chart)(const LoopChart& chart, bool radius);
  /// detail::group_metrics().
  void (*metrics)(const SweepMotion* motions, const detail::SampleSpan* spans, std::size_t count,
                  MotionMetrics* results, MotionSource& source);
  /// detail::group_event_metrics(); the source gives its pause.
  void (*event_metrics)(const detail::PreparedEventMotion* motions, std::size_t count,
                        MotionMetrics* results, MotionSource& source);
  /// run_on_lanes().
  void (*run_on_lanes)(const ImplementedLoop& loop, LaneScheduler& scheduler);
  std::unique_ptr<MotionKernel> (*propagate)(const PeriodicallyForcedMotion<double>& motion);
};

/// One unit each, compiled for its instruction set; those that the program does not have are not
/// defined. Call none of a set that the processor has not got.
const PackKernels& baseline_kernels();
const PackKernels& avx2_kernels();
const PackKernels& avx512_kernels();

/// Kernels of an available instruction set.
const PackKernels& pack_kernels(InstructionSet set);

}  // namespace holdfast::program
