// Explicit instantiations of stability/margins for double.

#include "holdfast/stability/margins/map_family.hpp"
#include "holdfast/stability/margins/margins.hpp"
#include "holdfast/stability/margins/sampling_family.hpp"
#include "holdfast/stability/margins/slow_sampling.hpp"

namespace holdfast {

template class SamplingFamily<TwoMass<double>>;
template SlowSamplingBound::SlowSamplingBound(const TwoMass<double>&, const PdGains<double>&,
                                              double);
template StabilityMargins stability_margins(const TwoMass<double>&, const Sampling<double>&,
                                            const PdGains<double>&, const MarginSearch&);
template class MapFamily<LinearPlant<double>>;
template SlowSamplingBound::SlowSamplingBound(const LinearPlant<double>&, const PdGains<double>&,
                                              double);
template StabilityMargins stability_margins(const LinearPlant<double>&, const Sampling<double>&,
                                            const PdGains<double>&, const MarginSearch&);

}  // namespace holdfast

namespace holdfast::detail {

template TrackedPointSets tracked_roots(const LoopMap<double>&, const LoopMapDerivative<double>&,
                                        const PdGains<double>&, bool);
template double loop_excess(const LoopMap<double>&, const PdGains<double>&);

}  // namespace holdfast::detail
