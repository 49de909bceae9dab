// Explicit instantiations of math/poly and math/signal for double.

#include "holdfast/math/poly/polynomial.hpp"
#include "holdfast/math/signal/spectrum.hpp"

namespace holdfast {

template std::vector<std::complex<double>> roots(const Eigen::MatrixBase<Polynomial<double, 2>>&,
                                                 double);
template std::vector<std::complex<double>> roots(const Eigen::MatrixBase<Polynomial<double, 4>>&,
                                                 double);
template std::vector<std::complex<double>> roots(const Eigen::MatrixBase<Polynomial<double, 5>>&,
                                                 double);

template std::vector<SpectralLine> amplitude_spectrum(std::vector<double>, double, SpectralWindow);

}  // namespace holdfast
