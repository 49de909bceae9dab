// Explicit instantiations of math/poly and math/roots for double.

#include "holdfast/math/poly/polynomial.hpp"
#include "holdfast/math/roots/pole_sum_roots.hpp"

namespace holdfast {

template std::vector<std::complex<double>> roots(const Eigen::MatrixBase<Polynomial<double, 2>>&,
                                                 double);
template std::vector<std::complex<double>> roots(const Eigen::MatrixBase<Polynomial<double, 4>>&,
                                                 double);
template std::vector<std::complex<double>> roots(const Eigen::MatrixBase<Polynomial<double, 5>>&,
                                                 double);

template std::vector<std::complex<double>> pole_sum_roots(PoleSum<double>, bool);

}  // namespace holdfast
