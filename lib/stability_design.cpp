// Explicit instantiations of stability/design for double.

#include "holdfast/stability/design/delay_options.hpp"
#include "holdfast/stability/design/max_delay.hpp"
#include "holdfast/stability/design/minimax_amplitude.hpp"
#include "holdfast/stability/design/minimum_amplitude.hpp"
#include "holdfast/stability/design/minimum_radius.hpp"
#include "holdfast/stability/design/minimum_radius_gains.hpp"

namespace holdfast {

template std::vector<Interval<double>> feasible_differential_gains(const TwoDof<double>&,
                                                                   const MaxDelayQuestion&, double);
template std::optional<double> feasible_differential_gain(const TwoDof<double>&,
                                                          const MaxDelayQuestion&, double);
template MaxDelay max_sampling_period(const TwoDof<double>&, const MaxDelayQuestion&);
template LeastAmplitude least_amplitude(const TwoDof<double>&, const AmplitudeQuestion&, double,
                                        double);
template LeastWorstAmplitude least_worst_amplitude(const TwoDof<double>&, const AmplitudeQuestion&,
                                                   double, const FrequencyBand&);
template LeastRadius least_radius(const SampledLoop<double>&, double, double);
template LeastRadiusGains least_radius_gains(const SampledLoop<double>&);
template std::vector<Interval<double>> feasible_differential_gains(const LinearPlant<double>&,
                                                                   const MaxDelayQuestion&, double);
template std::optional<double> feasible_differential_gain(const LinearPlant<double>&,
                                                          const MaxDelayQuestion&, double);
template MaxDelay max_sampling_period(const LinearPlant<double>&, const MaxDelayQuestion&);
template LeastAmplitude least_amplitude(const LinearPlant<double>&, const AmplitudeQuestion&,
                                        double, double);
template LeastRadius least_radius(const LoopMap<double>&, double, double);

}  // namespace holdfast
