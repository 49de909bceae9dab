#pragma once

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <utility>

#include "holdfast/core/types.hpp"
#include "holdfast/math/linalg/balancing.hpp"
#include "holdfast/math/linalg/reflections.hpp"

namespace holdfast {

namespace detail {

/// The Schur form M = U T U* with T upper triangular and U unitary. It is computed from the real
/// Schur form, whose 2 × 2 diagonal blocks are made triangular by rotations.
template <class Scalar>
struct TriangularForm {
  using Complex = std::complex<Scalar>;
  using Square = Matrix<Scalar, Eigen::Dynamic>;

  Matrix<Complex, Eigen::Dynamic> triangle;  ///< triangular matrix T
  Matrix<Complex, Eigen::Dynamic> basis;     ///< unitary matrix U
  bool converged;                            ///< whether the QR algorithm converged

  /// @param matrix  matrix M, n × n, finite
  /// @param scale   divisor: the QR algorithm runs on matrix/scale
  explicit TriangularForm(const Square& matrix, const Scalar& scale = Scalar(1)) {
    const HessenbergForm<Square> hessenberg(matrix / scale);
    Eigen::RealSchur<Square> schur(matrix.rows());
    schur.computeFromHessenberg(hessenberg.form, hessenberg.basis, true);
    converged = schur.info() == Eigen::Success;
    triangle = (schur.matrixT() * scale).template cast<Complex>();
    basis = schur.matrixU().template cast<Complex>();
    make_triangular();
  }

 private:
  /// Rotates each 2 × 2 block of the real Schur form into a triangle by a unitary rotation.
  void make_triangular() {
    const Eigen::Index n = triangle.rows();
    for (Eigen::Index m = n - 1; m > 0; --m) {
      if (triangle(m, m - 1) == Complex(0)) continue;
      const Complex half = (triangle(m - 1, m - 1) - triangle(m, m)) / Scalar(2);
      const Complex root = std::sqrt(half * half + triangle(m - 1, m) * triangle(m, m - 1));
      const Complex away = half + root;  // eigenvalue minus the lower diagonal entry
      const Scalar length = std::sqrt(std::norm(away) + std::norm(triangle(m, m - 1)));
      const Complex c = away / length, s = triangle(m, m - 1) / length;
      const auto turn = [&c, &s](auto&& upper, auto&& lower) {
        const auto before = upper.eval();
        upper = std::conj(c) * before + std::conj(s) * lower;
        lower = c * lower - s * before;
      };
      turn(triangle.row(m - 1).tail(n - m + 1), triangle.row(m).tail(n - m + 1));
      const auto turn_columns = [&c, &s](auto&& left, auto&& right) {
        const auto before = left.eval();
        left = c * before + s * right;
        right = std::conj(c) * right - std::conj(s) * before;
      };
      turn_columns(triangle.col(m - 1).head(m + 1), triangle.col(m).head(m + 1));
      turn_columns(basis.col(m - 1), basis.col(m));
      triangle(m, m - 1) = Complex(0);
    }
  }
};

}  // namespace detail

/// The eigenvalues s_k and eigenvectors V of a real square matrix, A V = V diag(s). In the
/// coordinates η = V⁻¹ x the system ẋ = A x + b u, y = h x becomes N scalar equations:
///
///     η̇_k = s_k η_k + β_k u,   y = Σ γ_k η_k,   β = V⁻¹ b,   γ = h V
///
/// The eigenvectors are computed from the Schur form of the balanced matrix by back substitution.
/// In the Schur basis V is triangular, hence no dense matrix is inverted. Work: about 30 N³
/// operations. For (nearly) equal eigenvalues V may be (nearly) singular: see `is_sound()`.
template <class Scalar>
class EigenBasis {
 public:
  using Complex = std::complex<Scalar>;                   ///< type of eigenvalues and coordinates
  using ComplexVector = Vector<Complex, Eigen::Dynamic>;  ///< column of N complex numbers
  using ComplexMatrix = Matrix<Complex, Eigen::Dynamic>;  ///< matrix of N × N complex numbers

