#pragma once

#include <array>
#include <cstddef>
#include <limits>

#include "holdfast/core/types.hpp"
#include "holdfast/math/linalg/balancing.hpp"
#include "holdfast/math/linalg/elimination.hpp"

namespace holdfast {

namespace detail {

/// A diagonal Padé approximant of e^x, (Σ b_j x^j) / (Σ b_j (−x)^j), whose relative error is about
/// `remainder` · |x|^{2 degree + 1}.
struct PadeApproximant {
  int degree;                    ///< degree m, odd
  double remainder;              ///< factor (m!)² / ((2m)! (2m + 1)!) of the error
  std::array<double, 14> terms;  ///< coefficients b₀ … b_m, whole numbers

  constexpr explicit PadeApproximant(int m) : degree(m), remainder(1.0 / (m + 1)), terms{} {
    for (int k = 1; k <= m; ++k) remainder /= double(m + k) * double(m + 1 + k);
    terms[static_cast<std::size_t>(m)] = 1.0;
    for (int j = m; j > 0; --j) {
      terms[static_cast<std::size_t>(j - 1)] =
          terms[static_cast<std::size_t>(j)] * double((2 * m - j + 1) * j) / double(m - j + 1);
    }
  }

  /// Whether the approximant is exact to round-off for matrices up to a norm x: its error, relative
  /// to x e^x, is below half a unit of the last digit.
  template <class Scalar>
  bool suffices(const Scalar& norm) const {
    Scalar error(remainder);
    for (int k = 0; k < degree; ++k) error *= norm * norm;
    return error <= std::numeric_limits<Scalar>::epsilon() / Scalar(4);
  }
};

inline constexpr std::array<PadeApproximant, 4> pade_approximants{
    PadeApproximant(3), PadeApproximant(5), PadeApproximant(7), PadeApproximant(13)};

/// The product a b of two square matrices, column by column.
template <class Square>
Square square_product(const Square& a, const Square& b) {
  Square product = Square::Zero(a.rows(), a.cols());
  for (Eigen::Index j = 0; j < b.cols(); ++j) {
    for (Eigen::Index k = 0; k < b.rows(); ++k) product.col(j) += a.col(k) * b(k, j);
  }
  return product;
}

/// The sum Σ b_{2k + parity} M^{2k}: even part of the numerator, or odd part divided by M.
/// @param powers  I, M², M⁴, M⁶; only powers up to the degree of the approximant are used
template <class Square>
Square pade_half(const PadeApproximant& approximant, int parity,
                 const std::array<Square, 4>& powers) {
  const Eigen::Index n = powers[0].rows();
  const auto sum = [&](int first, int from) {
    Square result = Square::Zero(n, n);
    for (int k = from; k < 4 && first + 2 * k <= approximant.degree; ++k) {
      const int power = first + 2 * k;
      result += powers[static_cast<std::size_t>(k)] *
                typename Square::Scalar(approximant.terms[static_cast<std::size_t>(power)]);
    }
    return result;
  };
  if (approximant.degree <= 7) return sum(parity, 0);
  return sum(parity, 0) + square_product(powers[3], sum(parity + 6, 1));
}

/// The value of the Padé approximant at the matrix M.
template <class Square>
Square approximated(const PadeApproximant& approximant, const Square& matrix) {
  const Square square = square_product(matrix, matrix);
  std::array<Square, 4> powers{Square::Identity(matrix.rows(), matrix.cols()), square, {}, {}};
  if (approximant.degree >= 4) powers[2] = square_product(square, square);
  if (approximant.degree >= 6) powers[3] = square_product(square, powers[2]);
  const Square even = pade_half(approximant, 0, powers);
  const Square odd = square_product(matrix, pade_half(approximant, 1, powers));
  return eliminated(Square(even - odd), Square(even + odd));
}

}  // namespace detail

/// The matrix exponential e^M for any number type with the four operations and a comparison, such
/// as `long double` and the dual numbers of automatic differentiation.
///
/// The method is scaling and squaring of the balanced matrix, e^M = (e^{M/2^s})^{2^s}. The diagonal
/// Padé approximant of e^{M/2^s} has the smallest degree of 3, 5, 7 and 13 whose error is below
/// round-off; s > 0 only for degree 13. Every squaring loses accuracy; balancing reduces the norm
/// and thus s. Work: up to 6 + s matrix products and one elimination.
/// Source: N. J. Higham, The scaling and squaring method for the matrix exponential revisited,
/// SIAM J. Matrix Anal. Appl. 26 (2005).
/// @param matrix  square matrix M; if Σ |M_ij| is not finite, all entries of the result are NaN
/// @throws InvalidParameter where the matrix is empty or not square
template <class Scalar, int Size>
Matrix<Scalar, Size> exponential(const Matrix<Scalar, Size>& matrix) {
  using Square = Matrix<Scalar, Size>;
  if (!(matrix.cwiseAbs().sum() <= std::numeric_limits<Scalar>::max()))
    return Square::Constant(matrix.rows(), matrix.cols(), std::numeric_limits<Scalar>::quiet_NaN());
  const BalancedMatrix<Scalar, Size> similar(matrix);
  Square scaled = similar.balanced;
  Scalar norm = scaled.cwiseAbs().rowwise().sum().maxCoeff();
  const detail::PadeApproximant* approximant = detail::pade_approximants.data();
  while (approximant != &detail::pade_approximants.back() && !approximant->suffices(norm))
    ++approximant;
  int squarings = 0;
  for (; !approximant->suffices(norm); norm /= Scalar(2), ++squarings) scaled /= Scalar(2);
  Square power = detail::approximated(*approximant, scaled);
  for (; squarings > 0; --squarings) power = detail::square_product(power, power);
  return similar.restored(power);
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template Matrix<double, 5> exponential(const Matrix<double, 5>&);
extern template Matrix<double, 6> exponential(const Matrix<double, 6>&);
extern template Matrix<double, 8> exponential(const Matrix<double, 8>&);
#endif

}  // namespace holdfast
