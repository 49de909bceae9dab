#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "holdfast/core/select.hpp"
#include "holdfast/core/types.hpp"

namespace holdfast {

/// How a motion ended.
enum class MotionEnd {
  completed,    ///< all its samples were taken
  diverged,     ///< the state left the range of the number type
  accumulates,  ///< its changes of contact do (motion/event_motion.hpp): it cannot be followed
};

/// What a sweep keeps of one motion of the sampled loop with backlash.
///
/// t_j = j τ for j = 0, 1, … up to the last sample not after the duration. The steady samples are
/// those with t_j not before half the duration, round-off apart; where there are none, what is
/// taken of them is NaN. Of a motion that diverged everything is infinite but `engaged_fraction`
/// and `reversals_per_s`, which are NaN, and `first_peak`, which stays what it was. Of one whose
/// changes of contact accumulate everything is NaN but the samples up to there.
struct MotionMetrics {
  MotionEnd end;         ///< decides which of the numbers below are finite
  std::int64_t samples;  ///< taken; of a motion that diverged, those with a finite state
  double first_peak;     ///< |z₁| (m) at its first strict local extremum at j ≥ 1, NaN if none
  double steady_peak;    ///< max |z₁| (m) of the steady samples
  double steady_rms;     ///< √(mean z₁²) (m) of the steady samples
  double engaged_fraction;  ///< share of the steady samples at which the drive transmits
  double force_peak;        ///< max |u_j| (N) of all samples: what the drive must deliver
  double force_rms;         ///< √(mean u_j²) (N) of the steady samples
  /// Reversals of the drive (1/s): how often Δż ≠ 0 changed its sign or became zero from one steady
  /// sample to the next, by the time from the first to the last of them; NaN where that is zero
  double reversals_per_s;
  double absorber_stroke;  ///< max Δz − min Δz (m) of all samples, Δz = z₂ − z₁
};

/// |z₁| at the first strict turn of a sequence of samples: about 4 comparisons and 3 selects a
/// sample.
template <class Scalar>
class FirstExtremum {
 public:
  /// Takes the next value; an extremum is known at the value after it.
  void observe(const Scalar& value) {
    using std::abs;
    const Mask<Scalar> turns = ((previous_ > before_) & (value < previous_)) |
                               ((previous_ < before_) & (value > previous_));
    size_ = select(turns & !found(), Scalar(abs(previous_)), size_);
    before_ = previous_;
    previous_ = value;
  }

  /// The lanes in which there is one by now.
  Mask<Scalar> found() const { return size_ == size_; }
  /// NaN while there is none.
  const Scalar& size() const { return size_; }

 private:
  // A comparison with a sample that has not been is false.
  Scalar before_ = Scalar(std::numeric_limits<double>::quiet_NaN());
  Scalar previous_ = Scalar(std::numeric_limits<double>::quiet_NaN());
  Scalar size_ = Scalar(std::numeric_limits<double>::quiet_NaN());
};

/// The largest force and the range of the absorber's travel.
template <class Scalar>
class LoadExtent {
 public:
  /// Takes u (N) and Δz (m) of the next sample.
  void observe(const Scalar& force, const Scalar& relative_displacement) {
    using std::abs;
    using std::max;
    using std::min;
    force_ = max(force_, Scalar(abs(force)));
    highest_ = max(highest_, relative_displacement);
    lowest_ = min(lowest_, relative_displacement);
  }

  /// max |u| (N).
  const Scalar& force() const { return force_; }
  /// max Δz − min Δz (m).
  Scalar stroke() const { return highest_ - lowest_; }

 private:
  Scalar force_ = Scalar(0);
  Scalar highest_ = Scalar(-std::numeric_limits<double>::infinity());
  Scalar lowest_ = Scalar(std::numeric_limits<double>::infinity());
};

/// Sums over the steady samples.
template <class Scalar>
struct SteadySums {
  Scalar peak = Scalar(0);           ///< max |z₁| (m)
  Scalar squares = Scalar(0);        ///< Σ z₁² (m²)
  Scalar force_squares = Scalar(0);  ///< Σ u² (N²)
  Scalar engaged = Scalar(0);        ///< samples at which the drive transmits
  Scalar reversals = Scalar(0);      ///< of Δż

  /// @param displacement  z₁ (m)
  /// @param force         u (N)
  /// @param transmits     whether the drive does
  /// @param reverses      whether Δż changed its sign since the sample before
  void observe(const Scalar& displacement, const Scalar& force, const Mask<Scalar>& transmits,
               const Mask<Scalar>& reverses) {
    using std::abs;
    using std::max;
    const Scalar zero(0), one(1);
    peak = max(peak, Scalar(abs(displacement)));
    squares = squares + displacement * displacement;
    force_squares = force_squares + force * force;
    engaged = engaged + select(transmits, one, zero);
    reversals = reversals + select(reverses, one, zero);
  }

  /// Begins again in the lanes of the mask, at the sample about to be observed.
  /// @param lanes     those whose sums go back to zero
  /// @param reverses  of that sample: its reversal began before and does not count
  void restart(const Mask<Scalar>& lanes, const Mask<Scalar>& reverses) {
    const Scalar zero(0);
    peak = select(lanes, zero, peak);
    squares = select(lanes, zero, squares);
    force_squares = select(lanes, zero, force_squares);
    engaged = select(lanes, zero, engaged);
    reversals = select(lanes, select(reverses, Scalar(-1), zero), reversals);
  }
};

/// Whether a velocity that was not zero changed its sign or became zero: the reversal by which the
/// drive enters its gap (contact/hysteresis.hpp).
template <class Scalar>
Mask<Scalar> is_reversal(const Scalar& before, const Scalar& now) {
  const Scalar zero(0);
  return ((before > zero) & (now <= zero)) | ((before < zero) & (now >= zero));
}

}  // namespace holdfast
