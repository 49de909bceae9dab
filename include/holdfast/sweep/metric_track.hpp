#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "holdfast/contact/hysteresis.hpp"
#include "holdfast/core/select.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/excitation/forcing.hpp"
#include "holdfast/motion/sampled_motion.hpp"
#include "holdfast/sweep/metric_observer.hpp"
#include "holdfast/sweep/motion_metrics.hpp"

namespace holdfast::detail {

/// What is looked at in a stretch of samples; what no lane needs is left out.
struct Watch {
  bool extremum;    ///< some first extremum is still to come
  bool steady;      ///< some lane is steady
  bool divergence;  ///< some state is so large that it may leave the range of the number type
};

/// Size of a state beyond which every sample is looked at for divergence, and one that must not be
/// met before that has begun.
inline constexpr double large_state = 1e60, unseen_state = 1e200;

/// A pack of motions with their metrics.
///
/// Work per sample: 42 operations of the motion (24 multiply-adds of the loop, 12 of the forcing, 2
/// of the gains, 4 additions), 15 of the backlash (5 additions, 6 comparisons, 4 selects), 4 of the
/// metrics (largest and smallest); 8 more where steady, 8 while a first extremum is sought.
template <class Scalar>
class MetricTrack {
 public:
  using Motion = SampledMotion<Scalar, Backlash<Scalar>, PhasorForcing<Scalar>>;

  explicit MetricTrack(const Motion& motion) : motion_(motion) {}

  /// Takes one sample. @return where the drive transmits
  template <bool Extremum, bool Steady, bool Divergence>
  Mask<Scalar> step() {
    const Scalar velocity_before = motion_.law().memory().previous_velocity;
    const auto sample = motion_.sense();
    Scalar displacement = motion_.readings().displacement(sample.state);
    observer_.observe_load(sample, motion_.readings());
    if constexpr (Steady)
      observer_.observe_steady(sample, motion_.readings(),
                               is_reversal(velocity_before, velocity(sample.state)));
    if constexpr (Divergence) {
      finite_ = finite_ & is_finite(sample.state);
      finite_samples_ = finite_samples_ + select(finite_, Scalar(1), Scalar(0));
      displacement =
          select(finite_, displacement, Scalar(std::numeric_limits<double>::quiet_NaN()));
    }
    if constexpr (Extremum) observer_.observe_extremum(displacement);
    motion_.advance();
    return sample.engaged;
  }

  /// Begins the steady samples of the lanes in the mask at the present sample.
  void begin_steady(const Mask<Scalar>& lanes) {
    observer_.begin_steady(
        lanes, is_reversal(motion_.law().memory().previous_velocity, velocity(motion_.state())));
  }

  /// Begins to look for divergence; until now every sample of the lanes that are looked at was
  /// finite.
  void begin_watching_divergence() {
    finite_samples_ =
        select(finite_, Scalar(static_cast<double>(motion_.index())), finite_samples_);
  }

  /// Σ |z_i| of the present state; its entries differ in unit, which does not matter to a magnitude
  /// of tens of decades.
  Scalar size() const {
    using std::abs;
    Scalar result = abs(motion_.state()[0]);
    for (int i = 1; i < 4; ++i) result = result + abs(motion_.state()[i]);
    return result;
  }

  Mask<Scalar> extremum_found() const { return observer_.extremum_found(); }
  Mask<Scalar> finite() const { return finite_; }
  const Scalar& finite_samples() const { return finite_samples_; }
  const MetricObserver<Scalar>& observer() const { return observer_; }

 private:
  Scalar velocity(const Vector<Scalar, 4>& state) const {
    return motion_.readings().relative_velocity(state);
  }

  static Mask<Scalar> is_finite(const Vector<Scalar, 4>& state) {
    const Scalar sum = state.sum();
    return Scalar(0) * sum == Scalar(0);
  }

  Motion motion_;
  MetricObserver<Scalar> observer_;
  Mask<Scalar> finite_ = Scalar(0) == Scalar(0);
  Scalar finite_samples_ = Scalar(0);
};

}  // namespace holdfast::detail
