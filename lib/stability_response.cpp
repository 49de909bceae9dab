// Explicit instantiations of stability/response for double.

#include "holdfast/stability/response/loop_response.hpp"
#include "holdfast/stability/response/modal_response.hpp"
#include "holdfast/stability/response/moving_response.hpp"
#include "holdfast/stability/response/response.hpp"

namespace holdfast {

template class SteadyResponse<double>;
template class MovingResponse<SampledLoop<double>>;
template class MovingResponse<LoopMap<double>>;
template class LoopResponse<double>;
template class ModalResponse<double>;
template ModalResponse<double>::ModalResponse(const LinearPlant<double>&, const Sampling<double>&);
template SteadyResponse<double> steady_response(const TwoMass<double>&, const Sampling<double>&,
                                                ForceHold, double);
template SteadyResponse<double> steady_response(const LinearPlant<double>&, const Sampling<double>&,
                                                ForceHold, double);

}  // namespace holdfast
