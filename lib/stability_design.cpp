// Explicit instantiations of stability/design for double.

#include "holdfast/stability/design/max_delay.hpp"
#include "holdfast/stability/design/minimax_amplitude.hpp"
#include "holdfast/stability/design/minimum_amplitude.hpp"
#include "holdfast/stability/design/minimum_amplitude_gains.hpp"
#include "holdfast/stability/design/minimum_radius.hpp"
#include "holdfast/stability/design/modal_design.hpp"

namespace holdfast {

template MaxDelay max_sampling_period(const TwoMass<double>&, const MaxDelayOptions&);
template MinimumAmplitude minimum_amplitude(const TwoMass<double>&, const AmplitudeOptions&, double,
                                            double);
template MinimaxAmplitude minimax_amplitude(const TwoMass<double>&, const AmplitudeOptions&, double,
                                            const FrequencyBand&);
template MinimumRadius minimum_radius(const SampledLoop<double>&, double, double);
template MaxDelay max_sampling_period(const LinearPlant<double>&, const MaxDelayOptions&);
template MinimumAmplitude minimum_amplitude(const LinearPlant<double>&, const AmplitudeOptions&,
                                            double, double);
template MinimumRadius minimum_radius(const LoopMap<double>&, double, double);
template MinimumRadius minimum_radius(const ModalResponse<double>&, double, double);
template MinimumAmplitude minimum_amplitude(const ModalResponse<double>&, const AmplitudeOptions&,
                                            double, double, const SteadyResponse<double>&);
template MinimumAmplitudeGains minimum_amplitude_gains(const ModalResponse<double>&,
                                                       const AmplitudeOptions&, double,
                                                       Interval<double>,
                                                       const SteadyResponse<double>&);
template MinimaxAmplitude modal_minimax_amplitude<double>(const ConductorWithAbsorber&,
                                                          const AmplitudeOptions&, double,
                                                          const FrequencyBand&);
template MaxDelay modal_max_sampling_period<double>(const ConductorWithAbsorber&,
                                                    const MaxDelayOptions&, double, SharedCircles*);

}  // namespace holdfast
