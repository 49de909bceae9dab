// Explicit instantiations of math/linalg for double.
#include "holdfast/math/linalg/eigenvalue_derivative.hpp"
#include "holdfast/math/linalg/eigenvalues.hpp"
#include "holdfast/math/linalg/exponential.hpp"
#include "holdfast/math/linalg/multipliers.hpp"

namespace holdfast {

template Vector<std::complex<double>, 4> eigenvalues(const Matrix<double, 4>&);
template Vector<std::complex<double>, 5> eigenvalues(const Matrix<double, 5>&);
template Vector<std::complex<double>, Eigen::Dynamic> eigenvalues(
    const Matrix<double, Eigen::Dynamic>&);
template std::complex<double> eigenvalue_derivative(const Matrix<double, Eigen::Dynamic>&,
                                                    const Matrix<double, Eigen::Dynamic>&,
                                                    const std::complex<double>&);

template std::vector<Multiplier> multipliers_of_product(const std::vector<Matrix<double, 5>>&);
template std::vector<Multiplier> multipliers_of_product(const std::vector<Eigen::MatrixXd>&);

}  // namespace holdfast

namespace holdfast::detail {

template Matrix<double, 5> balanced_exponential(const Matrix<double, 5>&);
template Matrix<double, 6> balanced_exponential(const Matrix<double, 6>&);

}  // namespace holdfast::detail
