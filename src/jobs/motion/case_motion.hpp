#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "case/case.hpp"
#include "case/model/loop_of_case.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/motion/event_motion.hpp"
#include "holdfast/plant/port_readings.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "process/job_context.hpp"

namespace holdfast::program {

/// The motion of a case from its initial state, by whichever of the library's motions follows it:
/// the map of a sampling period where the case is of the paper's model, of two masses or of a
/// conductor by its modes, else the event-driven motion. What it shows are conductor and absorber
/// at their place: states are [z1, v1, z2, v2]. It is a motion as is_motion_v has it; the
/// library's own is compiled once, behind it, and a sample costs two calls more.
class CaseMotion {
 public:
  using State = Vector<double, 4>;  ///< [z1, v1, z2, v2] (m, m/s, m, m/s)

  /// Throws WrongInput, NoAnswer or InvalidParameter where there is no such motion.
  CaseMotion(const Case& the_case, const MotionChoice& choice);
  CaseMotion(const CaseMotion& other);
  CaseMotion& operator=(const CaseMotion&) = delete;
  ~CaseMotion();

  EventSample sense();
  void advance();
  void displace_conductor(double by);

  std::int64_t index() const;
  double time() const;
  State state() const;
  PortReadings<TwoMass<double>> readings() const { return {}; }

  /// What it has met with; nothing where the contact changes at samples alone.
  const SwitchCounts& counts() const;

 private:
  struct Model;
  template <class Motion>
  struct ModelOf;

  std::unique_ptr<Model> model_;
};

/// Where a motion has come to.
struct MotionEnd {
  double time;          ///< s
  double size;          ///< the largest number of its state, m and m/s
  SwitchCounts counts;  ///< what it has met with
};

/// @tparam Motion  CaseMotion or an EventMotion
template <class Motion>
MotionEnd end_of(const Motion& motion) {
  return {motion.time(), motion.state().cwiseAbs().maxCoeff(), motion.counts()};
}

/// At the end of a motion: throws NoAnswer where its changes of contact accumulate, so that it is
/// not to be trusted; warns where rounding decided some of them, and where the motion diverges, as
/// one within the range of numbers may too.
/// @param kick  displacement on its way, m
void tell_of_end(const JobContext& context, const MotionEnd& end, bool controlled = true,
                 double kick = 0.0);

}  // namespace holdfast::program
