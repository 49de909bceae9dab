#pragma once

#include "holdfast/contact/contact_guard.hpp"
#include "support/testing.hpp"

namespace holdfast::test {

/// A change of contact.
struct MotionSwitch {
  std::int64_t sample;  ///< the last one before it
  double after;         ///< that sample (s)
  int from, to;
  int guard = -2;      ///< that ended the mode; −1: a command did, −2: the sample itself
  double start = 0.0;  ///< when that sample was (s)

  double time() const { return start + after; }
};

/// Whether two motions go the same way: by the same changes after the same samples.
inline bool same_way(const std::vector<MotionSwitch>& one, const std::vector<MotionSwitch>& other) {
  return std::equal(one.begin(), one.end(), other.begin(), other.end(),
                    [](const MotionSwitch& a, const MotionSwitch& b) {
                      return std::tie(a.sample, a.from, a.to, a.guard) ==
                             std::tie(b.sample, b.from, b.to, b.guard);
                    });
}

/// Moves and notes every change of contact, those that a sample brings too.
template <class Motion>
class SwitchNotes {
 public:
  explicit SwitchNotes(Motion& motion) : motion_(motion) {}

  void move(int samples) {
    for (int j = 0; j < samples; ++j) {
      const int before = motion_.contact().mode();
      sample_ = motion_.index();
      start_ = motion_.time();
      reached_ = 0.0;
      motion_.sense();
      if (motion_.contact().mode() != before) note(before, motion_.contact().mode(), -2);
      motion_.advance(*this);
    }
  }

  void flowed(int, double begin, double length) { reached_ = begin + length; }
  void commanded() const {}
  void switched(int from, int to, int guard, const ContactInstant&) { note(from, to, guard); }

  std::vector<MotionSwitch> switches;

 private:
  void note(int from, int to, int guard) {
    switches.push_back({sample_, reached_, from, to, guard, start_});
  }

  Motion& motion_;
  std::int64_t sample_ = 0;
  double start_ = 0.0, reached_ = 0.0;
};

}  // namespace holdfast::test
