// Explicit instantiations of stability/response for double.

#include "holdfast/stability/response/amplitude_band.hpp"
#include "holdfast/stability/response/any_order_response.hpp"
#include "holdfast/stability/response/loop_response.hpp"
#include "holdfast/stability/response/response.hpp"
#include "holdfast/stability/response/response_derivatives.hpp"

namespace holdfast {

template class SteadyResponse<double>;
template class AmplitudeBand<TwoDof<double>>;
template class BasicResponseRates<double>;
template HarmonicInput<double> input_rate_by_period(const TwoDof<double>&,
                                                    const SampledLoop<double>&, ForceHold,
                                                    const HarmonicInput<double>&, const double&);
template HarmonicInput<double> exact_input_rate_by_plant(const TwoDof<double>&, const PlantRate&,
                                                         const double&, const double&);
template class LoopResponse<double>;
template class AnyOrderResponse<double>;
template SteadyResponse<double> steady_response(const TwoDof<double>&, const Sampling<double>&,
                                                ForceHold, double);
template SteadyResponse<double> steady_response(const LinearPlant<double>&, const Sampling<double>&,
                                                ForceHold, double);

}  // namespace holdfast
