#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "case/case.hpp"
#include "holdfast/contact/contact_mode.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/motion/implemented_loop.hpp"

namespace holdfast::program {

/// Longest period of the orbits looked for (samples); eight times as many are looked at.
inline constexpr std::int64_t longest_studied_period = 8'000;

/// How a loop is taken: when its drive switches, and how its force is held over a sample.
struct Reading {
  Switching switching;
  ForceHold hold;

  /// "sampled" or "exact".
  const char* switching_word() const { return switching == Switching::exact ? "exact" : "sampled"; }
  const char* hold_word() const { return hold == ForceHold::exact ? "exact" : "sampled"; }
};

/// Switching at samples with the force held, as in Kollár 2022; switching at samples with the exact
/// force; exact switching with the exact force.
inline constexpr std::array<Reading, 3> readings = {{{Switching::sampled, ForceHold::sampled},
                                                     {Switching::sampled, ForceHold::exact},
                                                     {Switching::exact, ForceHold::exact}}};
enum : std::size_t { sampled_and_held = 0, sampled_switching = 1, exact_switching = 2 };

/// The motion of a case, from its initial state, in one reading.
struct StudiedLoop {
  Case the_case;
  Reading reading;
  double duration;  ///< s; its second half counts as steady
};

/// Motion in the second half of its duration.
struct SteadyMotion {
  bool diverges = false;
  bool accumulates = false;  ///< its changes of contact do: it was not followed to the end
  double largest_displacement = std::numeric_limits<double>::quiet_NaN();  ///< max |z₁(t)| (m)
  double largest_of_samples = std::numeric_limits<double>::quiet_NaN();    ///< max |z₁(t_j)| (m)
  /// How often each ContactMode begins in half a period of the excitation.
  std::array<double, 3> phases_per_half_cycle{};
};

/// The orbit that a motion comes to.
struct FoundPeriod {
  std::string verdict;               ///< "periodic(100)", or why there is no certified orbit
  std::int64_t samples = 0;          ///< 0: no certified orbit
  std::int64_t forcing_periods = 0;  ///< 0 without excitation, too
  double seconds = std::numeric_limits<double>::quiet_NaN();
  double largest_multiplier = std::numeric_limits<double>::quiet_NaN();
};

/// Both, for one loop.
struct StudiedMotion {
  StudiedLoop loop;
  SteadyMotion steady;
  FoundPeriod period;
};

/// Follows the motion for its duration. Throws Interrupted.
SteadyMotion steady_motion(const StudiedLoop& studied);

/// Looks for the orbit among periods of up to 8000 samples in 64 000 samples of the motion. Throws
/// Interrupted.
FoundPeriod period_of(const StudiedLoop& studied);

/// Number of samples after which sampling and forcing coincide again; 0 where they never do.
std::int64_t shortest_period(const StudiedLoop& studied);

/// Both for each loop, on many threads; the results do not depend on their number.
/// @param threads  0: all
std::vector<StudiedMotion> study(const std::vector<StudiedLoop>& loops, int threads);

/// A stretch of a motion in which the contact stays as it is.
struct ContactPhase {
  double begin, end;  ///< s
  ContactMode mode;
};

/// A motion at an instant.
struct InstantOfMotion {
  double time;              ///< s
  Vector<double, 4> state;  ///< z (m, m/s, m, m/s)
  double command;           ///< u, the command in force (N)
  double transmitted;       ///< what the drive transmits of it (N)
};

/// A part of a motion, between the samples too.
struct MotionWindow {
  double begin, end;                      ///< s
  std::vector<ContactPhase> phases;       ///< one after the other
  std::vector<InstantOfMotion> instants;  ///< equally far apart, both ends among them
};

/// @param begin, end  s, of the window; 0 ≤ begin < end. The duration does not count.
/// @param instants    2 or more, or 0 for the phases alone
/// Throws NoAnswer where the motion diverges or its changes of contact accumulate.
MotionWindow window_of(const StudiedLoop& studied, double begin, double end, int instants);

/// Twice the largest |z₂ − z₁| (m) of the steady motion without control: a backlash as wide
/// swallows it.
double swing_without_control(const Case& the_case, double duration);

/// Largest |z₁(t)| (m) of the steady motion without control, the force exact.
double amplitude_without_control(const Case& the_case, double duration);

}  // namespace holdfast::program
