#pragma once

#include "holdfast/contact/contact.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/motion/event_motion.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "support/contacts.hpp"
#include "support/kollar_case.hpp"
#include "support/move_samples.hpp"
#include "support/switch_notes.hpp"

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

/// A force that is zero at all times, but recorded: what its rows part has to be followed by
/// series.
inline std::shared_ptr<const RecordedForce> zero_record(const std::vector<double>& times) {
  return std::make_shared<const RecordedForce>(times, std::vector<double>(times.size(), 0.0),
                                               RecordInterpolation::linear);
}

/// A state away from rest.
inline Vector<double, 4> pushed_state() { return {0.003, -0.05, 0.001, 0.2}; }

}  // namespace holdfast::test
