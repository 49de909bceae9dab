#pragma once

#include <Eigen/Core>
#include <type_traits>

#include "holdfast/core/compiler.hpp"

namespace holdfast {

/// Whether a number type represents real numbers: true for floating-point types, duals and packs,
/// false for integers, in which 1/m is 0.
template <class Scalar>
inline constexpr bool is_real = !std::is_integral_v<Scalar>;

/// Column vector with `Size` entries.
template <class Scalar, int Size>
using Vector = Eigen::Matrix<Scalar, Size, 1>;

/// Row vector with `Size` entries.
template <class Scalar, int Size>
using RowVector = Eigen::Matrix<Scalar, 1, Size>;

/// Matrix with `Rows` rows and `Columns` columns; square when only one size is given.
template <class Scalar, int Rows, int Columns = Rows>
using Matrix = Eigen::Matrix<Scalar, Rows, Columns>;

/// The matrix size `size` + `more`; Eigen::Dynamic where one of the two is Eigen::Dynamic.
constexpr int larger_size(int size, int more) {
  return size == Eigen::Dynamic || more == Eigen::Dynamic ? Eigen::Dynamic : size + more;
}

/// π to the precision of the number type, at most 30 digits.
template <class Scalar>
inline constexpr Scalar pi = Scalar(3.14159265358979323846264338328L);

/// π in any number type: to full precision for a floating-point type, to the precision of `double`
/// for a type constructed from a `double`, such as duals and packs.
template <class Scalar>
Scalar pi_of() {
  if constexpr (std::is_floating_point_v<Scalar>) {
    return pi<Scalar>;
  } else {
    return Scalar(pi<double>);
  }
}

}  // namespace holdfast
