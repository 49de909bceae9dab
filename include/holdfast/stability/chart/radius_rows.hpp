#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "holdfast/core/lanes.hpp"
#include "holdfast/math/poly/polynomial.hpp"
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

}  // namespace holdfast
