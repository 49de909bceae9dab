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

}  // namespace holdfast::program
