#pragma once

#include <cstdint>
#include <type_traits>
#include <utility>

#include "holdfast/contact/contact_mode.hpp"
#include "holdfast/control/controller.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/motion/event_motion.hpp"

namespace holdfast {

/// All that the coming samples of an EventMotion depend on, where sampling and forcing coincide
/// every q samples.
template <class Contact>
struct StroboscopicState {
  std::int64_t phase;  ///< samples since the last stroboscopic instant, 0 … q − 1
  typename EventMotion<Contact>::State state;  ///< x_j, N × 1; of two masses z_j (m, m/s, m, m/s)
  double previous_command;                     ///< u_{j−1} (N)
  double previous_reading;                     ///< the displacement at t_{j−1} as read (m)
  Contact contact;                             ///< before sample j
};

namespace detail {

template <class Contact, class = void>
struct HasMovingGap : std::false_type {};
template <class Contact>
struct HasMovingGap<Contact, std::void_t<decltype(std::declval<Contact&>().shift_gap(0.0))>>
    : std::true_type {};

/// A deviation of X = [x (N); u_{j−1}; the gap; the displacement as last read] of VariationalFlow.
template <class Contact>
using PointDeviation = Vector<double, larger_size(EventMotion<Contact>::states, 3)>;

/// to − from.
template <class Contact>
PointDeviation<Contact> difference(const StroboscopicState<Contact>& from,
                                   const StroboscopicState<Contact>& to) {
  PointDeviation<Contact> apart(from.state.size() + 3);
  apart << to.state - from.state, to.previous_command - from.previous_command, 0.0,
      to.previous_reading - from.previous_reading;
  if constexpr (HasMovingGap<Contact>::value) {
    if (from.contact.remembers_gap() && to.contact.remembers_gap())
      apart[from.state.size() + 1] = to.contact.lower() - from.contact.lower();
  }
  return apart;
}

template <class Contact>
StroboscopicState<Contact> shifted(StroboscopicState<Contact> point,
                                   const PointDeviation<Contact>& by) {
  const Eigen::Index order = point.state.size();
  point.state += by.head(order);
  point.previous_command += by[order];
  point.previous_reading += by[order + 2];
  if constexpr (HasMovingGap<Contact>::value) {
    if (point.contact.remembers_gap()) point.contact.shift_gap(by[order + 1]);
  }
  return point;
}

}  // namespace detail

/// An EventMotion whose forcing repeats exactly every q samples: its index goes back to zero at
/// each stroboscopic instant, so that no rounding of late instants lets sampling and forcing drift
/// apart.
template <class Contact>
class RepeatingMotion {
 public:
  /// @param motion  at a stroboscopic instant (sampling and forcing in phase) where its index is a
  ///                multiple of q
  /// @param period  q ≥ 1 of forcing_ratio()
  RepeatingMotion(const EventMotion<Contact>& motion, std::int64_t period)
      : motion_(motion), period_(period) {
    turn_to(motion.index() % period);
  }

  /// Takes the present sample; once before each `advance()`.
  typename EventMotion<Contact>::Sample sense() { return motion_.sense(); }
  /// Moves to the next sample.
  void advance() { advance(IgnoreFlow()); }
  /// The same past an observer as that of EventMotion::advance.
  template <class Observer>
  void advance(Observer&& observer) {
    motion_.advance(observer);
    if (motion_.index() == period_) turn_to(0);
  }

  /// Where the motion stands; ask before `sense()`.
  StroboscopicState<Contact> point() const {
    return {motion_.index(), motion_.state(), motion_.previous_command(),
            motion_.controller().memory().previous_displacement, motion_.contact()};
  }

  /// Goes on from a point, its counts begun again.
  void go_to(const StroboscopicState<Contact>& point) {
    if (motion_.loop().limits.velocity == VelocitySensing::difference)
      motion_.remember_reading(point.previous_reading);
    motion_.restore(point.phase, point.state, point.previous_command, point.contact);
    motion_.restart_counts();
  }

  /// The motion itself; its index is the phase, 0 … q − 1.
  const EventMotion<Contact>& motion() const { return motion_; }
  /// q.
  std::int64_t period() const { return period_; }

 private:
  void turn_to(std::int64_t phase) {
    motion_.restore(phase, motion_.state(), motion_.previous_command(), motion_.contact());
  }

  EventMotion<Contact> motion_;
  std::int64_t period_;
};

}  // namespace holdfast
