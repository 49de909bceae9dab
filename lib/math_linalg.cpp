// Explicit instantiations of math/linalg for double.
#include "holdfast/math/linalg/eigenbasis.hpp"
#include "holdfast/math/linalg/eigenvalues.hpp"
#include "holdfast/math/linalg/exponential.hpp"
#include "holdfast/math/linalg/moving_spectrum.hpp"
#include "holdfast/math/linalg/multipliers.hpp"

namespace holdfast {

template class EigenBasis<double>;
template class MovingSpectrum<double>;
template Vector<std::complex<double>, 4> eigenvalues(const Matrix<double, 4>&);
template Vector<std::complex<double>, 5> eigenvalues(const Matrix<double, 5>&);
template Vector<std::complex<double>, Eigen::Dynamic> eigenvalues(
    const Matrix<double, Eigen::Dynamic>&);

template Matrix<double, 5> exponential(const Matrix<double, 5>&);
template Matrix<double, 6> exponential(const Matrix<double, 6>&);
template Matrix<double, 8> exponential(const Matrix<double, 8>&);
template std::vector<Multiplier> multipliers_of_product(const std::vector<Matrix<double, 5>>&);
template std::vector<Multiplier> multipliers_of_product(const std::vector<Eigen::MatrixXd>&);
template std::vector<Multiplier> detail::multipliers_of_turn(
    const Eigen::MatrixXd&, const detail::ScaledTriangle<double, Eigen::Dynamic>&);

}  // namespace holdfast
