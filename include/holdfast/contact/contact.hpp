#pragma once

#include <cstdint>
#include <utility>
#include <variant>

#include "holdfast/contact/contact_guard.hpp"
#include "holdfast/contact/contact_law.hpp"
#include "holdfast/contact/contact_mode.hpp"
#include "holdfast/contact/exact_backlash.hpp"
#include "holdfast/contact/exact_dead_zone.hpp"
#include "holdfast/contact/mode_dynamics.hpp"
#include "holdfast/contact/sampled_law.hpp"
#include "holdfast/plant/port_readings.hpp"
#include "holdfast/plant/ports.hpp"
#include "holdfast/plant/two_mass.hpp"

namespace holdfast {

/// When the drive enters and leaves its backlash.
enum class Switching : std::uint8_t {
  sampled,  ///< at samples, by the law's rule for them
  exact,    ///< when it happens; `kollar`, `immediate` and `play` are one law then
};

/// The contact of a drive with its load as an automaton of three modes, its law chosen at run time:
/// the play operator between the samples (`ExactBacklashOf`), a dead zone between the samples
/// (`ExactDeadZoneOf`), or any law at samples alone (`SampledLawOf`).
///
///     DriveContact<> contact(plant, {ContactLaw::play, 0.0005}, Switching::exact, state);
///
/// In each mode of a law the plant is affine (`dynamics`), guards tell how long it lasts, and
/// `reached`, `jumped` and `sample` are the transitions; `with_law` gives the law.
/// @tparam DrivenPlant  TwoMass<double> or a LinearPlant<double, N>
template <class DrivenPlant = TwoMass<double>>
class DriveContact {
 public:
  using Plant = DrivenPlant;                           ///< what the drive moves
  using State = StateOf<Plant>;                        ///< x, N × 1
  using Instant = ContactInstantOf<states_of<Plant>>;  ///< what a change depends on
  using ModeGuards = GuardsOf<states_of<Plant>>;       ///< what ends a mode
  /// The law with what it remembers.
  using Law = std::variant<ExactBacklashOf<Plant>, ExactDeadZoneOf<Plant>, SampledLawOf<Plant>>;

  static constexpr int modes = 3;  ///< numbered as the law has them

  /// @param plant          without control
  /// @param backlash       the law and its parameters
  /// @param switching      between the samples, or at them alone
  /// @param initial_state  where the motion begins, N × 1
  /// @throws InvalidParameter where the law refuses one of them
  DriveContact(const Plant& plant, const BacklashParameters& backlash, Switching switching,
               const State& initial_state)
      : law_(law_of(plant, backlash, switching, initial_state)) {}

  /// A law by itself.
  explicit DriveContact(Law law) : law_(std::move(law)) {}

  /// Calls `visit` with the law, of one type or another. @return what it returns, of one type for
  /// all of them
  template <class Visit>
  decltype(auto) visit(const Visit& visit) {
    return visited(law_, visit);
  }
  /// The same of a contact that stays as it is.
  template <class Visit>
  decltype(auto) visit(const Visit& visit) const {
    return visited(law_, visit);
  }

  /// How states of the plant are read.
  const PortReadings<Plant>& readings() const {
    return visit([](const auto& law) -> const PortReadings<Plant>& { return law.readings(); });
  }
  /// Number of the present mode, 0 … `modes` − 1.
  int mode() const {
    return visit([](const auto& law) { return law.mode(); });
  }
  /// What the drive does in the present mode.
  ContactMode word() const {
    return visit([](const auto& law) { return law.word(); });
  }
  /// What ends the present mode.
  ModeGuards guards() const {
    return visit([](const auto& law) { return law.guards(); });
  }
  /// Whether the command of the present sample takes effect: unless a law at samples found it not
  /// transmitted.
  bool transmits_command() const {
    const auto* sampled = std::get_if<SampledLawOf<Plant>>(&law_);
    return sampled == nullptr || sampled->transmits_command();
  }
  /// Whether the contact changes at samples alone.
  bool switches_at_samples() const { return std::holds_alternative<SampledLawOf<Plant>>(law_); }

  /// Whether the drive's gap lies where it last reversed, and it is in it.
  bool remembers_gap() const {
    const auto* play = std::get_if<ExactBacklashOf<Plant>>(&law_);
    return play != nullptr && play->remembers_gap();
  }
  /// Lower end of a gap that lies where the drive last reversed, Δz (m); 0 of another law.
  double lower() const {
    const auto* play = std::get_if<ExactBacklashOf<Plant>>(&law_);
    return play == nullptr ? 0.0 : play->lower();
  }
  /// Moves both ends by a displacement (m); without effect on another law.
  void shift_gap(double by) {
    if (auto* play = std::get_if<ExactBacklashOf<Plant>>(&law_)) play->shift_gap(by);
  }

 private:
  static Law law_of(const Plant& plant, const BacklashParameters& backlash, Switching switching,
                    const State& initial_state) {
    if (switching == Switching::sampled) return SampledLawOf<Plant>(plant, backlash);
    if (backlash.law == ContactLaw::dead_zone)
      return ExactDeadZoneOf<Plant>(plant, backlash.width, backlash.contact_stiffness,
                                    backlash.contact_damping, initial_state);
    const double width = backlash.law == ContactLaw::none ? 0.0 : backlash.width;
    return ExactBacklashOf<Plant>(plant, width);
  }

  /// std::visit without its way for a variant that holds nothing: this one always holds a law.
  template <class AnyLaw, class Visit>
  static decltype(auto) visited(AnyLaw& law, const Visit& visit) {
    if (auto* play = std::get_if<0>(&law)) return visit(*play);
    if (auto* sampled = std::get_if<2>(&law)) return visit(*sampled);
    return visit(*std::get_if<1>(&law));
  }

  Law law_;
};

/// Calls `visit` with the law of a contact: that which a DriveContact holds, and any other contact
/// itself. What is asked often within a sample asks the law, not the contact. @return what it
/// returns
template <class Contact, class Visit>
decltype(auto) with_law(Contact& contact, const Visit& visit) {
  return visit(contact);
}
/// That of a law chosen at run time.
template <class Plant, class Visit>
decltype(auto) with_law(DriveContact<Plant>& contact, const Visit& visit) {
  return contact.visit(visit);
}
/// The same of a contact that stays as it is.
template <class Plant, class Visit>
decltype(auto) with_law(const DriveContact<Plant>& contact, const Visit& visit) {
  return contact.visit(visit);
}

}  // namespace holdfast
