#include "support/dense_routes.hpp"

#include "support/testing.hpp"

namespace holdfast::test {
namespace {

template <class Values>
Eigen::VectorXd largest_first(const Values& values) {
  Eigen::VectorXd sorted = values.template cast<double>();
  std::sort(sorted.begin(), sorted.end(), std::greater<>());
  return sorted;
}

}  // namespace

Eigen::VectorXcd eigenvalues_of(const Eigen::Ref<const Eigen::MatrixXd>& matrix) {
  return Eigen::EigenSolver<Eigen::MatrixXd>(matrix, false).eigenvalues();
}

Eigen::Matrix<std::complex<long double>, Eigen::Dynamic, 1> eigenvalues_of(
    const Eigen::Ref<const LongMatrix>& matrix) {
  return Eigen::EigenSolver<LongMatrix>(matrix, false).eigenvalues();
}

Eigen::VectorXd moduli_of(const Eigen::Ref<const Eigen::MatrixXd>& matrix) {
  return largest_first(eigenvalues_of(matrix).cwiseAbs());
}

Eigen::VectorXd log_moduli_of(const Eigen::Ref<const Eigen::MatrixXd>& matrix) {
  return largest_first(eigenvalues_of(matrix).cwiseAbs().array().log());
}

Eigen::VectorXd log_moduli_of(const Eigen::Ref<const LongMatrix>& matrix) {
  return largest_first(eigenvalues_of(matrix).cwiseAbs().array().log());
}

Eigen::MatrixXcd eigenvectors_of(const Eigen::Ref<const Eigen::MatrixXd>& matrix) {
  return Eigen::EigenSolver<Eigen::MatrixXd>(matrix).eigenvectors();
}

Eigen::VectorXd singular_values_of(const Eigen::Ref<const Eigen::MatrixXd>& matrix) {
  return Eigen::JacobiSVD<Eigen::MatrixXd>(matrix).singularValues();
}

Eigen::MatrixXd orthogonal_factor_of(const Eigen::Ref<const Eigen::MatrixXd>& matrix) {
  return Eigen::HouseholderQR<Eigen::MatrixXd>(matrix).householderQ();
}

Eigen::VectorXcd solution_of(const Eigen::Ref<const Eigen::MatrixXcd>& matrix,
                             const Eigen::Ref<const Eigen::VectorXcd>& right) {
  return matrix.fullPivLu().solve(right);
}

std::complex<long double> determinant_of(
    const Eigen::Ref<
        const Eigen::Matrix<std::complex<long double>, Eigen::Dynamic, Eigen::Dynamic>>& matrix) {
  return matrix.fullPivLu().determinant();
}

}  // namespace holdfast::test
