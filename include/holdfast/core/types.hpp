#pragma once

#include <Eigen/Core>

namespace holdfast {

/// Column vector with `Size` entries.
template <class Scalar, int Size>
using Vector = Eigen::Matrix<Scalar, Size, 1>;

/// Row vector with `Size` entries.
template <class Scalar, int Size>
using RowVector = Eigen::Matrix<Scalar, 1, Size>;

/// Matrix with `Rows` rows and `Columns` columns; square when only one size is given.
template <class Scalar, int Rows, int Columns = Rows>
using Matrix = Eigen::Matrix<Scalar, Rows, Columns>;

/// π to the precision of the number type (30 digits are given).
template <class Scalar>
inline constexpr Scalar pi = Scalar(3.14159265358979323846264338328L);

}  // namespace holdfast
