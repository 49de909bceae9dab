// Explicit instantiations of stability/margins for double.

#include "holdfast/stability/margins/margins.hpp"
#include "holdfast/stability/margins/sampling_family.hpp"
#include "holdfast/stability/margins/sampling_proof.hpp"

namespace holdfast {

template class SamplingProof<double>;

template StabilityMargins stability_margins(const TwoMass<double>&, const Sampling<double>&,
                                            const PdGains<double>&, const MarginSearch&);
template StabilityMargins stability_margins(const LinearPlant<double>&, const Sampling<double>&,
                                            const PdGains<double>&, const MarginSearch&);
template LoopMargins loop_margins(const TwoMass<double>&, const Sampling<double>&,
                                  const PdGains<double>&, const MarginSearch&);

}  // namespace holdfast

namespace holdfast::detail {

template double loop_excess(const LoopMap<double>&, const PdGains<double>&);

}  // namespace holdfast::detail
