// Explicit instantiations of stability/margins for double.

#include "holdfast/stability/margins/margins.hpp"
#include "holdfast/stability/margins/sampling_family.hpp"
#include "holdfast/stability/margins/slow_sampling.hpp"

namespace holdfast {

template class SamplingPath<TwoDof<double>>;
template SlowSamplingBound::SlowSamplingBound(const TwoDof<double>&, const PdGains<double>&,
                                              double);
template StabilityMargins stability_margins(const TwoDof<double>&, const Sampling<double>&,
                                            const PdGains<double>&, const MarginSearch&);

}  // namespace holdfast
