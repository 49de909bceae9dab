#pragma once

#include "holdfast/backlash/contact_law.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/motion/affine_expansion.hpp"
#include "holdfast/motion/contact_guard.hpp"
#include "holdfast/motion/contact_mode.hpp"
#include "holdfast/motion/exact_dead_zone.hpp"
#include "holdfast/plant/two_dof.hpp"

namespace holdfast {

/// A drive that enters and leaves its backlash at samples alone, by any law: the contact of a
/// HybridMotion that does not change between the samples.
///
/// Where the law says that the force is not transmitted the computer's command of that sample is
/// without effect, as in SampledMotion: u_j = 0 from t_j + δ on. The stops of a dead zone touch
/// from the sample on.
class SampledContactMotion {
 public:
  static constexpr int modes = 3;  // on the lower stop, between the stops, on the upper one

  /// @throws InvalidParameter where the law's parameters are not admissible
  SampledContactMotion(const TwoDof<double>& plant, const BacklashParameters& backlash)
      : plant_(plant), backlash_(backlash), law_(backlash) {}

  AffineDynamics dynamics(int mode) const {
    const int side = mode - 1;
    if (side != 0)
      return dynamics_on_stop(plant_, backlash_.contact_stiffness, backlash_.contact_damping,
                              0.5 * side * backlash_.width);
    return {plant_.state_matrix(), plant_.control_input(), plant_.excitation_input()};
  }
  TwoDof<double> plant(int mode) const {
    return mode == 1
               ? plant_
               : plant_on_stop(plant_, backlash_.contact_stiffness, backlash_.contact_damping);
  }

  int mode() const { return side_ + 1; }
  ContactMode word() const { return engaged_ ? ContactMode::engaged : ContactMode::gap; }
  double commanded(double command) const { return engaged_ ? command : 0.0; }
  double transmitted(const ContactInstant& now) const { return now.command; }
  /// Whether the command of the present sample takes effect.
  bool transmits_command() const { return engaged_; }

  Guards guards() const { return {}; }
  void sample(const Vector<double, 4>& state) {
    engaged_ = law_.step(relative_displacement(state), relative_velocity(state));
    side_ = law_.side();
  }
  void jumped(const ContactInstant&) {}
  void displaced() {}
  void keep(const Vector<double, 4>&, Vector<double, 4>&) const {}
  void flowed() {}
  void learn_sign(double) {}
  void reached(int, ContactInstant&) {}

 private:
  TwoDof<double> plant_;
  BacklashParameters backlash_;
  SampledContact law_;
  bool engaged_ = true;
  int side_ = 0;
};

}  // namespace holdfast
