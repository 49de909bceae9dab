#pragma once

#include <Eigen/Core>
#include <type_traits>

#include "holdfast/core/compiler.hpp"

namespace holdfast {

/// Whether a number type represents real numbers: true for floating-point types, dual numbers and
/// SIMD packs, false for integers.
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

/// The compile-time matrix size `size` + `more`; Eigen::Dynamic where either is Eigen::Dynamic.
constexpr int larger_size(int size, int more) {
  return size == Eigen::Dynamic || more == Eigen::Dynamic ? Eigen::Dynamic : size + more;
}

/// π to the precision of the number type, at most that of `long double`.
template <class Scalar>
inline constexpr Scalar pi = Scalar(3.14159265358979323846264338328L);

/// π in any number type: to full precision for a floating-point type, to the precision of `double`
/// for a type constructed from a `double`, such as dual numbers and SIMD packs.
template <class Scalar>
Scalar pi_of() {
  if constexpr (std::is_floating_point_v<Scalar>) {
    return pi<Scalar>;
  } else {
    return Scalar(pi<double>);
  }
}

}  // namespace holdfast