  /// Computes the basis. @param matrix  matrix A, N × N, finite, N ≥ 1
  /// @throws InvalidParameter where A is empty or not square
  explicit EigenBasis(const Matrix<Scalar, Eigen::Dynamic>& matrix);

  /// The eigenvalues s_1 … s_N; the two of a conjugate pair are stored side by side.
  ComplexVector values() const { return triangle_.diagonal(); }

  /// The coordinates β = V⁻¹ b (N × 1) of an input vector b (N × 1) in the eigenvector basis.
  /// @throws InvalidParameter unless b has N entries
  ComplexVector coordinates(const Vector<Scalar, Eigen::Dynamic>& b) const;

  /// The coefficients γ = h V of an output y = h x (row h, 1 × N), as a column of N entries.
  /// @throws InvalidParameter unless h has N entries
  ComplexVector readings(const RowVector<Scalar, Eigen::Dynamic>& h) const;

  /// Whether coordinates() and readings() are accurate to about nine digits or more. This is so if
  /// no two eigenvectors nearly coincide and the QR algorithm has converged.
  bool is_sound() const;

 private:
  /// Computes the eigenvectors: column k solves (T − t_kk) x = 0 with x_k = 1.
  void find_vectors() {
    const Eigen::Index n = triangle_.rows();
    const Scalar least = std::numeric_limits<Scalar>::epsilon() *
                         std::max(triangle_.cwiseAbs().maxCoeff(), Scalar(1e-300));
    vectors_ = ComplexMatrix::Identity(n, n);
    for (Eigen::Index k = 1; k < n; ++k) {
      vectors_.col(k).head(k) = -triangle_.col(k).head(k);
      for (Eigen::Index i = k - 1; i >= 0; --i) {
        Complex away = triangle_(i, i) - triangle_(k, k);
        if (std::abs(away) < least) away = least;
        vectors_(i, k) /= away;
        vectors_.col(k).head(i) -= vectors_(i, k) * triangle_.col(i).head(i);
      }
    }
  }

  Vector<Scalar, Eigen::Dynamic> factors_;  // balancing factors
  ComplexMatrix triangle_;                  // T of the complex Schur form
  ComplexMatrix basis_;                     // U of the complex Schur form
  ComplexMatrix vectors_;                   // eigenvectors of T, unit upper triangular
  bool converged_ = false;
};

// Defined outside the class, since inline members are compiled again in every file that uses them.

template <class Scalar>
EigenBasis<Scalar>::EigenBasis(const Matrix<Scalar, Eigen::Dynamic>& matrix) {
  const BalancedMatrix<Scalar, Eigen::Dynamic> similar(matrix);
  factors_ = similar.factors;
  const Scalar scale =
      std::max(similar.balanced.cwiseAbs().maxCoeff(), std::numeric_limits<Scalar>::min());
  detail::TriangularForm<Scalar> schur(similar.balanced, scale);
  triangle_ = std::move(schur.triangle);
  basis_ = std::move(schur.basis);
  converged_ = schur.converged;
  find_vectors();
}

template <class Scalar>
auto EigenBasis<Scalar>::coordinates(const Vector<Scalar, Eigen::Dynamic>& b) const
    -> ComplexVector {
  require_size("entries of an input column", b.size(), factors_.size());
  const Vector<Scalar, Eigen::Dynamic> balanced = factors_.cwiseInverse().cwiseProduct(b);
  return vectors_.template triangularView<Eigen::UnitUpper>().solve(basis_.adjoint() * balanced);
}

template <class Scalar>
auto EigenBasis<Scalar>::readings(const RowVector<Scalar, Eigen::Dynamic>& h) const
    -> ComplexVector {
  require_size("entries of a reading row", h.size(), factors_.size());
  const RowVector<Scalar, Eigen::Dynamic> balanced = h.cwiseProduct(factors_.transpose());
  return ((balanced.template cast<Complex>() * basis_) * vectors_).transpose();
}

template <class Scalar>
bool EigenBasis<Scalar>::is_sound() const {
  return converged_ &&
         vectors_.cwiseAbs().maxCoeff() * std::numeric_limits<Scalar>::epsilon() < Scalar(1e-10);
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template class EigenBasis<double>;
#endif

}  // namespace holdfast
