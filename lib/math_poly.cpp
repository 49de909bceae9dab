// Explicit instantiations of math/poly for double.

#include "holdfast/math/poly/polynomial.hpp"

namespace holdfast {

template std::vector<std::complex<double>> roots(const Eigen::MatrixBase<Polynomial<double, 2>>&,
                                                 double);
template std::vector<std::complex<double>> roots(const Eigen::MatrixBase<Polynomial<double, 4>>&,
                                                 double);
template std::vector<std::complex<double>> roots(const Eigen::MatrixBase<Polynomial<double, 5>>&,
                                                 double);

}  // namespace holdfast
