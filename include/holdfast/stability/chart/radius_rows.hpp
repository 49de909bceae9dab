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

/// Rows of a chart of the spectral radius; several rows at a time, one a lane.
///
/// Every row is followed from its first cell by `DominantFactor`. Two packs of rows go side by
/// side, so that one computes while the other waits for its division. The first cells are followed
/// from one batch of rows to the next; a batch starts afresh where none came before.
template <class Scalar, int Degree>
class RadiusRows {
 public:
  /// Packs of rows that go side by side.
  static constexpr std::size_t packs = 2;
  /// Rows of a full batch, one a lane.
  static constexpr std::size_t most_rows = packs * Lanes<Scalar>::count;

  /// @param centre  of the polynomials, see `DominantFactor`
  explicit RadiusRows(double centre = 1.0) {
    first_cells_.fill(DominantFactor<Scalar, Degree>(centre));
  }

  /// Writes ρ of `rows` rows of `columns` cells, one row after the other.
  /// @param rows           1 … most_rows; lanes beyond them are computed and dropped
  /// @param columns        cells of a row
  /// @param polynomial_at  (pack, column) → Polynomial<Scalar, Degree> of that pack of rows: monic,
  /// in powers of μ = λ − centre, with a root λ = 0 (see `DominantFactor`)
  /// @param radius         rows × columns
  template <class PolynomialAt>
  void fill(std::size_t rows, std::int64_t columns, const PolynomialAt& polynomial_at,
            double* radius) {
    std::array<DominantFactor<Scalar, Degree>, packs> followers = first_cells_;
    for (std::int64_t column = 0; column < columns; ++column) {
      std::array<double, most_rows> cells;
      for (std::size_t pack = 0; pack < packs; ++pack) {
        const Scalar rho = followers[pack].radius(polynomial_at(pack, column));
        Lanes<Scalar>::store(rho, cells.data() + pack * Lanes<Scalar>::count);
      }
      for (std::size_t row = 0; row < rows; ++row) {
        radius[static_cast<std::int64_t>(row) * columns + column] = cells[row];
      }
      if (column == 0) first_cells_ = followers;
    }
  }

 private:
  std::array<DominantFactor<Scalar, Degree>, packs> first_cells_;
};

/// Rows of a chart of the spectral radius from the polynomials of its cells, up to `most_rows()` at
/// a time.
template <class Scalar, int Degree>
class RadiusBatch {
 public:
  /// Polynomials along a row, as `ChartPolynomials` gives them.
  using Table = typename ChartPolynomials<Degree>::Table;

  /// Rows that one call takes, one a lane of two packs.
  static constexpr std::int64_t most_rows() {
    return static_cast<std::int64_t>(RadiusRows<Scalar, Degree>::most_rows);
  }

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
    rows_.fill(
        static_cast<std::size_t>(count), values.count,
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
    rows_.fill(
        static_cast<std::size_t>(count), tables->rows(),
        [&](std::size_t pack, std::int64_t column) {
          return gathered(pack, count, [&](std::size_t row) { return tables[row].row(column); });
        },
        radius);
  }

 private:
  using Pack = Polynomial<Scalar, Degree>;
  static constexpr std::size_t lanes_ = Lanes<Scalar>::count;
  static constexpr std::size_t packs_ = RadiusRows<Scalar, Degree>::packs;

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

  RadiusRows<Scalar, Degree> rows_;
};

}  // namespace holdfast
