#pragma once

#include <array>
#include <cstdint>

#include "holdfast/contact/contact_mode.hpp"
#include "holdfast/motion/sampled_motion.hpp"

namespace holdfast {

/// What is known of a motion at one sample, with the mode of its contact from then on.
/// @tparam States  N, the order of the plant
template <int States>
struct EventSampleOf : MotionSample<double, States> {
  ContactMode mode;  ///< from t_j on; `engaged` of the sample is mode == ContactMode::engaged
};

/// That of the two masses.
using EventSample = EventSampleOf<4>;

/// What a motion has met with.
struct SwitchCounts {
  std::array<std::int64_t, 3> entered{};  ///< how often each ContactMode began
  std::int64_t grazing = 0;  ///< changes of contact that rounding decides: a guard touches zero
  bool accumulates = false;  ///< more than `most_switches` changes in one sampling period: those
                             ///< after them, up to its end, were not followed, and from there on
                             ///< the motion is not to be trusted
};

/// The observer of EventMotion::advance that does not look at what happens between the samples.
struct IgnoreFlow {
  /// A part of the sampling period was passed: the mode's number, its begin (s after the sample)
  /// and its length (s).
  void flowed(int, double, double) const {}
  /// At t_j + δ u_j took the place of u_{j−1}.
  void commanded() const {}
  /// The contact changed: the numbers of the mode before and after, that of the guard that came to
  /// zero (−1: a jump of the command or the force did it), the instant.
  template <class Instant>
  void switched(int, int, int, const Instant&) const {}
};

}  // namespace holdfast
