#pragma once

#include <cstddef>

#include "holdfast/core/lanes.hpp"
#include "holdfast/core/select.hpp"
#include "holdfast/sweep/motion_metrics.hpp"

namespace holdfast::detail {

/// What the samples of one motion leave for its metrics.
struct LaneSums {
  double first_peak, force_peak, stroke;
  SteadySums<double> steady;
};

/// What the metrics of one motion, or of as many as a pack has lanes, need of its samples. The
/// drivers, MetricTrack of the sampled map and EventTrack of the event-driven flow, decide which
/// samples are looked at.
template <class Scalar>
class MetricObserver {
 public:
  /// Takes u and Δz of a sample.
  /// @param readings  of the plant
  template <class Sample, class Readings>
  void observe_load(const Sample& sample, const Readings& readings) {
    load_.observe(sample.control_force, readings.relative_displacement(sample.state));
  }
  /// Takes a steady sample. @param reverses  whether Δż changed its sign since the one before
  template <class Sample, class Readings>
  void observe_steady(const Sample& sample, const Readings& readings,
                      const Mask<Scalar>& reverses) {
    steady_.observe(readings.displacement(sample.state), sample.control_force, sample.engaged,
                    reverses);
  }
  /// Takes z of a sample; NaN where no extremum is sought any more.
  void observe_extremum(const Scalar& displacement) { extremum_.observe(displacement); }

  /// Begins the steady samples of the lanes in the mask, at the sample about to be taken.
  /// @param reverses  of that sample
  void begin_steady(const Mask<Scalar>& lanes, const Mask<Scalar>& reverses) {
    steady_.restart(lanes, reverses);
  }

  /// The lanes in which there is a first extremum by now.
  Mask<Scalar> extremum_found() const { return extremum_.found(); }

  /// All that one lane holds.
  LaneSums lane(std::size_t lane) const {
    const auto number = [lane](const Scalar& pack) {
      double values[Lanes<Scalar>::count];
      Lanes<Scalar>::store(pack, values);
      return values[lane];
    };
    return {number(extremum_.size()),
            number(load_.force()),
            number(load_.stroke()),
            {number(steady_.peak), number(steady_.squares), number(steady_.force_squares),
             number(steady_.engaged), number(steady_.reversals)}};
  }

 private:
  FirstExtremum<Scalar> extremum_;
  LoadExtent<Scalar> load_;
  SteadySums<Scalar> steady_;
};

}  // namespace holdfast::detail
