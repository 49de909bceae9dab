#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "holdfast/phase_space/motion_batch.hpp"
#include "holdfast/stability/chart/hurwitz_row.hpp"
#include "holdfast/stability/chart/radius_rows.hpp"
#include "holdfast/sweep/metric_batch.hpp"
#include "kernels/pack_kernels.hpp"

namespace holdfast::program {

/// The kernels on one type of pack: to be read by the unit of its instruction set alone. Every name
/// in here bears the pack.
template <class Pack>
class KernelsOn {
  template <int Degree>
  class Radius final : public RadiusKernel<Degree> {
   public:
    using Table = typename RadiusKernel<Degree>::Table;

    std::unique_ptr<RadiusKernel<Degree>> copy() const override {
      return std::make_unique<Radius>(*this);
    }
    std::int64_t most_rows() const override { return batch_.most_rows(); }
    void fill(const AffineLine<Degree>* lines, std::int64_t count, const Axis& values,
              double* radius) override {
      batch_.fill(lines, count, values, radius);
    }
    void fill(const Table* tables, std::int64_t count, double* radius) override {
      batch_.fill(tables, count, radius);
    }

   private:
    RadiusBatch<Pack, Degree> batch_;
  };

  class Travel final : public TravelKernel {
   public:
    explicit Travel(const MotionBatch<Pack>& batch) : batch_(batch) {}
    std::unique_ptr<TravelKernel> copy() const override { return std::make_unique<Travel>(*this); }
    void run(ActiveTrajectory* motions, std::size_t count, std::int64_t samples,
             const AttractionTest& test) override {
      batch_.run(motions, count, samples, test);
    }

   private:
    MotionBatch<Pack> batch_;
  };

  /// The caller's matrices, as MetricGroup wants them.
  struct Matrices {
    MotionSource* source;
    const detail::SweepMatrices::Matrices& of(const IdealLoop<double>& loop) {
      return source->of(loop);
    }
  };

  struct Pauses : IgnoreSwitching {
    MotionSource* source;
    explicit Pauses(MotionSource& of) : source(&of) {}
    void pause() const { source->pause(); }
  };

  template <int Degree>
  static std::unique_ptr<RadiusKernel<Degree>> radius() {
    return std::make_unique<Radius<Degree>>();
  }

  static void stable_line(const Vector<double, 6>& constant, const Vector<double, 6>& slope,
                          const std::vector<double>& values, std::uint8_t* stable) {
    hurwitz_row<Pack, 6>(constant, slope, values, stable);
  }

  static void stable_table(const Eigen::Matrix<double, Eigen::Dynamic, 6>& table,
                           std::uint8_t* stable) {
    hurwitz_row<Pack, 6>(table, stable);
  }

  static void metrics(const SweepMotion* motions, const detail::SampleSpan* spans,
                      std::size_t count, MotionMetrics* results, MotionSource& source) {
    Pauses pauses(source);
    detail::group_metrics<Pack>(motions, spans, count, results, Matrices{&source}, pauses);
  }

  static std::unique_ptr<TravelKernel> travel(const PeriodicallyForcedMotion<double>& motion,
                                              const PdGains<double>& gains, const Rational& ratio) {
    return std::make_unique<Travel>(MotionBatch<Pack>(motion, gains, ratio));
  }

 public:
  static constexpr PackKernels all{stable_line, stable_table, radius<5>,
                                   radius<6>,   metrics,      travel};
};

}  // namespace holdfast::program
