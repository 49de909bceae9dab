#pragma once

#include <cstddef>
#include <vector>

#include "holdfast/contact/contact_mode.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/motion/event_motion.hpp"
#include "holdfast/orbit/event/return_map.hpp"

namespace holdfast::detail {

/// The contact mode of the drive and the last sign σ of the relative velocity Δż.
struct RecordedContact {
  ContactMode mode;
  double sign;

  friend bool operator==(const RecordedContact& a, const RecordedContact& b) {
    return a.mode == b.mode && a.sign == b.sign;
  }
};

/// A change of contact between two samples.
struct RecordedSwitch {
  double after;  ///< time since the sample (s)
  int guard;     ///< index, in the ended mode, of the guard that fell to 0; −1: command jump
  RecordedContact begun;  ///< contact that begins
};

/// One sample of a motion in doubles, with the changes of contact until the next sample.
struct RecordedSample {
  Vector<double, 6> state;  ///< [z₁, ż₁, z₂, ż₂, u_{j−1}, g], SI; g: see FlowPlace, 0 if engaged
  RecordedContact before;                ///< contact before the sample
  RecordedContact from;                  ///< contact after the sample
  std::vector<RecordedSwitch> switches;  ///< changes before the next sample
};

/// A recorded period of a motion that switches between the samples: the candidate for a proof.
struct RecordedContacts {
  std::vector<RecordedSample> samples;  ///< the N samples of the period
  bool repeats = false;                 ///< whether the contact at the end equals that at the start
  bool is_plain = false;  ///< whether no guard touches 0 without crossing and no changes accumulate

  /// Whether the drive changes its contact in the period.
  bool switches() const {
    for (const RecordedSample& sample : samples)
      if (!sample.switches.empty() || !(sample.before == sample.from)) return true;
    return false;
  }
};

/// The observer of EventMotion::advance that records the changes of contact after a sample.
template <class Contact>
class ContactRecorder {
 public:
  ContactRecorder(const EventMotion<Contact>& motion, RecordedSample& sample)
      : motion_(motion), sample_(sample) {}

  void flowed(int, double begin, double length) { reached_ = begin + length; }
  void commanded() const {}
  void switched(int, int, int guard, const typename EventMotion<Contact>::Instant&) {
    sample_.switches.push_back({reached_, guard, contact_of(motion_)});
  }

  static RecordedContact contact_of(const EventMotion<Contact>& motion) {
    return {motion.contact().word(), motion.contact().sign()};
  }

 private:
  const EventMotion<Contact>& motion_;
  RecordedSample& sample_;
  double reached_ = 0.0;
};

/// Simulates a motion of the two masses over one period and records its states and contacts.
/// @param point    state at which the period begins
/// @param samples  number N of samples
template <class Contact>
RecordedContacts recorded_contacts(RepeatingMotion<Contact> motion,
                                   const StroboscopicState<Contact>& point, std::size_t samples) {
  using Recorder = ContactRecorder<Contact>;
  motion.go_to(point);
  const EventMotion<Contact>& here = motion.motion();
  RecordedContacts period;
  for (std::size_t j = 0; j < samples; ++j) {
    RecordedSample sample{};
    sample.before = Recorder::contact_of(here);
    const double gap = sample.before.mode == ContactMode::engaged ? 0.0
                       : sample.before.sign > 0.0                 ? here.contact().upper()
                                                                  : here.contact().lower();
    sample.state << here.state(), here.previous_command(), gap;
    motion.sense();
    sample.from = Recorder::contact_of(here);
    motion.advance(Recorder(here, sample));
    period.samples.push_back(sample);
  }
  period.repeats = Recorder::contact_of(here) == period.samples.front().before;
  period.is_plain = !here.counts().accumulates && here.counts().grazing == 0;
  return period;
}

}  // namespace holdfast::detail
