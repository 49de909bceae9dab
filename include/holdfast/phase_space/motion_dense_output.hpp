#pragma once

#include "holdfast/core/types.hpp"
#include "holdfast/motion/between_samples.hpp"
#include "holdfast/motion/dense_output.hpp"
#include "holdfast/motion/event_motion.hpp"
#include "holdfast/motion/forced_loop.hpp"
#include "holdfast/motion/sampled_motion.hpp"

namespace holdfast::detail {

/// A motion of the paper's model, one sample at a time, and the way between the samples.
/// @tparam Loop  ForcedLoop<double>
template <class Loop>
class SampledWay {
 public:
  SampledWay(const Loop& loop, const Vector<double, 4>& initial_state)
      : between_(loop), motion_(harmonically_forced_motion(loop, initial_state)) {}

  MotionSample<double> sense() {
    previous_force_ = motion_.memory().previous_force;
    return sample_ = motion_.sense();
  }
  /// From the last sample to the next one (s).
  double period() const { return between_.loop().sampling.period; }
  void advance(bool /*asked*/) { motion_.advance(); }
  /// Some time (s) after the last sample, up to the next one.
  Vector<double, 4> state(double after) const {
    return between_.state(sample_, previous_force_, after);
  }

 private:
  BetweenSamples between_;
  SampledMotion<double> motion_;
  MotionSample<double> sample_{};
  double previous_force_ = 0.0;
};

/// The same for a loop as it is built; the motion must outlive it and not be moved.
template <class Contact>
class HybridWay {
 public:
  explicit HybridWay(HybridMotion<Contact>& motion) : motion_(&motion), trace_(motion) {}

  MotionSample<double> sense() {
    const HybridSample sample = motion_->sense();
    return static_cast<const MotionSample<double>&>(sample);  // all but its mode
  }
  double period() const { return motion_->period(); }
  /// @param asked  whether `state` will be, until the next sample
  void advance(bool asked) {
    if (!asked) return motion_->advance();
    trace_.begin();
    motion_->advance(trace_);
  }
  Vector<double, 4> state(double after) const { return trace_.state(after); }

 private:
  HybridMotion<Contact>* motion_;
  FlowTrace<Contact> trace_;
};

}  // namespace holdfast::detail
