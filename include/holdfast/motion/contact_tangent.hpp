#pragma once

#include "holdfast/contact/contact_guard.hpp"
#include "holdfast/contact/contact_mode.hpp"
#include "holdfast/contact/exact_backlash.hpp"
#include "holdfast/core/types.hpp"

namespace holdfast {

/// What the tangent of a motion asks of its contact; as it stands, for stops that do not move.
template <class Contact>
struct ContactTangent {
  /// The mode in which Δż = 0; −1: there is none.
  static constexpr int sticking = -1;
  /// Whether the gap lies where the drive reversed, in a mode.
  static constexpr bool anchored(int) { return false; }
  /// Gradient of the guard at which a mode is left.
  static Vector<double, 4> gradient(int) { return displacement_row(); }
};

/// The same for the gap of ExactBacklash, which lies where Δż last reversed, at Δz = g.
template <>
struct ContactTangent<ExactBacklash> {
  /// Number of `ContactMode::stick`.
  static constexpr int sticking = static_cast<int>(ContactMode::stick);
  /// True in the gap and in stick; while engaged g is without effect.
  static constexpr bool anchored(int mode) {
    return mode != static_cast<int>(ContactMode::engaged);
  }
  /// By z: of Δz − g where the mode is anchored, of Δż while engaged.
  static Vector<double, 4> gradient(int from) {
    return anchored(from) ? displacement_row() : velocity_row();
  }
};

namespace detail {

/// Whether the command of the present sample goes to the drive; contacts that decide it at samples
/// have `transmits_command()`.
template <class Contact>
auto transmits_command(const Contact& contact, int) -> decltype(contact.transmits_command()) {
  return contact.transmits_command();
}
template <class Contact>
bool transmits_command(const Contact&, long) {
  return true;
}

}  // namespace detail

}  // namespace holdfast
