#pragma once

#include <Eigen/Core>
#include <complex>

namespace holdfast::test {

/// Dense linear algebra of Eigen as the second route of many tests, in one size for all, so that
/// its decompositions, which take long to compile, are compiled once (dense_routes.cpp).

/// A matrix of long doubles, its order known at run time.
using LongMatrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

/// λ of A, in no order.
Eigen::VectorXcd eigenvalues_of(const Eigen::Ref<const Eigen::MatrixXd>& matrix);
Eigen::Matrix<std::complex<long double>, Eigen::Dynamic, 1> eigenvalues_of(
    const Eigen::Ref<const LongMatrix>& matrix);

/// |λ|, largest first.
Eigen::VectorXd moduli_of(const Eigen::Ref<const Eigen::MatrixXd>& matrix);

/// ln |λ|, largest first.
Eigen::VectorXd log_moduli_of(const Eigen::Ref<const Eigen::MatrixXd>& matrix);
Eigen::VectorXd log_moduli_of(const Eigen::Ref<const LongMatrix>& matrix);

/// The columns v of A v = λ v.
Eigen::MatrixXcd eigenvectors_of(const Eigen::Ref<const Eigen::MatrixXd>& matrix);

/// Largest first.
Eigen::VectorXd singular_values_of(const Eigen::Ref<const Eigen::MatrixXd>& matrix);

/// Q of A = Q R.
Eigen::MatrixXd orthogonal_factor_of(const Eigen::Ref<const Eigen::MatrixXd>& matrix);

/// x of A x = b.
Eigen::VectorXcd solution_of(const Eigen::Ref<const Eigen::MatrixXcd>& matrix,
                             const Eigen::Ref<const Eigen::VectorXcd>& right);

/// det A.
std::complex<long double> determinant_of(
    const Eigen::Ref<
        const Eigen::Matrix<std::complex<long double>, Eigen::Dynamic, Eigen::Dynamic>>& matrix);

}  // namespace holdfast::test
