// Explicit instantiations of plant for double.

#include "holdfast/plant/free_decay.hpp"
#include "holdfast/plant/reduction.hpp"

namespace holdfast {

template DecayEvents free_decay_events(const TwoMass<double>&);
template ReductionResult reduce_to_frequencies(const FrequencyReduction<double>&);

}  // namespace holdfast
