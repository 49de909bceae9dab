// Explicit instantiations of cable for double.

#include "holdfast/cable.hpp"

namespace holdfast {

template class HangingCable<double>;
template class CatenaryPointLoad<double>;
template class BasicBarChain<double>;
template ChainEquilibrium chain_equilibrium(const BarChain&, double);
template class BasicCableElements<double>;

}  // namespace holdfast
