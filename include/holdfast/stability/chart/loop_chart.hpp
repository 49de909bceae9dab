#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "holdfast/control/gains.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/core/axis.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "holdfast/stability/polynomial/characteristic_polynomial.hpp"

namespace holdfast {

/// Plant, sampling and gains of a sampled loop: all parameters on which its stability depends.
struct OperatingPoint {
  TwoMass<double> plant;      ///< masses m (kg), stiffnesses k (N/m) and dampings c (N s/m)
  Sampling<double> sampling;  ///< sampling period τ (s) and processing delay δ (s)
  PdGains<double> gains;      ///< gains P (N/m) and D (N s/m)
};

/// One parameter of a sampled loop, as the axis of a chart or the variable of a sensitivity.
enum class LoopParameter {
  conductor_mass,       ///< conductor's mass m₁ (kg), > 0
  conductor_stiffness,  ///< conductor's stiffness k₁ (N/m), > 0
  conductor_damping,    ///< conductor's damping c₁ (N s/m), ≥ 0
  absorber_mass,        ///< absorber's mass m₂ (kg), > 0
  absorber_stiffness,   ///< absorber's stiffness k₂ (N/m), > 0
  absorber_damping,     ///< absorber's damping c₂ (N s/m), ≥ 0
  sampling_period,      ///< sampling period τ (s), > 0
  processing_delay,     ///< processing delay δ (s), 0 … τ
  proportional_gain,    ///< proportional gain P (N/m)
  differential_gain,    ///< differential gain D (N s/m)
};

/// Whether a parameter is a gain, P or D. The characteristic polynomial is affine in the gains;
/// each value of any other parameter needs a matrix exponential.
constexpr bool is_gain(LoopParameter parameter) {
  return parameter >= LoopParameter::proportional_gain;
}

/// Reference to the value of a parameter in a loop, to read or to change it.
inline double& value_of(OperatingPoint& point, LoopParameter parameter) {
  auto& [plant, sampling, gains] = point;
  double* const all[] = {&plant.conductor_mass,     &plant.conductor_stiffness,
                         &plant.conductor_damping,  &plant.absorber_mass,
                         &plant.absorber_stiffness, &plant.absorber_damping,
                         &sampling.period,          &sampling.processing_delay,
                         &gains.proportional,       &gains.differential};
  return *all[static_cast<int>(parameter)];
}

/// Sets a parameter of a loop to a value in SI units. A new period τ also scales the delay δ: the
/// ratio δ/τ stays the same. If δ = τ before, both get exactly the same value.
inline void set(OperatingPoint& point, LoopParameter parameter, double value) {
  if (parameter == LoopParameter::sampling_period) {
    const double fraction = point.sampling.processing_delay / point.sampling.period;
    point.sampling.processing_delay = fraction == 1.0 ? value : fraction * value;
  }
  value_of(point, parameter) = value;
}

/// An axis of a chart: a parameter of the loop and the values that it takes.
struct LoopAxis {
  LoopParameter parameter;  ///< parameter that varies
  Axis values;              ///< values of the parameter, in its SI unit
};

/// Defines a chart over any two parameters of a sampled loop, with one loop for each cell.
struct LoopChart {
  /// Loop with all fixed parameters. If δ is on no axis, all cells have the ratio δ/τ of this loop.
  OperatingPoint point;
  LoopAxis slow;  ///< axis with one value for each row
  LoopAxis fast;  ///< axis with one value for each column

  /// The loop of row `index` ≥ 0, in which the parameter of the axis `fast` is as in `point`.
  OperatingPoint row(std::int64_t index) const {
    OperatingPoint result = point;
    set(result, slow.parameter, slow.values.at(index));
    return result;
  }

