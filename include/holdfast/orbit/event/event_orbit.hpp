#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "holdfast/contact/contact_mode.hpp"
#include "holdfast/orbit/loop_orbit.hpp"

namespace holdfast {

/// How far an orbit is from switching otherwise than it does; +∞ for what it never comes to.
///
/// Of a margin of zero the motion grazes: its neighbours do not switch alike, and multipliers do
/// not describe them. They are those of the guards of the contact between the samples; what a law
/// decides at the samples alone has none here.
struct SwitchingMargins {
  /// The margin of what the motion never comes to.
  static constexpr double none = std::numeric_limits<double>::infinity();

  /// Of Δz from an end of its gap, where it turns before it has come there (m).
  double border_distance = none;
  /// Way of Δz from where it left a gap to where it reverses (m).
  double shortest_travel = none;
  /// |Δż| where Δz passes an end of its gap (m/s).
  double exit_velocity = none;
  /// |Δż| of an engaged drive where it is least without a reversal (m/s).
  double reversal_velocity = none;
  /// |a(u)|, the relative acceleration at a reversal under the force that was transmitted (m/s²).
  double reversal_acceleration = none;
  /// |a(0)|, that without a force, whose sign decides between stick and gap at a reversal (m/s²).
  double stick_acceleration = none;
};

/// A periodic motion of the sampled loop whose contact switches between the samples, with its
/// numerical certificate.
///
/// What is certified, in double precision: that the motion of EventMotion closes upon itself after
/// N samples, to the error stated; that it switches alike in three successive periods; that all its
/// multipliers, with the saltation at every switch, lie inside the unit circle; and how far it is
/// from switching otherwise. Not certified is what interval arithmetic would: that a true orbit
/// lies within a bound of the computed one.
///
/// Its multipliers are those of [x; u_{j−1}; the gap; the displacement as last read] that depend on
/// the past at all, padded to five.
/// @tparam States  N, the order of the plant
template <int States>
struct EventOrbitOf : LoopOrbit<States> {
  std::vector<ContactMode> modes;  ///< from each sample on
  /// At each sample (N): u_j where the drive is engaged, in force from t_j + δ on, 0 in the gap,
  /// and in stick what holds the sides together at t_j.
  std::vector<double> forces;
  std::vector<ContactSwitch> switches;  ///< of one period, s after its first sample
  SwitchingMargins margins;             ///< the nearest of all switches and all that do not happen
  std::array<double, 3> time_share;     ///< of each ContactMode; their sum is 1
  double largest_displacement;          ///< max |z(t)| (m), between the samples too
  double largest_sample;                ///< max |z_j| (m), at the samples
  StateScale extent;                    ///< of both sides of the gap, at the samples

  /// Largest |z| (m) of the conductor at the samples.
  double amplitude() const { return largest_sample; }

  /// Share of the samples after which the drive is engaged.
  double engaged_fraction() const {
    const auto engaged = std::count(modes.begin(), modes.end(), ContactMode::engaged);
    return static_cast<double>(engaged) / static_cast<double>(modes.size());
  }
  /// Share of the time in which the drive is engaged.
  double engaged_time_fraction() const { return time_share[0]; }

  /// How near it is to switching otherwise, as a share of its own size: the smallest of the margins
  /// in the orbit's largest displacement x, its largest velocity v and v²/x. Infinite where it
  /// comes to no surface.
  double border_share() const {
    const double acceleration = extent.velocity * extent.velocity / extent.displacement;
    return std::min({extent.share_of_displacement(margins.border_distance),
                     extent.share_of_displacement(margins.shortest_travel),
                     extent.share_of_velocity(margins.exit_velocity),
                     extent.share_of_velocity(margins.reversal_velocity),
                     margins.reversal_acceleration / acceleration,
                     margins.stick_acceleration / acceleration});
  }
  /// How often a mode begins in one period.
  std::int64_t entries(ContactMode mode) const {
    return std::count_if(switches.begin(), switches.end(),
                         [mode](const ContactSwitch& change) { return change.mode == mode; });
  }
};

/// That of the two masses.
using EventOrbit = EventOrbitOf<4>;

}  // namespace holdfast
