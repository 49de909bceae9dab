#pragma once

#include <cstdint>

#include "holdfast/core/compiler.hpp"

namespace holdfast {

/// The contact modes of a drive with backlash; `stick` occurs with Switching::exact only.
enum class ContactMode : std::uint8_t {
  engaged,  ///< the command u is transmitted
  gap,      ///< the drive crosses its gap; no force is transmitted
  stick,    ///< a transmitted force between 0 and the drive's full force keeps Δż = 0
};

/// A change of the drive's contact mode at an instant.
struct ContactSwitch {
  double time;       ///< instant (s)
  ContactMode mode;  ///< mode that begins
};

/// The name of a mode: "engaged", "gap" or "stick".
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
