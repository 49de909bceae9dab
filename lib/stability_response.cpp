// Explicit instantiations of stability/response for double.

#include "holdfast/stability/response/loop_response.hpp"
#include "holdfast/stability/response/modal_damping.hpp"
#include "holdfast/stability/response/modal_response.hpp"
#include "holdfast/stability/response/modal_steady_response.hpp"
#include "holdfast/stability/response/response.hpp"

namespace holdfast {

template class SteadyResponse<double>;
template class LoopResponse<double>;
template class ModalResponse<double>;
template ModalResponse<double>::ModalResponse(const LinearPlant<double>&, const Sampling<double>&);
template SteadyResponse<double> steady_response(const TwoMass<double>&, const Sampling<double>&,
                                                ForceHold, double);
template SteadyResponse<double> steady_response(const LinearPlant<double>&, const Sampling<double>&,
                                                ForceHold, double);
template ModalResponse<double> modal_response<double>(const ConductorWithAbsorber&,
                                                      const Sampling<double>&);
template ModalResponse<double> modal_response<double>(const std::vector<PlantPole>&,
                                                      const Sampling<double>&);
template SteadyResponse<double> steady_response<double>(const ConductorWithAbsorber&,
                                                        const Sampling<double>&, ForceHold, double);
template std::vector<ModeDamping> modal_damping<double>(const std::vector<PlaceMode<double>>&,
                                                        const Absorber<double>&,
                                                        const Sampling<double>&,
                                                        const PdGains<double>&,
                                                        const LoopHardware&);

}  // namespace holdfast
