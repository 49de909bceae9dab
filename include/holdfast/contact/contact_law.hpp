#pragma once

#include <cstdint>
#include <variant>

#include "holdfast/contact/dead_zone.hpp"
#include "holdfast/contact/hysteresis.hpp"
#include "holdfast/contact/play.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/core/select.hpp"

namespace holdfast {

/// How the drive decides at its samples whether it transmits the control force.
///
/// In continuous time `kollar`, `immediate` and `play` are one and the same law, the play operator:
/// the drive transmits while it moves its far side; where Δż comes to zero at Δz = d it enters the
/// gap [d − r₀, d] (from Δż > 0) or [d, d + r₀] (from Δż < 0) and transmits again once Δz leaves
/// it. They differ in what sampling makes of it:
///  - `kollar` sees a reversal in the sign of the sampled Δż and ends the gap at the sample in
///    which it shows; a sample that leaves the gap transmits;
///  - `immediate` does the same, but a sample that leaves the gap with a reversal enters the next
///    gap;
///  - `play` sees a reversal where the sampled Δz comes no farther and ends the gap at the extreme
///    sample; a sample outside it transmits, also where Δz has passed the whole gap since the
///    sample before.
///
/// `dead_zone` is another law: its gap lies about Δz = 0 and does not move.
enum class ContactLaw : std::uint8_t {
  kollar,     ///< `Backlash`: Kollár 2022, Eqs. (7)–(8)
  immediate,  ///< `ImmediateBacklash`: the same, with entry tested at the exit sample too
  play,       ///< `PlayBacklash`: the play operator on sampled Δz
  dead_zone,  ///< `DeadZone`: a gap about Δz = 0 between two stops
  none,       ///< `NoBacklash`: always transmits
};

/// A drive without backlash: the force is transmitted from every sample on.
template <class Scalar>
class NoBacklash {
 public:
  /// Takes in one sample. @return true
  Mask<Scalar> step(const Scalar& /*relative_displacement*/, const Scalar& /*relative_velocity*/) {
    return !inside();
  }
  /// Never.
  Mask<Scalar> inside() const { return Scalar(0) > Scalar(0); }
};

/// A law and its parameters.
struct BacklashParameters {
  ContactLaw law = ContactLaw::kollar;  ///< which of the laws
  double width = 0.0;                   ///< r₀ (m), ≥ 0; `none` does not use it
  double contact_stiffness = 0.0;       ///< k_c (N/m), ≥ 0; only `dead_zone` uses it
  double contact_damping = 0.0;         ///< c_c (N s/m), ≥ 0; only `dead_zone` uses it
};

/// Refuses parameters outside the ranges that their members state, whether or not the law uses
/// them.
/// @throws InvalidParameter naming the first member that is not admissible
inline void validate(const BacklashParameters& backlash) {
  validate_backlash_width(backlash.width);
  require_non_negative("contact stiffness kc", backlash.contact_stiffness, "N/m");
  require_non_negative("contact damping cc", backlash.contact_damping, "N s/m");
}

/// A drive whose law is chosen at run time.
///
///     SampledContact contact({ContactLaw::play, 0.002});
///     const bool engaged = contact.step(relative_displacement, relative_velocity);
///
/// The decisions are those of the class that `ContactLaw` names, sample by sample.
class SampledContact {
 public:
  /// @throws InvalidParameter as `validate` does
  explicit SampledContact(const BacklashParameters& backlash) : law_(chosen_law(backlash)) {}

  /// Takes in one sample, Δz (m) and Δż (m/s).
  /// @return true when the force is transmitted during the coming period
  bool step(double relative_displacement, double relative_velocity) {
    return std::visit([&](auto& law) { return law.step(relative_displacement, relative_velocity); },
                      law_);
  }

  /// True when nothing has been transmitted since the last step.
  bool inside() const {
    return std::visit([](const auto& law) { return law.inside(); }, law_);
  }

  /// −1, 0 or +1: the stop that a dead zone touched at the last step; 0 for the other laws.
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
