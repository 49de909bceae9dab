#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "holdfast/core/axis.hpp"
#include "holdfast/core/lanes.hpp"
#include "holdfast/math/poly/polynomial.hpp"
#include "holdfast/stability/chart/chart_polynomials.hpp"
#include "holdfast/stability/polynomial/dominant_factor.hpp"

namespace holdfast {

/// Rows of a chart of the spectral radius from the polynomials of its cells, several rows at a
/// time, one a lane.
///
/// The polynomials are monic, in powers of μ = λ − 1, with a root λ = 0 (see `DominantFactor`, by
/// which every row is followed from its first cell). Two packs of rows go side by side, so that one
/// computes while the other waits for its division. The first cells are followed from one batch of
/// rows to the next; a batch starts afresh where none came before.
template <class Scalar, int Degree>
class RadiusBatch {
 public:
  /// Polynomials along a row, as `ChartPolynomials` gives them.
  using Table = typename ChartPolynomials<Degree>::Table;

  /// Rows that one call takes, one a lane of two packs.
  static constexpr std::int64_t most_rows() { return static_cast<std::int64_t>(packs_ * lanes_); }

  RadiusBatch() { first_cells_.fill(Follower(1.0)); }

  /// Writes ρ of rows constant + x slope.
  /// @param lines   of the rows
  /// @param count   of rows, 1 … most_rows()
  /// @param values  x of each cell
  /// @param radius  count × values.count
  void fill(const AffineLine<Degree>* lines, std::int64_t count, const Axis& values,
            double* radius) {
    std::array<Pack, packs_> constant, slope;
    for (std::size_t pack = 0; pack < packs_; ++pack) {
      constant[pack] = gathered(
          pack, count, [&](std::size_t row) -> const auto& { return lines[row].constant; });
      slope[pack] = gathered(
          pack, count, [&](std::size_t row) -> const auto& { return lines[row].slope; });
    }
    follow(
        count, values.count,
        [&](std::size_t pack, std::int64_t column) {
          const Scalar x(values.at(column));
          Pack polynomial;
          for (int k = 0; k <= Degree; ++k) {
            polynomial[k] = constant[pack][k] + x * slope[pack][k];
          }
          return polynomial;
        },
        radius);
  }

  /// Writes ρ of rows of polynomials.
  /// @param tables  of the rows, equally long
  /// @param count   of rows, 1 … most_rows()
  /// @param radius  row after row
  void fill(const Table* tables, std::int64_t count, double* radius) {
    follow(
        count, tables->rows(),
        [&](std::size_t pack, std::int64_t column) {
          return gathered(pack, count, [&](std::size_t row) { return tables[row].row(column); });
        },
        radius);
  }

 private:
  using Pack = Polynomial<Scalar, Degree>;
  using Follower = DominantFactor<Scalar, Degree>;
  static constexpr std::size_t lanes_ = Lanes<Scalar>::count;
  static constexpr std::size_t packs_ = 2;

  /// @param polynomial_at  (pack, column) → Pack; lanes beyond the rows are computed and dropped
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

  /// A row of the batch for each lane; lanes beyond the batch repeat its last row.
  static std::size_t row_of(std::size_t pack, std::size_t lane, std::int64_t count) {
    return std::min(pack * lanes_ + lane, static_cast<std::size_t>(count - 1));
  }

  /// Packs of polynomials from one polynomial a row.
  template <class PolynomialOfRow>
  static Pack gathered(std::size_t pack, std::int64_t count, const PolynomialOfRow& of_row) {
    Pack result;
    for (int k = 0; k <= Degree; ++k) {
      std::array<double, lanes_> values;
      for (std::size_t lane = 0; lane < lanes_; ++lane) {
        values[lane] = of_row(row_of(pack, lane, count))[k];
      }
      result[k] = Lanes<Scalar>::load(values.data());
    }
    return result;
  }

  std::array<Follower, packs_> first_cells_;
};

}  // namespace holdfast
