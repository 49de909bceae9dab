#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "holdfast/core/errors.hpp"
#include "holdfast/motion/instant.hpp"
#include "holdfast/motion/sampled_motion.hpp"

namespace holdfast {

/// An observer that records every sample of a trajectory, in memory reserved before the run.
class Recorder {
 public:
  /// @param expected_samples  ≥ 0; memory is reserved for that many, more are possible
  /// @throws InvalidParameter where the number is negative or too large
  explicit Recorder(std::int64_t expected_samples) {
    require_non_negative("number of samples", static_cast<double>(expected_samples), "");
    samples_.reserve(static_cast<std::size_t>(expected_samples));
  }

  /// Records a sample.
  void operator()(const MotionSample<double>& sample) { samples_.push_back(sample); }
  /// All samples, in the order of recording.
  const std::vector<MotionSample<double>>& samples() const { return samples_; }

 private:
  std::vector<MotionSample<double>> samples_;
};

/// The extent of a steady motion: the largest |z₁| (m) and |ż₁| (m/s) since a given instant.
class PhaseExtent {
 public:
  /// @param from  instant (s); earlier samples are ignored
  explicit PhaseExtent(double from) : from_(from) {}

  /// Includes a sample in the extent.
  void operator()(const MotionSample<double>& sample) {
    if (!not_before(sample.time, from_)) return;
    displacement_ = std::fmax(displacement_, std::abs(sample.state[0]));
    velocity_ = std::fmax(velocity_, std::abs(sample.state[1]));
  }
  /// The largest |z₁| (m) since the instant `from`; 0 before it.
  double displacement() const { return displacement_; }
  /// The largest |ż₁| (m/s) since the instant `from`; 0 before it.
  double velocity() const { return velocity_; }

 private:
  double from_;
  double displacement_ = 0.0;
  double velocity_ = 0.0;
};

/// The first local maximum and the first local minimum of z₁ (m), the "first peaks" of a vibration
/// from rest. z is positive downward: the minimum is the peak above the equilibrium.
class FirstPeaks {
 public:
  /// Adds the next sample. A peak is found with the sample after it; the first sample and two equal
  /// samples in succession are no peak.
  void operator()(const MotionSample<double>& sample) {
    const double value = sample.state[0];
    if (count_ >= 2) {
      const bool rising = previous_ > before_, falls = value < previous_;
      if (rising && falls && std::isnan(below_)) below_ = previous_;
      if (previous_ < before_ && value > previous_ && std::isnan(above_)) above_ = previous_;
    }
    before_ = previous_;
    previous_ = value;
    ++count_;
  }

  /// The first local maximum of z₁ (m, downward), so below the equilibrium; NaN before it is met.
  double below_equilibrium() const { return below_; }
  /// The first local minimum of z₁ (m, downward), so above the equilibrium; NaN before it is met.
  double above_equilibrium() const { return above_; }

 private:
  double before_ = 0.0;
  double previous_ = 0.0;
  double below_ = std::numeric_limits<double>::quiet_NaN();
  double above_ = std::numeric_limits<double>::quiet_NaN();
  std::int64_t count_ = 0;
};

/// An observer that records the samples at which the drive enters or leaves its backlash.
class SwitchLog {
 public:
  /// A change of contact: the first sample with the drive in the backlash, or engaged again.
  struct Switch {
    std::int64_t index;  ///< number j of the sample
    double time;         ///< instant t_j (s)
    bool entered;        ///< true: the drive enters the backlash; false: it is engaged again
  };

  /// @param from  instant (s); earlier changes are ignored
  explicit SwitchLog(double from = 0.0) : from_(from) {}

  /// Adds the next sample. Before the first one the drive counts as engaged.
  void operator()(const MotionSample<double>& sample) {
    const bool inside = !sample.engaged;
    if (inside != inside_ && not_before(sample.time, from_))
      switches_.push_back({sample.index, sample.time, inside});
    inside_ = inside;
  }
  /// The changes of contact so far, in order of time.
  const std::vector<Switch>& switches() const { return switches_; }

 private:
  double from_;
  bool inside_ = false;
  std::vector<Switch> switches_;
};

}  // namespace holdfast
