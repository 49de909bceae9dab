#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "holdfast/core/lanes.hpp"
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
template <class Scalar = double>
class StabilityChartRows {
 public:
  /// @throws InvalidParameter where the chart is not admissible
  explicit StabilityChartRows(const LoopChart& chart)
      : polynomials_(chart, in_half_plane<double, 6>) {
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
      hurwitz_row<Scalar, 6>(line.constant, line.slope, values_, stable);
    } else {
      hurwitz_row<Scalar, 6>(polynomials_.table(row), stable);
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
  std::vector<double> values_;
  std::optional<StabilityRows<5>> crossing_rows_;
};

/// Spectral radius over any two parameters of the sampled loop, several rows at a time.
/// @tparam Degree  5 where every loop of the chart has δ = 0, 6 otherwise (see `DominantFactor`)
template <class Scalar, int Degree>
class RadiusChartRows {
 public:
  /// Rows that one call of `fill` takes, one a lane of two packs.
  static constexpr auto most_rows =
      static_cast<std::int64_t>(RadiusRows<Scalar, Degree>::most_rows);

  /// @throws InvalidParameter where the chart is not admissible
  explicit RadiusChartRows(const LoopChart& chart) : polynomials_(chart, root_added) {}

  /// Writes ρ of `count` rows, 1 … most_rows, one after the other.
  void fill(std::int64_t first, std::int64_t count, double* radius) {
    if (polynomials_.affine_along_rows()) {
      fill_from_lines(first, count, radius);
    } else {
      fill_from_tables(first, count, radius);
    }
  }

 private:
  using Pack = Polynomial<Scalar, Degree>;
  static constexpr std::size_t lanes_ = Lanes<Scalar>::count;
  static constexpr std::size_t packs_ = RadiusRows<Scalar, Degree>::packs;

  static Polynomial<double, Degree> root_added(const Polynomial<double, 5>& polynomial) {
    if constexpr (Degree == 5) {
      return polynomial;
    } else {
      return with_root_at_zero<double, 6>(polynomial, 1.0);
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

  void fill_from_lines(std::int64_t first, std::int64_t count, double* radius) {
    std::vector<AffineLine<Degree>> lines;
    for (std::int64_t row = 0; row < count; ++row) lines.push_back(polynomials_.line(first + row));
    std::array<Pack, packs_> constant, slope;
    for (std::size_t pack = 0; pack < packs_; ++pack) {
      constant[pack] = gathered(pack, count, [&](std::size_t row) { return lines[row].constant; });
      slope[pack] = gathered(pack, count, [&](std::size_t row) { return lines[row].slope; });
    }
    const Axis& values = polynomials_.chart().fast.values;
    rows_.fill(
        static_cast<std::size_t>(count), polynomials_.columns(),
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

  void fill_from_tables(std::int64_t first, std::int64_t count, double* radius) {
    std::vector<typename ChartPolynomials<Degree>::Table> tables;
    for (std::int64_t row = 0; row < count; ++row)
      tables.push_back(polynomials_.table(first + row));
    rows_.fill(
        static_cast<std::size_t>(count), polynomials_.columns(),
        [&](std::size_t pack, std::int64_t column) {
          return gathered(pack, count, [&](std::size_t row) { return tables[row].row(column); });
        },
        radius);
  }

  ChartPolynomials<Degree> polynomials_;
  RadiusRows<Scalar, Degree> rows_;
};

/// True where the chart holds a loop with a processing delay, so that its polynomials lack the root
/// λ = 0.
inline bool has_processing_delay(const LoopChart& chart) {
  return chart.cell(0, 0).sampling.processing_delay > 0.0 ||
         chart.cell(chart.slow.values.count - 1, chart.fast.values.count - 1)
                 .sampling.processing_delay > 0.0;
}

}  // namespace holdfast
