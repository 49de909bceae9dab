// Explicit instantiations of motion for double.
#include <vector>

#include "holdfast/contact/contact.hpp"
#include "holdfast/motion/ideal_loop.hpp"
#include "holdfast/motion/implemented_loop.hpp"
#include "holdfast/motion/next_event.hpp"
#include "holdfast/motion/subinterval_step.hpp"
#include "holdfast/motion/variational_flow.hpp"

namespace holdfast {

template SubintervalStep<4>::SubintervalStep(const AffineDynamicsOf<4>&,
                                             const std::vector<Harmonic>&, double, double);
template SubintervalStep<Eigen::Dynamic>::SubintervalStep(const AffineDynamicsOf<Eigen::Dynamic>&,
                                                          const std::vector<Harmonic>&, double,
                                                          double);
template NextEvent<4> next_event(const AffineDynamicsOf<4>&, const GuardsOf<4>&,
                                 const ModeStretch<4>&);
template NextEvent<Eigen::Dynamic> next_event(const AffineDynamicsOf<Eigen::Dynamic>&,
                                              const GuardsOf<Eigen::Dynamic>&,
                                              const ModeStretch<Eigen::Dynamic>&);
template HeldStep<double, 4, 1> VariationalFlow<DriveContact<>>::exponential(int, double) const;
template EventMotion<DriveContact<>> event_motion(const ImplementedLoop&,
                                                  const StateOf<TwoMass<double>>&);
template EventMotion<DriveContact<ControlledPlant>> event_motion(
    const ImplementedLoopOf<ControlledPlant>&, const StateOf<ControlledPlant>&);
template HarmonicallyForcedMotion<double> harmonically_forced_motion(
    const IdealLoop<double>&, const StateOf<TwoMass<double>>&);
template PeriodicallyForcedMotion<double> periodically_forced_motion(
    const IdealLoop<double>&, const Rational&, const StateOf<TwoMass<double>>&);

}  // namespace holdfast
