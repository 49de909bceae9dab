#pragma once

#include <cstdint>
#include <variant>

#include "holdfast/contact/dead_zone.hpp"
#include "holdfast/contact/hysteresis.hpp"
#include "holdfast/contact/play.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/core/select.hpp"

namespace holdfast {

/// Laws of backlash, which decide whether the drive transmits the control force. Δz = z₂ − z₁ is
/// the displacement of the absorber relative to the conductor; r₀ is the width of the gap.
///
/// In continuous time `kollar`, `immediate` and `play` are the play operator. The drive transmits
/// until Δż reaches zero, at some Δz = d. It then enters the gap [d − r₀, d] if Δż was positive, or
/// [d, d + r₀] if negative. It transmits again once Δz leaves the gap. Under sampling they differ:
/// - `kollar` detects a reversal at the first sample at which Δż is zero or has changed sign; d is
///   Δz of this sample. The first sample outside the gap transmits;
/// - `immediate` is as `kollar`, but the first sample outside the gap may already enter a new gap;
/// - `play` detects a reversal at the first sample at which Δz no longer advances; d is the extreme
///   sampled Δz. Every sample outside the gap transmits, even if Δz has crossed the whole gap since
///   the previous sample.
///
/// `dead_zone` is not a play operator: its gap does not move and is centred at Δz = 0.
enum class ContactLaw : std::uint8_t {
  kollar,     ///< `Backlash`: Kollár 2022, Eqs. (7)–(8)
  immediate,  ///< `ImmediateBacklash`: a sample that leaves a gap may also enter the next gap
  play,       ///< `PlayBacklash`: the play operator on sampled Δz
  dead_zone,  ///< `DeadZone`: a gap about Δz = 0 between two stops
  none,       ///< `NoBacklash`: always transmits
};

/// A drive without backlash: the force of every sample is transmitted.
template <class Scalar>
class NoBacklash {
 public:
  /// Processes one sample. @return true: the force is transmitted
  Mask<Scalar> step(const Scalar& /*relative_displacement*/, const Scalar& /*relative_velocity*/) {
    return !inside();
  }
  /// Whether the drive is in its backlash: always false.
  Mask<Scalar> inside() const { return Scalar(0) > Scalar(0); }
};

/// A law of backlash and its parameters.
struct BacklashParameters {
  ContactLaw law = ContactLaw::kollar;  ///< law of backlash
  double width = 0.0;                   ///< gap width r₀ (m), ≥ 0; unused by `none`
  double contact_stiffness = 0.0;       ///< stop's stiffness k_c (N/m), ≥ 0; `dead_zone` only
  double contact_damping = 0.0;         ///< stop's damping c_c (N s/m), ≥ 0; `dead_zone` only
};

/// Rejects parameters outside the documented ranges, including parameters that the law ignores.
/// @throws InvalidParameter naming the first member that is not admissible
inline void validate(const BacklashParameters& backlash) {
  validate_backlash_width(backlash.width);
  require_non_negative("contact stiffness kc", backlash.contact_stiffness, "N/m");
  require_non_negative("contact damping cc", backlash.contact_damping, "N s/m");
}

/// The contact of a drive, updated at samples only, with a backlash law chosen at run time.
///
///     SampledContact contact({ContactLaw::play, 0.002});
///     const bool engaged = contact.step(relative_displacement, relative_velocity);
///
/// The decisions are exactly those of the class named in ContactLaw, for instance PlayBacklash.
class SampledContact {
 public:
  /// Constructs the contact before its first sample. @throws InvalidParameter as validate() does
  explicit SampledContact(const BacklashParameters& backlash) : law_(chosen_law(backlash)) {}

  /// Processes one sample, Δz (m) and Δż (m/s).
  /// @return true where the force is transmitted until the next sample
  bool step(double relative_displacement, double relative_velocity) {
    return std::visit([&](auto& law) { return law.step(relative_displacement, relative_velocity); },
                      law_);
  }

  /// Whether no force has been transmitted since the last step.
  bool inside() const {
    return std::visit([](const auto& law) { return law.inside(); }, law_);
  }

  /// The stop touched at the last step: −1 lower, +1 upper, 0 none. Laws without stops return 0.
  int side() const {
    const auto* zone = std::get_if<DeadZone<double>>(&law_);
    return zone == nullptr ? 0 : static_cast<int>(zone->touched_side());
  }

 private:
  using AnyLaw = std::variant<Backlash<double>, ImmediateBacklash<double>, PlayBacklash<double>,
                              DeadZone<double>, NoBacklash<double>>;

  static AnyLaw chosen_law(const BacklashParameters& backlash) {
    validate(backlash);
    switch (backlash.law) {
      case ContactLaw::kollar:
        return Backlash<double>(backlash.width);
      case ContactLaw::immediate:
        return ImmediateBacklash<double>(backlash.width);
      case ContactLaw::play:
        return PlayBacklash<double>(backlash.width);
      case ContactLaw::dead_zone:
        return DeadZone<double>(backlash.width);
      case ContactLaw::none:
        break;
    }
    return NoBacklash<double>();
  }

  AnyLaw law_;
};

}  // namespace holdfast