  /// The loop of the cell in the given row and column, both counted from 0.
  OperatingPoint cell(std::int64_t row_index, std::int64_t column) const {
    OperatingPoint result = row(row_index);
    set(result, fast.parameter, fast.values.at(column));
    // A δ on the axis `slow` keeps its given value although setting τ scales δ.
    if (slow.parameter == LoopParameter::processing_delay)
      set(result, slow.parameter, slow.values.at(row_index));
    return result;
  }
};

/// Validates a chart. @throws InvalidParameter where both axes vary the same parameter, an axis has
/// max < min or no value, or a corner of the chart is not an admissible loop
inline void validate(const LoopChart& chart) {
  if (chart.slow.parameter == chart.fast.parameter) {
    throw InvalidParameter("difference between the axes' parameters", 0.0, "",
                           "non-zero (choose two different parameters)");
  }
  validate(chart.slow.values, "value along the first axis", "");
  validate(chart.fast.values, "value along the second axis", "");
  for (const std::int64_t row : {std::int64_t{0}, chart.slow.values.count - 1}) {
    for (const std::int64_t column : {std::int64_t{0}, chart.fast.values.count - 1}) {
      const OperatingPoint corner = chart.cell(row, column);
      validate(corner.plant);
      validate(corner.sampling);
      validate(corner.gains);
    }
  }
}

/// Polynomial whose coefficients are affine in one gain x (P or D): constant + x · slope.
template <int Degree>
struct AffineLine {
  Polynomial<double, Degree> constant;  ///< polynomial at x = 0, constant coefficient first
  Polynomial<double, Degree> slope;     ///< derivative by x, per N/m of P or per N s/m of D
};

/// The characteristic polynomial as a function of one gain only.
/// @param gain        gain that varies, `proportional_gain` or `differential_gain`
/// @param polynomial  polynomial affine in both gains
/// @param gains       values of the gains; that of the varying gain is not used
template <int Degree, PolynomialVariable Variable>
AffineLine<Degree> along(LoopParameter gain,
                         const AffinePolynomial<double, Degree, Variable>& polynomial,
                         const PdGains<double>& gains) {
  if (gain == LoopParameter::proportional_gain) {
    return {polynomial.base + gains.differential * polynomial.differential,
            polynomial.proportional};
  }
  return {polynomial.base + gains.proportional * polynomial.proportional, polynomial.differential};
}

/// Computes the characteristic polynomials of a chart's cells with few matrix exponentials: one if
/// both axes are gains, one per row or column if one axis is a gain, otherwise one per cell.
template <int Degree, PolynomialVariable Variable>
class ChartPolynomials {
 public:
  /// Type of the characteristic polynomial, affine in P and D.
  using Affine = AffinePolynomial<double, Degree, Variable>;
  /// Function that computes the characteristic polynomial of a loop, affine in P and D.
  using PolynomialOf = Affine (*)(const OperatingPoint&);

  /// Matrix of the polynomials of a chart's row: one for each cell, constant coefficient first.
  using Table = Eigen::Matrix<double, Eigen::Dynamic, Degree + 1>;

  /// @param chart          the chart; a copy is stored
  /// @param polynomial_of  function that computes the characteristic polynomial of a loop, for
  ///                       example `StabilityChartRows::polynomial_of`
  /// @throws InvalidParameter where the chart is not admissible
  ChartPolynomials(const LoopChart& chart, PolynomialOf polynomial_of)
      : chart_(chart), polynomial_of_(polynomial_of) {
    validate(chart);
    if (is_gain(chart.slow.parameter) && is_gain(chart.fast.parameter)) {
      common_ = polynomial_of_(chart.point);
    } else if (is_gain(chart.slow.parameter)) {
      column_constants_.resize(columns(), Degree + 1);
      column_slopes_.resize(columns(), Degree + 1);
      for (std::int64_t column = 0; column < columns(); ++column) {
        const OperatingPoint point = chart.cell(0, column);
        const auto line = along(chart.slow.parameter, polynomial_of(point), point.gains);
        column_constants_.row(column) = line.constant;
        column_slopes_.row(column) = line.slope;
      }
    }
  }

  /// The number of cells in a row, one for each value of the axis `fast`.
  std::int64_t columns() const { return chart_.fast.values.count; }
  /// The chart whose polynomials are computed.
  const LoopChart& chart() const { return chart_; }

  /// The polynomial of all cells, affine in P and D; defined only if both axes are gains.
  const Affine& common() const { return common_; }

  /// Whether the axis `fast` is a gain. If so, `line` gives a row's polynomials, otherwise `table`.
  bool affine_along_rows() const { return is_gain(chart_.fast.parameter); }

  /// The polynomials of a row as a function of the gain on `fast`; only if `affine_along_rows()`.
  AffineLine<Degree> line(std::int64_t row) const {
    const OperatingPoint point = chart_.row(row);
    return along(chart_.fast.parameter,
                 is_gain(chart_.slow.parameter) ? common_ : polynomial_of_(point), point.gains);
  }

  /// The polynomials of the cells of a row as a matrix; only if the axis `fast` is not a gain.
  Table table(std::int64_t row) const {
    if (is_gain(chart_.slow.parameter)) {
      return column_constants_ + chart_.slow.values.at(row) * column_slopes_;
    }
    Table result(columns(), Degree + 1);
    for (std::int64_t column = 0; column < columns(); ++column) {
      const OperatingPoint point = chart_.cell(row, column);
      result.row(column) = polynomial_of_(point).at(point.gains);
    }
    return result;
  }

 private:
  LoopChart chart_;
  PolynomialOf polynomial_of_;
  Affine common_;
  Table column_constants_, column_slopes_;
};

}  // namespace holdfast
