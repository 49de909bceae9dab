#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "holdfast/math/poly/mobius_zhukovsky.hpp"
#include "holdfast/stability/chart/chart.hpp"
#include "holdfast/stability/chart/chart_polynomials.hpp"
#include "holdfast/stability/chart/hurwitz_row.hpp"
#include "holdfast/stability/chart/radius_rows.hpp"

namespace holdfast {

/// Stable or not over any two parameters of the sampled loop, row by row.
///
/// Over both gains each row is filled from its crossings (`StabilityRows`); otherwise every cell is
/// tested (`hurwitz_row`), as many at a time as `Scalar` has lanes.
/// @tparam Rows  tests the cells, as HurwitzRows does
template <class Scalar = double, class Rows = HurwitzRows<Scalar, 6>>
class StabilityChartRows {
 public:
  /// @throws InvalidParameter where the chart is not admissible
  explicit StabilityChartRows(const LoopChart& chart, const Rows& rows = Rows())
      : polynomials_(chart, in_half_plane<double, 6>), rows_(rows) {
    for (std::int64_t column = 0; column < polynomials_.columns(); ++column) {
      values_.push_back(chart.fast.values.at(column));
    }
    if (is_gain(chart.slow.parameter) && is_gain(chart.fast.parameter)) {
      crossing_rows_.emplace(with_slow_gain_first(), chart.fast.values);
    }
  }

  /// Writes 1 or 0 for each cell of a row.
  void fill(std::int64_t row, std::uint8_t* stable) {
    if (crossing_rows_) {
      crossing_rows_->fill(polynomials_.chart().slow.values.at(row), stable);
    } else if (polynomials_.affine_along_rows()) {
      const AffineLine<5> line = polynomials_.line(row);
      rows_.fill(line.constant, line.slope, values_, stable);
    } else {
      rows_.fill(polynomials_.table(row), stable);
    }
  }

 private:
  /// The polynomial with the gain that is constant along a row in the place of P.
  AffinePolynomial<double, 5> with_slow_gain_first() const {
    AffinePolynomial<double, 5> p = polynomials_.common();
    if (polynomials_.chart().slow.parameter == LoopParameter::differential_gain) {
      std::swap(p.proportional, p.differential);
    }
    return p;
  }

  ChartPolynomials<5> polynomials_;
  Rows rows_;
  std::vector<double> values_;
  std::optional<StabilityRows<5>> crossing_rows_;
};

/// Spectral radius over any two parameters of the sampled loop, several rows at a time.
/// @tparam Degree  5 where every loop of the chart has δ = 0, 6 otherwise (see `DominantFactor`)
/// @tparam Batch   computes the rows, as RadiusBatch does
template <class Scalar, int Degree, class Batch = RadiusBatch<Scalar, Degree>>
class RadiusChartRows {
 public:
  /// Rows that the kernel takes at once, one a lane of two packs.
  static constexpr std::int64_t most_rows = RadiusBatch<Scalar, Degree>::most_rows();

  /// @throws InvalidParameter where the chart is not admissible
  explicit RadiusChartRows(const LoopChart& chart, const Batch& batch = Batch())
      : polynomials_(chart, root_added), batch_(batch) {}

  /// Writes ρ of `count` ≥ 0 rows, one after the other.
  void fill(std::int64_t first, std::int64_t count, double* radius) {
    const std::int64_t most = batch_.most_rows();
    for (std::int64_t row = 0; row < count; row += most) {
      const std::int64_t some = std::min(most, count - row);
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
      return with_root_at_zero<double, 6>(polynomial, 1.0);
    }
  }

  void fill_from_lines(std::int64_t first, std::int64_t count, double* radius) {
    std::vector<AffineLine<Degree>> lines;
    for (std::int64_t row = 0; row < count; ++row) lines.push_back(polynomials_.line(first + row));
    batch_.fill(lines.data(), count, polynomials_.chart().fast.values, radius);
  }

  void fill_from_tables(std::int64_t first, std::int64_t count, double* radius) {
    std::vector<typename ChartPolynomials<Degree>::Table> tables;
    for (std::int64_t row = 0; row < count; ++row)
      tables.push_back(polynomials_.table(first + row));
    batch_.fill(tables.data(), count, radius);
  }

  ChartPolynomials<Degree> polynomials_;
  Batch batch_;
};

/// True where the chart holds a loop with a processing delay, so that its polynomials lack the root
/// λ = 0.
inline bool has_processing_delay(const LoopChart& chart) {
  return chart.cell(0, 0).sampling.processing_delay > 0.0 ||
         chart.cell(chart.slow.values.count - 1, chart.fast.values.count - 1)
                 .sampling.processing_delay > 0.0;
}

}  // namespace holdfast
