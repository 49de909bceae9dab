#pragma once

#include "holdfast/contact/contact_guard.hpp"
#include "holdfast/contact/contact_law.hpp"
#include "holdfast/contact/contact_mode.hpp"
#include "holdfast/contact/mode_dynamics.hpp"
#include "holdfast/plant/port_readings.hpp"
#include "holdfast/plant/ports.hpp"
#include "holdfast/plant/two_mass.hpp"

namespace holdfast {

/// A drive that enters and leaves its backlash at samples alone, by any law: the contact of an
/// EventMotion that does not change between the samples.
///
/// Where the law says that the force is not transmitted the computer's command of that sample is
/// without effect, as in SampledMotion: u_j = 0 from t_j + δ on. The stops of a dead zone touch
/// from the sample on.
///
/// A drive with states of its own follows that command: what it transmits fades with them.
/// @tparam DrivenPlant  TwoMass<double> or a LinearPlant<double, N>
template <class DrivenPlant>
class SampledLawOf {
 public:
  using Plant = DrivenPlant;                           ///< what the drive moves
  using State = StateOf<Plant>;                        ///< x, N × 1
  using Instant = ContactInstantOf<states_of<Plant>>;  ///< what a change depends on
  using ModeGuards = GuardsOf<states_of<Plant>>;       ///< what ends a mode

  static constexpr int modes = 3;  ///< on the lower stop, between the stops, on the upper one

  /// @throws InvalidParameter where the law's parameters are not admissible
  SampledLawOf(const Plant& plant, const BacklashParameters& backlash)
      : plant_(plant), readings_(plant), backlash_(backlash), law_(backlash) {}

  /// How the state moves in one of the modes. The command is in force in all of them: it is
  /// `commanded` that leaves out what is not transmitted.
  DynamicsOf<Plant> dynamics(int mode) const {
    const int side = mode - 1;
    if (side != 0)
      return dynamics_on_stop(plant_, backlash_.contact_stiffness, backlash_.contact_damping,
                              0.5 * side * backlash_.width);
    return engaged_dynamics(plant_);
  }
  /// The two masses whose energy bounds the motion in one of the modes; on a stop that is part of
  /// it.
  Plant plant(int mode) const {
    return mode == 1
               ? plant_
               : plant_on_stop(plant_, backlash_.contact_stiffness, backlash_.contact_damping);
  }

  /// How states of the plant are read.
  const PortReadings<Plant>& readings() const { return readings_; }

  /// Number of the present mode, 0 … `modes` − 1; always 1 but for a dead zone.
  int mode() const { return side_ + 1; }
  /// `engaged` before the first sample and where the last one found the force transmitted, else
  /// `gap`.
  ContactMode word() const { return engaged_ ? ContactMode::engaged : ContactMode::gap; }
  /// u_j (N) of a sample's command: that command, or 0 where the law does not transmit.
  double commanded(double command) const { return engaged_ ? command : 0.0; }
  /// u_j (N), as `commanded` has decided it; an ideal drive transmits all of it.
  double transmitted(const Instant& now) const { return now.command; }
  /// Whether the command of the present sample takes effect.
  bool transmits_command() const { return engaged_; }

  /// None: nothing changes between the samples.
  ModeGuards guards() const { return {}; }
  /// Takes a sample: the law decides on its Δz and Δż what holds up to the next one.
  void sample(const State& state) {
    engaged_ =
        law_.step(readings_.relative_displacement(state), readings_.relative_velocity(state));
    side_ = law_.side();
  }
  /// The force or the command has jumped: without effect on the contact.
  void jumped(const Instant&) {}
  /// The absorber was displaced against the conductor: the next sample will show it.
  void displaced() {}
  /// What the mode keeps of the state: nothing.
  void keep(const State&, State&) const {}
  /// Some time has passed: without effect.
  void flowed() {}
  /// Never called: there is no guard whose sign is not known.
  void learn_sign(double) {}
  /// Never called: there is no guard to come to zero.
  void reached(int, Instant&) {}

 private:
  Plant plant_;
  PortReadings<Plant> readings_;
  BacklashParameters backlash_;
  SampledContact law_;
  bool engaged_ = true;
  int side_ = 0;
};

/// That of the two masses.
using SampledLaw = SampledLawOf<TwoMass<double>>;

}  // namespace holdfast
