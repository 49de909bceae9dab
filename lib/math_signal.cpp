// Explicit instantiations of math/signal for double.

#include "holdfast/math/signal/spectrum.hpp"

namespace holdfast {

template std::vector<SpectralLine> amplitude_spectrum(std::vector<double>, double, SpectralWindow);

}  // namespace holdfast
