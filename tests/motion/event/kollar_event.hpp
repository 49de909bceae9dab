#pragma once

#include "holdfast/contact/contact.hpp"
#include "holdfast/contact/contact_guard.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/motion/event_motion.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "support/contacts.hpp"
#include "support/kollar_case.hpp"
#include "support/testing.hpp"

namespace holdfast::test {

using BacklashMotion = EventMotion<>;

/// The loop of Kollár 2022, §4.2, with its force taken exactly.
inline DigitalLoop kollar_digital(double period, double delay = 0.0,
                                  ForceHold hold = ForceHold::exact) {
  return {{period, delay}, {-557.0, -13.0}, multi_harmonic_force({0.5, 10.0}), hold};
}

inline BacklashMotion kollar_motion(const DigitalLoop& loop, double width,
                                    const Vector<double, 4>& state = Vector<double, 4>::Zero()) {
  return {loop, test::exact_backlash(kollar2022_plant(), width), state};
}

template <class Motion>
void move_samples(Motion& motion, int samples) {
  for (int j = 0; j < samples; ++j) {
    motion.sense();
    motion.advance();
  }
}

/// A change of contact: when it was, and what came after it.
struct MotionSwitch {
  double time;
  int from, to;
};

/// Moves and notes every change of contact, those that a sample brings too.
template <class Motion>
class SwitchNotes {
 public:
  explicit SwitchNotes(Motion& motion) : motion_(motion) {}

  void move(int samples) {
    for (int j = 0; j < samples; ++j) {
      const int before = motion_.contact().mode();
      start_ = motion_.time();
      motion_.sense();
      if (motion_.contact().mode() != before)
        switches.push_back({start_, before, motion_.contact().mode()});
      motion_.advance(*this);
    }
  }

  void flowed(int, double begin, double length) { reached_ = begin + length; }
  void commanded() {}
  void switched(int from, int to, int, const ContactInstant&) {
    switches.push_back({start_ + reached_, from, to});
  }

  std::vector<MotionSwitch> switches;

 private:
  Motion& motion_;
  double start_ = 0.0, reached_ = 0.0;
};

/// A force that is zero at all times, but recorded: what its rows part has to be followed by
/// series.
inline std::shared_ptr<const RecordedForce> zero_record(const std::vector<double>& times) {
  return std::make_shared<const RecordedForce>(times, std::vector<double>(times.size(), 0.0),
                                               RecordInterpolation::linear);
}

/// A state away from rest.
inline Vector<double, 4> pushed_state() { return {0.003, -0.05, 0.001, 0.2}; }

}  // namespace holdfast::test
