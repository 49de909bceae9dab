#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "holdfast/core/lanes.hpp"
#include "holdfast/math/poly/polynomial.hpp"
#include "holdfast/math/poly/routh_hurwitz.hpp"

namespace holdfast {

/// A row of a chart tested cell by cell, as many cells at a time as the number type has lanes.
///
/// Work per cell: what the polynomial costs (Degree + 1 multiply-adds where it is affine along the
/// row) and `lienard_chipart_stable`: 17 multiply-adds and 5 comparisons for the sampled loop. No
/// product overflows as long as the coefficients lie within 1e±75.
/// @tparam Scalar        a SIMD pack, or double
/// @param columns        number of cells, ≥ 0
/// @param polynomial_at  (column, Number{}) → Polynomial<Number, Degree> of the cells from that
/// column on, for Number = Scalar and double; in a variable whose stable half-plane is Re < 0
/// A copy: writing bytes through `stable` might otherwise change what it refers to, for all that
/// the compiler knows, and every coefficient would be read again for every pack.
/// @param stable         `columns` entries: 1 stable, 0 not
template <class Scalar, class PolynomialAt>
void hurwitz_row(std::int64_t columns, PolynomialAt polynomial_at, std::uint8_t* stable) {
  constexpr auto lanes = static_cast<std::int64_t>(Lanes<Scalar>::count);
  const auto stable_at = [&polynomial_at](std::int64_t column) {
    return lienard_chipart_stable(polynomial_at(column, Scalar(0.0)));
  };
  std::int64_t column = 0;
  for (; column + 2 * lanes <= columns; column += 2 * lanes) {
    Lanes<Scalar>::store_flags(stable_at(column), stable_at(column + lanes), stable + column);
  }
  for (; column + lanes <= columns; column += lanes) {
    Lanes<Scalar>::store_flags(stable_at(column), stable + column);
  }
  for (; column < columns; ++column) {
    stable[column] = lienard_chipart_stable(polynomial_at(column, 0.0)) ? 1 : 0;
  }
}

/// c + x s.
template <int Size, class Scalar>
Vector<Scalar, Size> affine(const Vector<Scalar, Size>& c, const Scalar& x,
                            const Vector<Scalar, Size>& s) {
  Vector<Scalar, Size> result;
  for (int k = 0; k < Size; ++k) result[k] = c[k] + x * s[k];
  return result;
}

/// The row of polynomials constant + x slope, one for each value x.
///
/// They are scaled by one factor so that no product overflows. Where the values span so many
/// decades that the smallest would underflow, each polynomial is scaled by itself.
/// @param constant  the polynomial at x = 0, in a variable whose stable half-plane is Re < 0
/// @param slope     its change per unit of x
/// @param values    x of each cell, ascending; at least one
/// @param stable    as many entries as `values`: 1 stable, 0 not
template <class Scalar, int Size>
void hurwitz_row(const Vector<double, Size>& constant, const Vector<double, Size>& slope,
                 const std::vector<double>& values, std::uint8_t* stable) {
  const auto columns = static_cast<std::int64_t>(values.size());
  const double reach = std::max(std::abs(values.front()), std::abs(values.back()));
  const double constant_size = constant.cwiseAbs().maxCoeff();
  const double largest = constant_size + reach * slope.cwiseAbs().maxCoeff();
  if (!(constant_size > 1e-60 * largest)) {
    for (std::int64_t column = 0; column < columns; ++column) {
      stable[column] =
          is_hurwitz<double, Size>(constant + values[static_cast<std::size_t>(column)] * slope);
    }
    return;
  }
  const Vector<double, Size> c = constant / largest, s = slope / largest;
  const Vector<Scalar, Size> c_pack = c.template cast<Scalar>(), s_pack = s.template cast<Scalar>();
  hurwitz_row<Scalar>(
      columns,
      [c, s, c_pack, s_pack, x_values = values.data()](std::int64_t column, const auto& number) {
        using Number = std::decay_t<decltype(number)>;
        const Number x = Lanes<Number>::load(x_values + column);
        if constexpr (std::is_same_v<Number, Scalar>) {
          return affine<Size>(c_pack, x, s_pack);
        } else {
          return affine<Size>(c, x, s);
        }
      },
      stable);
}

/// The row of polynomials of a table: columns × (Degree + 1), each scaled by its largest
/// coefficient.
template <class Scalar, int Size>
void hurwitz_row(const Eigen::Matrix<double, Eigen::Dynamic, Size>& table, std::uint8_t* stable) {
  const Eigen::Matrix<double, Eigen::Dynamic, Size> scaled =
      table.array().colwise() / table.cwiseAbs().rowwise().maxCoeff().array();
  hurwitz_row<Scalar>(
      scaled.rows(),
      [&](std::int64_t column, const auto& number) {
        using Number = std::decay_t<decltype(number)>;
        Vector<Number, Size> polynomial;
        for (int k = 0; k < Size; ++k) {
          polynomial[k] = Lanes<Number>::load(scaled.col(k).data() + column);
        }
        return polynomial;
      },
      stable);
}

}  // namespace holdfast
