#pragma once

#include <type_traits>

#include "holdfast/contact/contact.hpp"
#include "holdfast/contact/contact_guard.hpp"
#include "holdfast/contact/contact_mode.hpp"
#include "holdfast/contact/exact_backlash.hpp"
#include "holdfast/core/types.hpp"

namespace holdfast {

/// What the tangent of a motion asks of its contact; by default, for stops that do not move.
template <class Contact>
struct ContactTangent {
  /// The mode in which Δż = 0; −1: there is none.
  static constexpr int sticking = -1;
  /// Whether the gap lies where the drive reversed, in a mode.
  static constexpr bool anchored(int) { return false; }
};

/// The same for the gap of ExactBacklash, which lies where Δż last reversed, at Δz = g.
template <class Plant>
struct ContactTangent<ExactBacklashOf<Plant>> {
  /// Number of `ContactMode::stick`.
  static constexpr int sticking = static_cast<int>(ContactMode::stick);
  /// True in the gap and in stick; while engaged g is without effect.
  static constexpr bool anchored(int mode) {
    return mode != static_cast<int>(ContactMode::engaged);
  }
};

/// The mode of a contact in which Δż = 0; −1: there is none.
template <class Contact>
int sticking_mode(const Contact& contact) {
  return with_law(contact, [](const auto& law) {
    return ContactTangent<std::decay_t<decltype(law)>>::sticking;
  });
}

/// Whether the gap of a contact lies where the drive reversed, in a mode: its surface is that of
/// Δz − g, else that of Δż for a moving gap and of Δz for stops.
template <class Contact>
bool is_anchored(const Contact& contact, int mode) {
  return with_law(contact, [mode](const auto& law) {
    return ContactTangent<std::decay_t<decltype(law)>>::anchored(mode);
  });
}

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
