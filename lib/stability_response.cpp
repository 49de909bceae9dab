// Explicit instantiations of stability/response for double.

#include "holdfast/stability/response/amplitude_band.hpp"
#include "holdfast/stability/response/any_order_response.hpp"
#include "holdfast/stability/response/loop_response.hpp"
#include "holdfast/stability/response/response.hpp"
#include "holdfast/stability/response/response_derivatives.hpp"

namespace holdfast {

template class SteadyResponse<double>;
template class AmplitudeBand<TwoMass<double>>;
template class BasicResponseDerivatives<double>;
template HarmonicInput<double> input_derivative_by_period(const TwoMass<double>&,
                                                          const SampledLoop<double>&, ForceHold,
                                                          const HarmonicInput<double>&,
                                                          const double&);
template HarmonicInput<double> exact_input_derivative_by_plant(const TwoMass<double>&,
                                                               const PlantDerivative&,
                                                               const double&, const double&);
template class LoopResponse<double>;
template class AnyOrderResponse<double>;
template SteadyResponse<double> steady_response(const TwoMass<double>&, const Sampling<double>&,
                                                ForceHold, double);
template SteadyResponse<double> steady_response(const LinearPlant<double>&, const Sampling<double>&,
                                                ForceHold, double);

}  // namespace holdfast
