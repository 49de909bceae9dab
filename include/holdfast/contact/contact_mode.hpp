#pragma once

#include <cstdint>

#include "holdfast/core/compiler.hpp"

namespace holdfast {

/// Contact modes of the drive, when its backlash switches between the samples.
enum class ContactMode : std::uint8_t {
  engaged,  ///< it transmits the command u
  gap,      ///< it crosses its gap and transmits nothing
  stick,  ///< its sides stay together, Δż = 0, and it transmits what that takes, between 0 and u
};

/// From an instant on the drive is in another mode.
struct ContactSwitch {
  double time;       ///< s
  ContactMode mode;  ///< from then on
};

/// "engaged", "gap" or "stick".
inline const char* word_for(ContactMode mode) {
  switch (mode) {
    case ContactMode::engaged:
      return "engaged";
    case ContactMode::gap:
      return "gap";
    case ContactMode::stick:
      return "stick";
  }
  return "";
}

}  // namespace holdfast
