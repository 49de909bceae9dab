// Explicit instantiations of stability/margins for double.

#include "holdfast/stability/margins/margins.hpp"
#include "holdfast/stability/margins/slow_sampling.hpp"
#include "holdfast/stability/margins/tracked_roots.hpp"

namespace holdfast {

template SlowSamplingBound::SlowSamplingBound(const TwoMass<double>&, const PdGains<double>&,
                                              double);
template StabilityMargins stability_margins(const TwoMass<double>&, const Sampling<double>&,
                                            const PdGains<double>&, const MarginSearch&);
template SlowSamplingBound::SlowSamplingBound(const LinearPlant<double>&, const PdGains<double>&,
                                              double);
template StabilityMargins stability_margins(const LinearPlant<double>&, const Sampling<double>&,
                                            const PdGains<double>&, const MarginSearch&);

}  // namespace holdfast

namespace holdfast::detail {

template TrackedPointSets tracked_roots(const SampledLoop<double>&, const LoopDerivative&,
                                        const PdGains<double>&, bool);
template TrackedPointSets tracked_roots(const LoopMap<double>&, const LoopMapDerivative<double>&,
                                        const PdGains<double>&, bool);
template double loop_excess(const LoopMap<double>&, const PdGains<double>&);

}  // namespace holdfast::detail
