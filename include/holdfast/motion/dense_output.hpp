#pragma once

#include <algorithm>
#include <vector>

#include "holdfast/contact/contact_mode.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/math/roots/first_root.hpp"
#include "holdfast/motion/event_motion.hpp"
#include "holdfast/motion/taylor_step.hpp"

namespace holdfast {

/// The dense output of an EventMotion: the state at any instant between two samples.
///
///     DenseOutput<Contact> trace(motion);
///     motion.sense();
///     trace.begin();
///     motion.advance(trace);
///     trace.state(0.5 * tau);
///
/// The motion must outlive this object at an unchanged address. Work: one Taylor series per Part.
template <class Contact>
class DenseOutput {
 public:
  /// The type of the motion's state x, N × 1.
  using State = typename EventMotion<Contact>::State;

  /// A part of a sampling period: one contact mode, one command, one Taylor series of the state.
  struct Part {
    double begin,                                    ///< beginning (s after the sample)
        length;                                      ///< length (s), ≥ 0
    ContactMode mode;                                ///< contact mode
    typename EventMotion<Contact>::Expansion state;  ///< Taylor series of the state over the part
  };

  /// Constructs the dense output of a motion and keeps a reference to the motion.
  explicit DenseOutput(const EventMotion<Contact>& motion)
      : motion_(&motion), state_(motion.state()) {}

  /// Begins a sampling period; to be called after the motion's `sense()`, before `advance(trace)`.
  void begin() {
    parts_.clear();
    state_ = motion_->state();
    command_ = motion_->previous_command();
  }

  /// The state (N × 1) at the time `after` (s) since the sample, ≥ 0 and at most the period.
  State state(double after) const {
    const Part& part = part_at(after);
    return part.state.state(
        part.length > 0.0 ? std::clamp((after - part.begin) / part.length, 0.0, 1.0) : 0.0);
  }

  /// The contact mode at the time `after` (s) since the sample; at a change, the new mode.
  ContactMode mode(double after) const { return part_at(after).mode; }

  /// The parts of the sampling period in order of time; together they cover the whole period.
  const std::vector<Part>& parts() const { return parts_; }

  /// Adds a time interval in one contact mode, given by its number, its beginning (s after the
  /// sample) and its length (s). Called by EventMotion::advance at the end of the interval.
  void flowed(int mode, double begin, double length) {
    const double rate = motion_->rate(mode);
    double reached = begin;
    const double end = begin + length;
    do {
      const double wanted = std::min(end, motion_->force().next_break(reached)) - reached;
      const double part = std::min(wanted, 1.0 / rate);
      Series force(terms_for(rate * part));
      motion_->force().expand(reached, part, force);
      parts_.push_back({reached,
                        part,
                        motion_->contact().word(),
                        {motion_->dynamics(mode), state_, command_, force, part}});
      state_ = parts_.back().state.state(1.0);
      reached = part == end - reached ? end : reached + part;
    } while (reached < end);
  }
  /// Replaces u_{j−1} by u_j; called by EventMotion::advance after the processing delay.
  void commanded() { command_ = motion_->command(); }
  /// Does nothing; called by EventMotion::advance at a change of contact.
  template <class Instant>
  void switched(int, int, int, const Instant&) {}

 private:
  const Part& part_at(double after) const {
    const auto later =
        std::upper_bound(parts_.begin(), parts_.end(), after,
                         [](double instant, const Part& part) { return instant < part.begin; });
    return later == parts_.begin() ? parts_.front() : *(later - 1);
  }

  const EventMotion<Contact>* motion_;
  std::vector<Part> parts_;
  State state_;
  double command_ = 0.0;
};

}  // namespace holdfast
