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

/// Keeps every sample of a trajectory. Reserve before the run, so that the loop allocates nothing.
class Recorder {
 public:
  /// @param expected_samples  ≥ 0; room is made for that many, and more may come
  /// @throws InvalidParameter for another
  explicit Recorder(std::int64_t expected_samples) {
    require_non_negative("number of samples", static_cast<double>(expected_samples), "");
    samples_.reserve(static_cast<std::size_t>(expected_samples));
  }

  /// Keeps a sample.
  void operator()(const MotionSample<double>& sample) { samples_.push_back(sample); }
  /// All samples, in the order in which they came.
  const std::vector<MotionSample<double>>& samples() const { return samples_; }

 private:
  std::vector<MotionSample<double>> samples_;
};

/// Largest |z₁| (m) and |ż₁| (m/s) from a given instant on: the box that a steady motion fills.
class PhaseExtent {
 public:
  /// @param from  s; samples before it are left out
  explicit PhaseExtent(double from) : from_(from) {}

  /// Takes in a sample.
  void operator()(const MotionSample<double>& sample) {
    if (!not_before(sample.time, from_)) return;
    displacement_ = std::fmax(displacement_, std::abs(sample.state[0]));
    velocity_ = std::fmax(velocity_, std::abs(sample.state[1]));
  }
  /// Largest |z₁| (m) so far; 0 before the first sample that counts.
  double displacement() const { return displacement_; }
  /// Largest |ż₁| (m/s) so far; 0 before the first sample that counts.
  double velocity() const { return velocity_; }

 private:
  double from_;
  double displacement_ = 0.0;
  double velocity_ = 0.0;
};

/// First local maximum and first local minimum of z₁ (m), the two "first peaks" of a vibration from
/// rest. z is positive downward: the minimum is the peak above the equilibrium.
class FirstPeaks {
 public:
  /// Takes in the next sample. A peak shows with the sample after it; the first sample is none, nor
  /// is a top of two equal samples.
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

  /// First local maximum of z₁ (m): below the equilibrium. NaN while there is none.
  double below_equilibrium() const { return below_; }
  /// First local minimum of z₁ (m): above the equilibrium. NaN while there is none.
  double above_equilibrium() const { return above_; }

 private:
  double before_ = 0.0;
  double previous_ = 0.0;
  double below_ = std::numeric_limits<double>::quiet_NaN();
  double above_ = std::numeric_limits<double>::quiet_NaN();
  std::int64_t count_ = 0;
};

/// Notes when the drive entered or left its backlash, as the samples show it.
class SwitchLog {
 public:
  /// One change of contact: at sample `index` the drive is in the backlash (entered) or out of it.
  struct Switch {
    std::int64_t index;  ///< j
    double time;         ///< t_j (s)
    bool entered;        ///< true: into the backlash; false: out of it
  };

  /// @param from  s; switches before it are not logged
  explicit SwitchLog(double from = 0.0) : from_(from) {}

  /// Takes in the next sample. Before the first one the drive counts as engaged.
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
