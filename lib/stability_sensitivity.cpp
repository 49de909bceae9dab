// Explicit instantiations of stability/sensitivity for double.

#include "holdfast/stability/sensitivity/amplitude_sensitivity.hpp"
#include "holdfast/stability/sensitivity/max_delay_sensitivity.hpp"
#include "holdfast/stability/sensitivity/minimum_radius_sensitivity.hpp"
#include "holdfast/stability/sensitivity/sensitivity.hpp"

namespace holdfast {

template LoopSensitivity boundary_gain_sensitivity(const TwoMass<double>&, const Sampling<double>&,
                                                   const PdGains<double>&, FreeGain, double);
template LoopSensitivity radius_sensitivity(const TwoMass<double>&, const Sampling<double>&,
                                            const PdGains<double>&);
template MinimumRadiusSensitivity minimum_radius_sensitivity(const TwoMass<double>&,
                                                             const Sampling<double>&,
                                                             const PdGains<double>&);
template AmplitudeSensitivity amplitude_sensitivity(const TwoMass<double>&, const AmplitudeOptions&,
                                                    double, double);
template MaxDelaySensitivity max_delay_sensitivity(const TwoMass<double>&, const MaxDelayOptions&,
                                                   const MaxDelay&);

}  // namespace holdfast
