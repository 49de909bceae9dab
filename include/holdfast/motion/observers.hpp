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

/// An observer that records every sample of a trajectory. Memory is reserved before the run.
class Recorder {
 public:
  /// @param expected_samples  number of samples for which memory is reserved, ≥ 0; not a limit
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

/// An observer that finds the conductor's largest |z₁| (m) and |ż₁| (m/s) since a given instant.
class PhaseExtent {
 public:
  /// @param from  instant (s); earlier samples are ignored
  explicit PhaseExtent(double from) : from_(from) {}

  /// Processes a sample: updates the largest |z₁| and |ż₁|.
  void operator()(const MotionSample<double>& sample) {
    if (!not_before(sample.time, from_)) return;
    displacement_ = std::fmax(displacement_, std::abs(sample.state[0]));
    velocity_ = std::fmax(velocity_, std::abs(sample.state[1]));
  }
  /// The largest |z₁| (m) since the instant `from`; 0 without a sample since then.
  double displacement() const { return displacement_; }
  /// The largest |ż₁| (m/s) since the instant `from`; 0 without a sample since then.
  double velocity() const { return velocity_; }

 private:
  double from_;
  double displacement_ = 0.0;
  double velocity_ = 0.0;
};

/// An observer that records the samples at which the drive enters or leaves its backlash.
class SwitchLog {
 public:
  /// A change of contact, given by the first sample with the new contact.
  struct Switch {
    std::int64_t index;  ///< number j of the sample
    double time;         ///< instant t_j (s)
    bool entered;        ///< true: the drive enters the backlash; false: it is engaged again
  };

  /// @param from  instant (s); earlier changes are ignored
  explicit SwitchLog(double from = 0.0) : from_(from) {}

  /// Processes the next sample. The drive counts as engaged before the first sample.
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
