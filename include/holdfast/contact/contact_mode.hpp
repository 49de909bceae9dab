#pragma once

#include <cstdint>

#include "holdfast/core/compiler.hpp"

namespace holdfast {

/// The contact modes of a drive with backlash. Only with Switching::exact can `stick` occur.
enum class ContactMode : std::uint8_t {
  engaged,  ///< the force of the drive is transmitted
  gap,      ///< the drive crosses its gap; no force is transmitted
  stick,    ///< a part of the drive's force is transmitted; it keeps the relative velocity at 0
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
