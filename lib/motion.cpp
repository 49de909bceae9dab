// Explicit instantiations of motion for double.
#include <vector>

#include "holdfast/contact/contact.hpp"
#include "holdfast/motion/forced_loop.hpp"
#include "holdfast/motion/subinterval_step.hpp"
#include "holdfast/motion/variational_flow.hpp"

namespace holdfast {

template SegmentStepOf<4>::SegmentStepOf(const AffineDynamicsOf<4>&, const std::vector<Harmonic>&,
                                         double, double);
template HeldStep<double, 4, 1> HybridTangent<DriveContact<>>::exponential(int, double) const;
template HarmonicallyForcedMotion<double> harmonically_forced_motion(
    const ForcedLoop<double>&, const StateOf<TwoDof<double>>&);
template PeriodicallyForcedMotion<double> periodically_forced_motion(
    const ForcedLoop<double>&, const Rational&, const StateOf<TwoDof<double>>&);

}  // namespace holdfast
