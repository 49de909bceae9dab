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

/// Motion of a case from its initial state, for any of the four models of MovingLoop. States are
/// [z1, v1, z2, v2] of conductor and absorber at the absorber's position. Satisfies is_motion_v;
/// templates over motions need be compiled for this class alone.
class CaseMotion {
 public:
  using State = Vector<double, 4>;  ///< [z1, v1, z2, v2] (m, m/s, m, m/s)

  explicit CaseMotion(const MovingLoop& moving);
  /// Begins the motion. Throws WrongInput, NoAnswer or InvalidParameter if the case has none.
  CaseMotion(const Case& the_case, const MotionChoice& choice);

  EventSample sense();
  void advance();
  void displace_conductor(double by);

  std::int64_t index() const;
  double time() const;
  State state() const;
  PortReadings<TwoMass<double>> readings() const { return {}; }

  /// Contact changes so far; all 0 where the contact changes only at samples.
  const SwitchCounts& counts() const;

 private:
  std::variant<SampledMotion<double>, EventMotion<>, ModalMotion,
               EventMotion<DriveContact<ControlledPlant>>>
      motion_;
};

/// Time, size and contact changes at the end of a motion.
struct ReachedState {
  double time;          ///< time (s)
  double size;          ///< largest |component| of the state (m or m/s)
  SwitchCounts counts;  ///< contact changes of the motion
};

/// Time, size and contact changes so far. @tparam Motion  CaseMotion or an EventMotion
template <class Motion>
ReachedState end_of(const Motion& motion) {
  return {motion.time(), motion.state().cwiseAbs().maxCoeff(), motion.counts()};
}

/// Reports doubts about a finished motion. Throws NoAnswer where too many contact changes within a
/// sampling period ended it. Warns where rounding errors decided contact changes, and where the
/// motion diverges, even without overflow.
/// @param kick  displacement imposed during the motion, m
void tell_of_end(const JobContext& context, const ReachedState& end, bool controlled = true,
                 double kick = 0.0);

}  // namespace holdfast::program
