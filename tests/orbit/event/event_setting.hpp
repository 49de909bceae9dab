#pragma once

#include "holdfast/contact/contact.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/motion/event_motion.hpp"
#include "holdfast/motion/variational_flow.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "support/contacts.hpp"
#include "support/random.hpp"
#include "support/switch_notes.hpp"

namespace holdfast::test {

/// A loop near that of Kollár 2022 whose drive may switch between the samples.
struct EventSetting {
  TwoMass<double> plant;
  DigitalLoop loop;
  double width;

  EventMotion<> motion() const {
    return {loop, test::exact_backlash(plant, width), Vector<double, 4>::Zero()};
  }
};

/// Whether a motion stays within 20 mm for some seconds.
inline bool stays_small(EventMotion<> motion, double duration) {
  while (motion.time() < duration) {
    motion.sense();
    if (!(motion.state().cwiseAbs().maxCoeff() < 2.0) || !(std::abs(motion.state()[0]) < 0.02))
      return false;
    motion.advance();
  }
  return !motion.counts().accumulates;
}

/// All masses, springs and dampers of Table 1 within ± 30 %, τ 0.5 … 20 ms, δ = 0, τ/3 and τ in
/// turn, both holds of the force in turn, r₀ 0.1 … 3 mm, F at 3 … 60 Hz, gains up to those of the
/// paper; to half of them a second harmonic, which makes sticking end in any way.
inline EventSetting random_event_setting(Random& random, int index) {
  const auto near = [&random](double value) { return value * random.uniform(0.7, 1.3); };
  const TwoMass<double> table = kollar2022_plant();
  EventSetting setting;
  setting.plant = {near(table.conductor_mass),     near(table.conductor_stiffness),
                   near(table.conductor_damping),  near(table.absorber_mass),
                   near(table.absorber_stiffness), near(table.absorber_damping)};
  const double period = random.log_uniform(5e-4, 2e-2);
  const double delays[] = {0.0, period / 3.0, period};
  setting.loop.sampling = {period, delays[index % 3]};
  setting.loop.gains = {-557.0 * random.uniform(0.2, 1.1), -13.0 * random.uniform(0.2, 1.2)};
  setting.loop.force.harmonics = {{0.5, random.log_uniform(3.0, 60.0), random.uniform(0.0, 6.0)}};
  if (index % 4 >= 2) setting.loop.force.harmonics.push_back({0.3, random.log_uniform(20.0, 80.0)});
  setting.loop.hold = index % 2 == 0 ? ForceHold::exact : ForceHold::sampled;
  setting.width = random.log_uniform(1e-4, 3e-3);
  return setting;
}

/// The same for a motion that stays small for three seconds.
inline EventSetting bounded_event_setting(Random& random, int index) {
  for (;;) {
    EventSetting setting = random_event_setting(random, index);
    if (stays_small(setting.motion(), 3.0)) return setting;
  }
}

/// X = [z; u_{j−1}; g; z₁ as read] of a motion that has come to a sample.
inline Vector<double, 7> extended_state(const EventMotion<>& motion) {
  const bool reads = motion.controller().limits().velocity == VelocitySensing::difference;
  Vector<double, 7> extended;
  extended << motion.state(), motion.previous_command(),
      motion.contact().is_anchored(motion.contact().mode()) ? motion.contact().lower() : 0.0,
      reads ? motion.controller().memory().previous_displacement : 0.0;
  return extended;
}

/// A motion moved by a deviation of its z, u_{j−1} and g.
inline EventMotion<> displaced_motion(const EventMotion<>& motion, const Vector<double, 7>& by) {
  EventMotion<> other = motion;
  DriveContact<> contact = motion.contact();
  contact.shift_gap(by[5]);
  other.restore(motion.index(), motion.state() + by.head<4>(), motion.previous_command() + by[4],
                contact);
  return other;
}

/// Sizes of the entries of X that belong to a displacement of 1 mm.
inline Vector<double, 7> sizes_of(const EventMotion<>& motion) {
  constexpr double displacement = 1e-3, rate = 20.0;
  const PdGains<double>& gains = motion.loop().gains;
  const double command =
      (std::abs(gains.proportional) + rate * std::abs(gains.differential)) * displacement;
  Vector<double, 7> sizes;
  sizes << displacement, rate * displacement, displacement, rate * displacement,
      std::max(command, 1e-6), displacement, displacement;
  return sizes;
}

/// The two neighbours of a motion along a direction after some samples, nothing if either goes
/// another way than `seen`.
inline std::optional<Vector<double, 7>> difference_along(const EventMotion<>& motion,
                                                         const Vector<double, 7>& direction,
                                                         int samples,
                                                         const std::vector<MotionSwitch>& seen) {
  Vector<double, 7> ends[2];
  for (const int side : {0, 1}) {
    EventMotion<> other =
        displaced_motion(motion, side == 0 ? direction : Vector<double, 7>(-direction));
    SwitchNotes notes(other);
    notes.move(samples);
    if (!same_way(notes.switches, seen)) return std::nullopt;
    ends[side] = extended_state(other);
  }
  return 0.5 * (ends[0] - ends[1]);
}

/// The derivative along a direction by differences over two steps, without their first error.
struct Difference {
  Vector<double, 7> value;
  double error;  ///< of the larger step against the smaller one, in `sizes`
};

inline std::optional<Difference> derivative_along(const EventMotion<>& motion,
                                                  const Vector<double, 7>& direction, double step,
                                                  int samples,
                                                  const std::vector<MotionSwitch>& seen) {
  const auto coarse = difference_along(motion, direction * step, samples, seen);
  const auto fine = difference_along(motion, direction * (0.5 * step), samples, seen);
  if (!coarse || !fine) return std::nullopt;
  const Vector<double, 7> first = *coarse / step, second = *fine / (0.5 * step);
  const Vector<double, 7> sizes = sizes_of(motion);
  return Difference{(4.0 * second - first) / 3.0,
                    (second - first).cwiseQuotient(sizes).cwiseAbs().maxCoeff()};
}

}  // namespace holdfast::test
