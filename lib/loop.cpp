// Explicit instantiations of plant and control for double.

#include "holdfast/control/loop_map.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/plant/free_decay.hpp"
#include "holdfast/plant/reduction.hpp"

namespace holdfast {

template DecayEvents free_decay_events(const TwoMass<double>&);
template ReductionResult reduce_to_frequencies(const FrequencyReduction<double>&);

template SampledLoop<double> sampled_loop(const TwoMass<double>&, const Sampling<double>&);
template LoopMap<double> loop_map(const TwoMass<double>&, const Sampling<double>&);
template LoopMap<double> loop_map(const LinearPlant<double>&, const Sampling<double>&);

}  // namespace holdfast
