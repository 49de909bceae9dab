#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "holdfast/core/axis.hpp"
#include "holdfast/core/lanes.hpp"
#include "holdfast/math/poly/polynomial.hpp"
#include "holdfast/math/poly/routh_hurwitz.hpp"
#include "holdfast/stability/chart/chart.hpp"
#include "holdfast/stability/chart/loop_chart.hpp"
#include "holdfast/stability/polynomial/characteristic_polynomial.hpp"
#include "holdfast/stability/polynomial/dominant_factor.hpp"

namespace holdfast {

/// Tests the stability of each cell in a row of a chart; SIMD lanes test several cells at a time.
/// A cell of the sampled loop needs 17 multiply-adds and 5 comparisons (`lienard_chipart_stable`).
/// No product overflows or underflows if all coefficients have moduli between 1e−75 and 1e75.
/// @tparam Scalar        a SIMD pack, or double
/// @param columns        number of cells in the row, ≥ 0
/// @param polynomial_at  function (column, Number{}) → Polynomial<Number, Degree>, a polynomial
///                       whose stable roots have Re < 0. Number is Scalar or double. The lanes of
///                       Number are the cells from `column` on. The function is passed by value
///                       for speed: it cannot alias the array `stable`.
/// @param stable         array with `columns` entries, filled with 1 (stable) or 0 (not stable)
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

/// The vector c + x s for a number x and vectors c and s of equal size.
template <int Size, class Scalar>
Vector<Scalar, Size> affine(const Vector<Scalar, Size>& c, const Scalar& x,
                            const Vector<Scalar, Size>& s) {
  Vector<Scalar, Size> result;
  for (int k = 0; k < Size; ++k) result[k] = c[k] + x * s[k];
  return result;
}

/// Tests the polynomials constant + x · slope for stability, one polynomial for each value x. All
/// are divided by a common upper bound on their coefficients to avoid overflow. If `constant` is
/// below 1e−60 of this bound, each polynomial is scaled individually to avoid underflow.
/// @param constant  polynomial at x = 0, constant coefficient first; stable roots have Re < 0
/// @param slope     change of the polynomial per unit of x
/// @param values    x of each cell, ascending; at least one
/// @param stable    array with one entry for each value, filled with 1 (stable) or 0 (not stable)
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

/// Tests the polynomials in the rows of a table for stability, first divided by their largest
/// coefficients.
/// @param table   matrix of polynomials, constant coefficient first; stable roots have Re < 0
/// @param stable  array with one entry per polynomial, filled with 1 (stable) or 0 (not stable)
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

namespace detail {

/// The characteristic polynomial of a sampled loop in powers of λ − 1, affine in P and D. All
/// functions called are inlined. Since the type of the SIMD pack is a template argument, the matrix
/// exponential is also compiled for the pack's instruction set.
template <class Scalar>
[[gnu::flatten, gnu::noinline]] AffinePolynomial<double, 5> polynomial_of(
    const OperatingPoint& point) {
  return characteristic_polynomial(sampled_loop(point.plant, point.sampling));
}

}  // namespace detail

/// Computes the stability chart over any two parameters of the sampled loop row by row.
/// If both axes are gains, the crossings of a row with the stability boundary are computed
/// (`StabilityRows`). Otherwise each cell is tested (`hurwitz_row`).
/// @tparam Scalar  a SIMD pack, or double; as many cells are tested at once as it has lanes
template <class Scalar = double>
class StabilityChartRows {
 public:
  /// The characteristic polynomial of a loop in the variable w of `in_half_plane`.
  static HalfPlanePolynomial<double, 5> polynomial_of(const OperatingPoint& point) {
    return in_half_plane(detail::polynomial_of<Scalar>(point));
  }

  /// Prepares the rows of a chart. @throws InvalidParameter where the chart is not admissible
  explicit StabilityChartRows(const LoopChart& chart) : polynomials_(chart, polynomial_of) {
    for (std::int64_t column = 0; column < polynomials_.columns(); ++column) {
      values_.push_back(chart.fast.values.at(column));
    }
    if (is_gain(chart.slow.parameter) && is_gain(chart.fast.parameter)) {
      HalfPlanePolynomial<double, 5> p = polynomials_.common();
      // The gain that is constant along a row takes the place of P.
      if (chart.slow.parameter == LoopParameter::differential_gain)
        std::swap(p.proportional, p.differential);
      crossing_rows_.emplace(p, chart.fast.values);
    }
  }

  /// Writes 1 (stable) or 0 (not stable) for each cell of some rows, row by row.
  /// @param first   index of the first row, from 0
  /// @param count   number of rows, ≥ 0
  /// @param stable  array with one entry for each cell of these rows
  [[gnu::flatten]] void fill(std::int64_t first, std::int64_t count, std::uint8_t* stable) {
    for (std::int64_t row = first; row < first + count; ++row, stable += polynomials_.columns()) {
      if (crossing_rows_) {
        crossing_rows_->fill(polynomials_.chart().slow.values.at(row), stable);
      } else if (polynomials_.affine_along_rows()) {
        const AffineLine<5> line = polynomials_.line(row);
        hurwitz_row<Scalar, 6>(line.constant, line.slope, values_, stable);
      } else {
        hurwitz_row<Scalar, 6>(polynomials_.table(row), stable);
      }
    }
  }

