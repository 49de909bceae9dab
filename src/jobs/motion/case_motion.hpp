#pragma once

#include <cstdint>
#include <variant>

#include "case/case.hpp"
#include "case/job_context.hpp"
#include "case/model/moving_loop.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/motion/event_motion.hpp"
#include "holdfast/plant/port_readings.hpp"
#include "holdfast/plant/two_mass.hpp"

namespace holdfast::program {

/// The motion of a case from its initial state, by whichever of the library's motions follows it.
/// Its states are [z1, v1, z2, v2], of conductor and absorber at their place. It is a motion as
/// is_motion_v has it; the library's own are compiled once, behind it.
class CaseMotion {
 public:
  using State = Vector<double, 4>;  ///< [z1, v1, z2, v2] (m, m/s, m, m/s)

  explicit CaseMotion(const MovingLoop& moving);
  /// Throws WrongInput, NoAnswer or InvalidParameter where there is no such motion.
  CaseMotion(const Case& the_case, const MotionChoice& choice);

  EventSample sense();
  void advance();
  void displace_conductor(double by);

  std::int64_t index() const;
  double time() const;
  State state() const;
  PortReadings<TwoMass<double>> readings() const { return {}; }

  /// Contact changes that it has met with; none where the contact changes at samples alone.
  const SwitchCounts& counts() const;

 private:
  std::variant<SampledMotion<double>, EventMotion<>, ModalMotion,
               EventMotion<DriveContact<ControlledPlant>>>
      motion_;
};

/// Where a motion has come to.
struct ReachedState {
  double time;          ///< s
  double size;          ///< the largest number of its state, m and m/s
  SwitchCounts counts;  ///< what it has met with
};

/// @tparam Motion  CaseMotion or an EventMotion
template <class Motion>
ReachedState end_of(const Motion& motion) {
  return {motion.time(), motion.state().cwiseAbs().maxCoeff(), motion.counts()};
}

/// At the end of a motion: throws NoAnswer where its changes of contact accumulate, so that it is
/// not to be trusted; warns where rounding decided some of them, and where the motion diverges, as
/// one within the range of numbers may too.
/// @param kick  displacement on its way, m
void tell_of_end(const JobContext& context, const ReachedState& end, bool controlled = true,
                 double kick = 0.0);

}  // namespace holdfast::program
