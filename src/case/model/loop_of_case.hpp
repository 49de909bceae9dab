#pragma once

#include "case/case.hpp"
#include "case/model/plant_of_case.hpp"
#include "holdfast/motion/ideal_loop.hpp"
#include "holdfast/motion/implemented_loop.hpp"
#include "holdfast/motion/sampled_motion.hpp"

namespace holdfast::program {

/// All that a motion depends on beside its initial state.
IdealLoop<double> ideal_loop_of(const Case& the_case);

/// The loop with P = D = 0 and a drive without backlash.
IdealLoop<double> uncontrolled(IdealLoop<double> loop);

/// Whether the motion is one of the paper's model, which IdealLoop describes: switching at
/// samples, the paper's backlash or none, one harmonic, an ideal computer.
bool is_of_the_paper(const Case& the_case, Switching switching);

/// The motion of the paper's model from the case's initial state.
SampledMotion<double> motion_of(const Case& the_case);

/// The loop with all that the case says of it.
ImplementedLoop implemented_loop_of(const Case& the_case, Switching switching);

/// The loop with P = D = 0 and a drive without backlash.
ImplementedLoop uncontrolled(ImplementedLoop loop);

/// Calls `visit` with the loop: in the paper's model where that is all there is to the case, else
/// with all that the case says of it.
template <class Visit>
auto with_loop_of(const Case& the_case, Switching switching, const Visit& visit) {
  if (is_of_the_paper(the_case, switching)) return visit(ideal_loop_of(the_case));
  return visit(implemented_loop_of(the_case, switching));
}

}  // namespace holdfast::program
