// Explicit instantiations of cable for double.

#include "holdfast/cable.hpp"

namespace holdfast {

template class HangingCable<double>;
template class CatenaryPointLoad<double>;
template class StaticsFromRest<CatenaryPointLoad<double>>;
template StaticsFromRest<CatenaryPointLoad<double>> exact_statics(const Conductor<double>&, double,
                                                                  double);
template class BasicBarChain<double>;
template ChainEquilibrium chain_equilibrium(const BarChain&, double);
template ElementsModes elements_modes(const Conductor<double>&, int, int);
template class BasicCableElements<double>;
template CablePlaceModes cable_place_modes(const BarChain&, const HungMass&, int, BarMass);

}  // namespace holdfast
