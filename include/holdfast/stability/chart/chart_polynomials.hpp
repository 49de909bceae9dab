#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <utility>

#include "holdfast/stability/chart/loop_chart.hpp"

namespace holdfast {

/// The characteristic polynomials of the cells of a chart, with as few matrix exponentials as its
/// axes allow: one in all where both axes are gains; one a row or one a column where one of them
/// is; one a cell where none is.
template <int Degree>
class ChartPolynomials {
 public:
  /// From the polynomial in powers of λ − 1 to the one that the chart is computed from; linear.
  using Map = std::function<Polynomial<double, Degree>(const Polynomial<double, 5>&)>;

  /// Polynomials along a row, one coefficient after the other: columns × (Degree + 1).
  using Table = Eigen::Matrix<double, Eigen::Dynamic, Degree + 1>;

  /// @param chart  copied
  /// @param map    a linear map applied to every polynomial in powers of λ − 1: `in_half_plane`,
  /// `with_root_at_zero`, …
  /// @throws InvalidParameter where the chart is not admissible
  ChartPolynomials(const LoopChart& chart, Map map) : chart_(chart), map_(std::move(map)) {
    validate(chart);
    if (is_gain(chart.slow.parameter) && is_gain(chart.fast.parameter)) {
      common_ = polynomial_of(chart.point);
    } else if (is_gain(chart.slow.parameter)) {
      tabulate_columns();
    }
  }

  /// Cells of a row: values of the fast parameter.
  std::int64_t columns() const { return chart_.fast.values.count; }
  /// The two axes and the loop that they vary.
  const LoopChart& chart() const { return chart_; }

  /// The polynomial of all cells where both axes are gains.
  const AffinePolynomial<double, Degree>& common() const { return common_; }

  /// True where the polynomial is affine in the fast parameter: `line` then serves, else `table`.
  bool affine_along_rows() const { return is_gain(chart_.fast.parameter); }

  /// The polynomials of a row as a function of the fast gain.
  AffineLine<Degree> line(std::int64_t row) const {
    const OperatingPoint point = chart_.row(row);
    return along(chart_.fast.parameter,
                 is_gain(chart_.slow.parameter) ? common_ : polynomial_of(point), point.gains);
  }

  /// The polynomials of every cell of a row.
  Table table(std::int64_t row) const {
    if (is_gain(chart_.slow.parameter)) {
      return column_constants_ + chart_.slow.values.at(row) * column_slopes_;
    }
    Table result(columns(), Degree + 1);
    for (std::int64_t column = 0; column < columns(); ++column) {
      const OperatingPoint point = chart_.cell(row, column);
      result.row(column) = polynomial_of(point).at(point.gains);
    }
    return result;
  }

 private:
  AffinePolynomial<double, Degree> polynomial_of(const OperatingPoint& point) const {
    const auto p = characteristic_polynomial(point);
    return {map_(p.base), map_(p.proportional), map_(p.differential)};
  }

  void tabulate_columns() {
    column_constants_.resize(columns(), Degree + 1);
    column_slopes_.resize(columns(), Degree + 1);
    for (std::int64_t column = 0; column < columns(); ++column) {
      const OperatingPoint point = chart_.cell(0, column);
      const auto line = along(chart_.slow.parameter, polynomial_of(point), point.gains);
      column_constants_.row(column) = line.constant;
      column_slopes_.row(column) = line.slope;
    }
  }

  LoopChart chart_;
  Map map_;
  AffinePolynomial<double, Degree> common_;
  Table column_constants_, column_slopes_;
};

}  // namespace holdfast
