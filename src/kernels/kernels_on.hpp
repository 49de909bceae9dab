#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "holdfast/phase_space/lane_scheduler.hpp"
#include "holdfast/phase_space/motion_batch.hpp"
#include "holdfast/stability/chart/loop_chart_rows.hpp"
#include "holdfast/sweep/event_metric_batch.hpp"
#include "holdfast/sweep/metric_batch.hpp"
#include "kernels/pack_kernels.hpp"

namespace holdfast::program {

/// The kernels on one type of pack: to be read by the unit of its instruction set alone. Every name
/// in here bears the pack.
template <class Pack>
class KernelsOn {
  struct NoRadius {
    explicit NoRadius(const LoopChart&) {}
    void fill(std::int64_t, std::int64_t, double*) const {}
  };

  template <class RadiusRows>
  class Chart final : public ChartKernel {
   public:
    explicit Chart(const LoopChart& chart) : stability_(chart), radius_(chart) {}
    std::unique_ptr<ChartKernel> copy() const override { return std::make_unique<Chart>(*this); }
    void fill(std::int64_t first, std::int64_t count, std::uint8_t* stable,
              double* radius) override {
      stability_.fill(first, count, stable);
      radius_.fill(first, count, radius);
    }

   private:
    StabilityChartRows<Pack> stability_;
    RadiusRows radius_;
  };

  class Motion final : public MotionKernel {
   public:
    explicit Motion(const MotionBatch<Pack>& batch) : batch_(batch) {}
    std::unique_ptr<MotionKernel> copy() const override { return std::make_unique<Motion>(*this); }
    void run(ActiveTrajectory* motions, std::size_t count, std::int64_t samples,
             const AttractionTest& test) override {
      batch_.run(motions, count, samples, test);
    }

   private:
    MotionBatch<Pack> batch_;
  };

  /// The caller's, as MetricGroup wants it: no kernel of the program looks at samples.
  struct Source {
    MotionSource& caller;
    const detail::SweepMatrices::Matrices& of(const IdealLoop<double>& loop) {
      return caller.of(loop);
    }
    void pause() const { caller.pause(); }
    void operator()(const std::size_t*, std::int64_t, const Mask<Pack>&) const {}
  };

  static std::unique_ptr<ChartKernel> chart(const LoopChart& of, bool radius) {
    if (!radius) return std::make_unique<Chart<NoRadius>>(of);
    if (has_processing_delay(of)) return std::make_unique<Chart<RadiusChartRows<Pack, 6>>>(of);
    return std::make_unique<Chart<RadiusChartRows<Pack, 5>>>(of);
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

  static std::unique_ptr<MotionKernel> propagate(const PeriodicallyForcedMotion<double>& motion) {
    return std::make_unique<Motion>(MotionBatch<Pack>(motion));
  }

 public:
  static constexpr PackKernels all{chart, metrics, event_metrics, run_on_lanes, propagate};
};

}  // namespace holdfast::program
