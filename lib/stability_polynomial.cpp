// Explicit instantiations of stability/polynomial for double.

#include "holdfast/stability/polynomial/characteristic_polynomial.hpp"
#include "holdfast/stability/polynomial/loop_polynomial.hpp"

namespace holdfast {

template AffinePolynomial<double, 4> characteristic_polynomial(const TwoMass<double>&);
template AffinePolynomial<double, 5> characteristic_polynomial(const SampledLoop<double>&);
template struct LoopPolynomial<double>;
template LoopPolynomial<double> loop_polynomial(const SampledLoop<double>&);

}  // namespace holdfast
