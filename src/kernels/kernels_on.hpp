#pragma once

#include <cstddef>
#include <cstdint>

#include "holdfast/phase_space/lane_scheduler.hpp"
#include "holdfast/phase_space/motion_batch.hpp"
#include "holdfast/stability/chart/loop_chart_rows.hpp"
#include "holdfast/sweep/event_metric_batch.hpp"
#include "holdfast/sweep/metric_batch.hpp"
#include "kernels/pack_kernels.hpp"

namespace holdfast::program {

/// Kernels for one type of SIMD pack. Only the unit of its instruction set may include this file.
/// The type is part of every name in this class, so that the linker never mixes instruction sets.
template <class Pack>
class KernelsOn {
  template <int Degree>
  static ChartKernel chart_with_radius(const LoopChart& of) {
    return
        [stable_rows = StabilityChartRows<Pack>(of), rows = RadiusChartRows<Pack, Degree>(of)](
            std::int64_t first, std::int64_t count, std::uint8_t* stable, double* radius) mutable {
          stable_rows.fill(first, count, stable);
          rows.fill(first, count, radius);
        };
  }

  /// Adapter from a MotionSource to the source of MetricGroup; the samples are ignored.
  struct Source {
    MotionSource& caller;
    const detail::SweepMatrices::Matrices& of(const IdealLoop<double>& loop) {
      return caller.of(loop);
    }
    void pause() const { caller.pause(); }
    void operator()(const std::size_t*, std::int64_t, const Mask<Pack>&) const {}
  };

  static ChartKernel chart(const LoopChart& of, bool radius) {
    if (radius)
      return has_processing_delay(of) ? chart_with_radius<6>(of) : chart_with_radius<5>(of);
    return [rows = StabilityChartRows<Pack>(of)](std::int64_t first, std::int64_t count,
                                                 std::uint8_t* stable, double*) mutable {
      rows.fill(first, count, stable);
    };
  }

  static void metrics(const SweepMotion* motions, const detail::SampleSpan* spans,
                      std::size_t count, MotionMetrics* results, MotionSource& source) {
    Source of_caller{source};
    detail::group_metrics<Pack>(motions, spans, count, results, of_caller);
  }

  static void event_metrics(const detail::PreparedEventMotion* motions, std::size_t count,
                            MotionMetrics* results, MotionSource& source) {
    detail::group_event_metrics<Pack>(motions, count, results, [&] { source.pause(); });
  }

  static void run_on_lanes(const ImplementedLoop& loop, LaneScheduler& of_caller) {
    holdfast::run_on_lanes<Pack>(loop, of_caller);
  }

  static MotionKernel propagate(const PeriodicallyForcedMotion<double>& motion) {
    return [batch = MotionBatch<Pack>(motion)](
               ActiveTrajectory* motions, std::size_t count, std::int64_t samples,
               const AttractionTest& test) mutable { batch.run(motions, count, samples, test); };
  }

 public:
  static constexpr PackKernels all{chart, metrics, event_metrics, run_on_lanes, propagate};
};

}  // namespace holdfast::program
