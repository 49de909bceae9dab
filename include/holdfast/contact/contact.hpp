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
/// In each mode the plant is affine (`dynamics`), guards tell how long it lasts, and `reached`,
/// `jumped` and `sample` are the transitions. All is that of the law, to the last bit.
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

  /// The law with what it remembers.
  const Law& law() const { return law_; }

  /// How states of the plant are read.
  const PortReadings<Plant>& readings() const {
    return asked(law_,
                 [](const auto& law) -> const PortReadings<Plant>& { return law.readings(); });
  }
  /// How the state moves in one of the modes.
  DynamicsOf<Plant> dynamics(int mode) const {
    return asked(law_, [&](const auto& law) { return law.dynamics(mode); });
  }
  /// The two masses whose energy bounds the motion in one of the modes.
  Plant plant(int mode) const {
    return asked(law_, [&](const auto& law) -> Plant { return law.plant(mode); });
  }
  /// Number of the present mode, 0 … `modes` − 1.
  int mode() const {
    return asked(law_, [](const auto& law) { return law.mode(); });
  }
  /// What the drive does in the present mode.
  ContactMode word() const {
    return asked(law_, [](const auto& law) { return law.word(); });
  }
  /// u (N) as it goes to the drive.
  double commanded(double command) const {
    return asked(law_, [&](const auto& law) { return law.commanded(command); });
  }
  /// What the drive transmits (N).
  double transmitted(const Instant& now) const {
    return asked(law_, [&](const auto& law) { return law.transmitted(now); });
  }
  /// Whether the command of the present sample takes effect: unless a law at samples found it not
  /// transmitted.
  bool transmits_command() const {
    const auto* sampled = std::get_if<SampledLawOf<Plant>>(&law_);
    return sampled == nullptr || sampled->transmits_command();
  }
  /// Whether the contact changes at samples alone.
  bool switches_at_samples() const { return std::holds_alternative<SampledLawOf<Plant>>(law_); }
  /// What ends the present mode.
  ModeGuards guards() const {
    return asked(law_, [](const auto& law) { return law.guards(); });
  }

  /// Takes a sample.
  void sample(const State& state) {
    asked(law_, [&](auto& law) { law.sample(state); });
  }
  /// The force or the command has jumped, or may have.
  void jumped(const Instant& now) {
    asked(law_, [&](auto& law) { law.jumped(now); });
  }
  /// The conductor was displaced against the absorber.
  void displaced() {
    asked(law_, [](auto& law) { law.displaced(); });
  }
  /// Takes rounding out of a state of the present mode, which has come from another one in it.
  void keep(const State& before, State& after) const {
    asked(law_, [&](const auto& law) { law.keep(before, after); });
  }
  /// Some time has passed since the last change.
  void flowed() {
    asked(law_, [](auto& law) { law.flowed(); });
  }
  /// The sign, ±1, that a guard has taken whose sign was not known.
  void learn_sign(double sign) {
    asked(law_, [&](auto& law) { law.learn_sign(sign); });
  }
  /// A guard has come to zero: the contact changes.
  void reached(int guard, Instant& now) {
    asked(law_, [&](auto& law) { law.reached(guard, now); });
  }

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
  /// Upper end of it, Δz (m); 0 of another law.
  double upper() const {
    const auto* play = std::get_if<ExactBacklashOf<Plant>>(&law_);
    return play == nullptr ? 0.0 : play->upper();
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
  template <class AnyLaw, class Ask>
  static decltype(auto) asked(AnyLaw& law, const Ask& ask) {
    if (auto* play = std::get_if<0>(&law)) return ask(*play);
    if (auto* sampled = std::get_if<2>(&law)) return ask(*sampled);
    return ask(*std::get_if<1>(&law));
  }

  Law law_;
};

}  // namespace holdfast