 private:
  ChartPolynomials<5, PolynomialVariable::half_plane> polynomials_;
  std::vector<double> values_;
  std::optional<StabilityRows<5>> crossing_rows_;
};

/// Computes the chart of the spectral radius over any two parameters of the sampled loop. Each SIMD
/// lane computes one row. The dominant roots of a cell are the initial guess for the next cell in
/// the row (`DominantFactor`); a row's first cell starts from the first cell of an earlier row. Two
/// packs of rows are interleaved: one is computed during the divisions of the other.
/// @tparam Degree  5 if every loop of the chart has δ = 0, otherwise 6 (see `DominantFactor`)
template <class Scalar, int Degree>
class RadiusChartRows {
  using Pack = Polynomial<Scalar, Degree>;
  using Follower = DominantFactor<Scalar, Degree>;
  static constexpr std::size_t lanes_ = Lanes<Scalar>::count;
  static constexpr std::size_t packs_ = 2;

 public:
  /// The number of rows computed at once, one in each lane of the two SIMD packs.
  static constexpr auto most_rows = static_cast<std::int64_t>(packs_ * lanes_);

  /// The characteristic polynomial of a loop in powers of λ − 1, times λ if Degree is 6.
  static AffinePolynomial<double, Degree> polynomial_of(const OperatingPoint& point) {
    const AffinePolynomial<double, 5> p = detail::polynomial_of<Scalar>(point);
    return {root_added(p.base), root_added(p.proportional), root_added(p.differential)};
  }

  /// Prepares the rows of a chart. @throws InvalidParameter where the chart is not admissible
  explicit RadiusChartRows(const LoopChart& chart) : polynomials_(chart, polynomial_of) {}

  /// Writes the spectral radius ρ of each cell of some rows, row by row.
  /// @param first   index of the first row, from 0
  /// @param count   number of rows, ≥ 0
  /// @param radius  array with one entry for each cell of these rows
  void fill(std::int64_t first, std::int64_t count, double* radius) {
    for (std::int64_t row = 0; row < count; row += most_rows) {
      const std::int64_t some = std::min(most_rows, count - row);
      double* of_rows = radius + row * polynomials_.columns();
      if (polynomials_.affine_along_rows()) {
        fill_from_lines(first + row, some, of_rows);
      } else {
        fill_from_tables(first + row, some, of_rows);
      }
    }
  }

 private:
  static Polynomial<double, Degree> root_added(const Polynomial<double, 5>& polynomial) {
    if constexpr (Degree == 5) {
      return polynomial;
    } else {
      return with_root_at_zero<double, 6>(polynomial);
    }
  }

  void fill_from_lines(std::int64_t first, std::int64_t count, double* radius) {
    std::vector<AffineLine<Degree>> lines;
    for (std::int64_t row = 0; row < count; ++row) lines.push_back(polynomials_.line(first + row));
    std::array<Pack, packs_> constant, slope;
    for (std::size_t pack = 0; pack < packs_; ++pack) {
      constant[pack] = gathered(
          pack, count, [&](std::size_t row) -> const auto& { return lines[row].constant; });
      slope[pack] = gathered(
          pack, count, [&](std::size_t row) -> const auto& { return lines[row].slope; });
    }
    const Axis& values = polynomials_.chart().fast.values;
    follow(
        count, values.count,
        [&](std::size_t pack, std::int64_t column) {
          return affine<Degree + 1>(constant[pack], Scalar(values.at(column)), slope[pack]);
        },
        radius);
  }

  void fill_from_tables(std::int64_t first, std::int64_t count, double* radius) {
    std::vector<typename decltype(polynomials_)::Table> tables;
    for (std::int64_t row = 0; row < count; ++row)
      tables.push_back(polynomials_.table(first + row));
    follow(
        count, polynomials_.columns(),
        [&](std::size_t pack, std::int64_t column) {
          return gathered(pack, count, [&](std::size_t row) { return tables[row].row(column); });
        },
        radius);
  }

  /// Writes the spectral radii of up to `most_rows` rows; results of unused lanes are dropped.
  /// @param polynomial_at  function (index of the pack, column) → characteristic polynomials
  template <class PolynomialAt>
  void follow(std::int64_t rows, std::int64_t columns, const PolynomialAt& polynomial_at,
              double* radius) {
    std::array<Follower, packs_> followers = first_cells_;
    for (std::int64_t column = 0; column < columns; ++column) {
      std::array<double, packs_ * lanes_> cells;
      for (std::size_t pack = 0; pack < packs_; ++pack) {
        const Scalar rho = followers[pack].radius(polynomial_at(pack, column));
        Lanes<Scalar>::store(rho, cells.data() + pack * lanes_);
      }
      for (std::size_t row = 0; row < static_cast<std::size_t>(rows); ++row) {
        radius[static_cast<std::int64_t>(row) * columns + column] = cells[row];
      }
      if (column == 0) first_cells_ = followers;
    }
  }

  /// The polynomials of one pack of rows, one in each lane; unused lanes repeat the last row.
  template <class PolynomialOfRow>
  static Pack gathered(std::size_t pack, std::int64_t count, const PolynomialOfRow& of_row) {
    const auto last = static_cast<std::size_t>(count - 1);
    Pack result;
    for (int k = 0; k <= Degree; ++k) {
      std::array<double, lanes_> values;
      for (std::size_t lane = 0; lane < lanes_; ++lane)
        values[lane] = of_row(std::min(pack * lanes_ + lane, last))[k];
      result[k] = Lanes<Scalar>::load(values.data());
    }
    return result;
  }

  ChartPolynomials<Degree, PolynomialVariable::about_one> polynomials_;
  std::array<Follower, packs_> first_cells_;
};

/// Whether some loop of the chart has δ > 0. If so, `RadiusChartRows` needs Degree = 6.
inline bool has_processing_delay(const LoopChart& chart) {
  return chart.cell(0, 0).sampling.processing_delay > 0.0 ||
         chart.cell(chart.slow.values.count - 1, chart.fast.values.count - 1)
                 .sampling.processing_delay > 0.0;
}

}  // namespace holdfast
