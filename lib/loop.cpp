// Explicit instantiations of control for double.

#include "holdfast/control/loop_map.hpp"
#include "holdfast/control/sampled_loop.hpp"

namespace holdfast {

template SampledLoop<double> sampled_loop(const TwoMass<double>&, const Sampling<double>&);
template LoopMap<double> loop_map(const TwoMass<double>&, const Sampling<double>&);
template LoopMap<double> loop_map(const LinearPlant<double>&, const Sampling<double>&);

}  // namespace holdfast
