#pragma once

#include "holdfast/contact/contact_guard.hpp"
#include "holdfast/contact/contact_law.hpp"
#include "holdfast/contact/contact_mode.hpp"
#include "holdfast/contact/exact_dead_zone.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/plant/affine_dynamics.hpp"
#include "holdfast/plant/two_mass.hpp"

namespace holdfast {

/// A drive that enters and leaves its backlash at samples alone, by any law: the contact of a
/// HybridMotion that does not change between the samples.
///
/// Where the law says that the force is not transmitted the computer's command of that sample is
/// without effect, as in SampledMotion: u_j = 0 from t_j + δ on. The stops of a dead zone touch
/// from the sample on.
class SampledContactMotion {
 public:
  static constexpr int modes = 3;  ///< on the lower stop, between the stops, on the upper one

  /// @throws InvalidParameter where the law's parameters are not admissible
  SampledContactMotion(const TwoDof<double>& plant, const BacklashParameters& backlash)
      : plant_(plant), backlash_(backlash), law_(backlash) {}

  /// How the state moves in one of the modes. The command is in force in all of them: it is
  /// `commanded` that leaves out what is not transmitted.
  AffineDynamics dynamics(int mode) const {
    const int side = mode - 1;
    if (side != 0)
      return dynamics_on_stop(plant_, backlash_.contact_stiffness, backlash_.contact_damping,
                              0.5 * side * backlash_.width);
    return {plant_.state_matrix(), plant_.control_input(), plant_.excitation_input()};
  }
  /// The plant whose energy bounds the motion in one of the modes; on a stop that is part of it.
  TwoDof<double> plant(int mode) const {
    return mode == 1
               ? plant_
               : plant_on_stop(plant_, backlash_.contact_stiffness, backlash_.contact_damping);
  }

  /// Number of the present mode, 0 … `modes` − 1; always 1 but for a dead zone.
  int mode() const { return side_ + 1; }
  /// `engaged` before the first sample and where the last one found the force transmitted, else
  /// `gap`.
  ContactMode word() const { return engaged_ ? ContactMode::engaged : ContactMode::gap; }
  /// u_j (N) of a sample's command: that command, or 0 where the law does not transmit.
  double commanded(double command) const { return engaged_ ? command : 0.0; }
  /// What the drive transmits (N): all of u, which `commanded` has decided already.
  double transmitted(const ContactInstant& now) const { return now.command; }
  /// Whether the command of the present sample takes effect.
  bool transmits_command() const { return engaged_; }

  /// None: nothing changes between the samples.
  Guards guards() const { return {}; }
  /// Takes a sample: the law decides on its Δz and Δż what holds up to the next one.
  void sample(const Vector<double, 4>& state) {
    engaged_ = law_.step(relative_displacement(state), relative_velocity(state));
    side_ = law_.side();
  }
  /// The force or the command has jumped: without effect on the contact.
  void jumped(const ContactInstant&) {}
  /// The absorber was displaced against the conductor: the next sample will show it.
  void displaced() {}
  /// What the mode keeps of the state: nothing.
  void keep(const Vector<double, 4>&, Vector<double, 4>&) const {}
  /// Some time has passed: without effect.
  void flowed() {}
  /// Never called: there is no guard whose sign is not known.
  void learn_sign(double) {}
  /// Never called: there is no guard to come to zero.
  void reached(int, ContactInstant&) {}

 private:
  TwoDof<double> plant_;
  BacklashParameters backlash_;
  SampledContact law_;
  bool engaged_ = true;
  int side_ = 0;
};

}  // namespace holdfast
