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

/// All parameters of a sampled loop that its stability depends on.
struct OperatingPoint {
  TwoMass<double> plant;      ///< m (kg), k (N/m) and c (N s/m) of both masses
  Sampling<double> sampling;  ///< τ (s) and δ (s)
  PdGains<double> gains;      ///< P (N/m) and D (N s/m)
};

/// One parameter of a loop: varied along an axis of a chart, or the variable of a sensitivity.
enum class LoopParameter {
  conductor_mass,       ///< m₁ (kg), > 0
  conductor_stiffness,  ///< k₁ (N/m), > 0
  conductor_damping,    ///< c₁ (N s/m), ≥ 0
  absorber_mass,        ///< m₂ (kg), > 0
  absorber_stiffness,   ///< k₂ (N/m), > 0
  absorber_damping,     ///< c₂ (N s/m), ≥ 0
  sampling_period,      ///< τ (s), > 0
  processing_delay,     ///< δ (s), 0 … τ
  proportional_gain,    ///< P (N/m)
  differential_gain,    ///< D (N s/m)
};

/// Whether a parameter is P or D, in which the characteristic polynomial is affine; any other one
/// needs a matrix exponential for each of its values.
constexpr bool is_gain(LoopParameter parameter) {
  return parameter >= LoopParameter::proportional_gain;
}

/// The value of a parameter of a loop, by reference.
inline double& value_of(OperatingPoint& point, LoopParameter parameter) {
  auto& [plant, sampling, gains] = point;
  double* const all[] = {&plant.conductor_mass,     &plant.conductor_stiffness,
                         &plant.conductor_damping,  &plant.absorber_mass,
                         &plant.absorber_stiffness, &plant.absorber_damping,
                         &sampling.period,          &sampling.processing_delay,
                         &gains.proportional,       &gains.differential};
  return *all[static_cast<int>(parameter)];
}

/// Sets a parameter of a loop. Setting τ changes the processing delay δ in proportion, but does not
/// round δ to a value above τ.
inline void set(OperatingPoint& point, LoopParameter parameter, double value) {
  if (parameter == LoopParameter::sampling_period) {
    const double fraction = point.sampling.processing_delay / point.sampling.period;
    point.sampling.processing_delay = fraction == 1.0 ? value : fraction * value;
  }
  value_of(point, parameter) = value;
}

/// An axis of a chart: a parameter of the loop and its values.
struct LoopAxis {
  LoopParameter parameter;  ///< parameter that varies
  Axis values;              ///< values of the parameter, in its SI unit
};

/// A chart of the sampled loop over any two of its parameters; all others are those of `point`.
struct LoopChart {
  /// The loop whose two axis parameters are replaced in each cell. Where an axis replaces τ and
  /// none replaces δ, δ changes in proportion to τ.
  OperatingPoint point;
  LoopAxis slow;  ///< axis with one value for each row
  LoopAxis fast;  ///< axis with one value for each column

  /// The loop of a row, whose fast parameter keeps its value in `point`.
  OperatingPoint row(std::int64_t index) const {
    OperatingPoint result = point;
    set(result, slow.parameter, slow.values.at(index));
    return result;
  }

  /// The loop of a cell.
  OperatingPoint cell(std::int64_t row_index, std::int64_t column) const {
    OperatingPoint result = row(row_index);
    set(result, fast.parameter, fast.values.at(column));
    // A delay that the chart gives does not scale with the period that it gives as well.
    if (slow.parameter == LoopParameter::processing_delay)
      set(result, slow.parameter, slow.values.at(row_index));
    return result;
  }
};

/// Validates a chart. @throws InvalidParameter where both axes vary the same parameter, one does
/// not ascend, or a corner of the chart is not an admissible loop
inline void validate(const LoopChart& chart) {
  if (chart.slow.parameter == chart.fast.parameter) {
    throw InvalidParameter("second axis", 0.0, "", "another parameter than the first axis");
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

/// A polynomial that is affine in one gain x: constant + x · slope.
template <int Degree>
struct AffineLine {
  Polynomial<double, Degree> constant;  ///< polynomial at x = 0, constant coefficient first
  Polynomial<double, Degree> slope;     ///< change per unit of x, N/m of P or N s/m of D
};

/// The characteristic polynomial as a function of one gain, for the fixed value of the other.
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

/// The characteristic polynomials of the cells of a chart, with as few matrix exponentials as the
/// axes allow: one in all where both axes are gains; one per row or column where one axis is a
/// gain; one per cell where neither is.
template <int Degree, PolynomialVariable Variable>
class ChartPolynomials {
 public:
  /// The characteristic polynomial for any gains, from which the chart is computed.
  using Affine = AffinePolynomial<double, Degree, Variable>;
  /// A function that computes the characteristic polynomial of a loop.
  using PolynomialOf = Affine (*)(const OperatingPoint&);

  /// The polynomials of a row: columns × (Degree + 1), constant coefficients first.
  using Table = Eigen::Matrix<double, Eigen::Dynamic, Degree + 1>;

  /// @param chart          the chart, which is copied
  /// @param polynomial_of  `polynomial_of` of `StabilityChartRows` or `RadiusChartRows`
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

  /// The number of cells in a row: values of the fast parameter.
  std::int64_t columns() const { return chart_.fast.values.count; }
  /// The chart: its two axes and the loop that they vary.
  const LoopChart& chart() const { return chart_; }

  /// The polynomial that all cells share, affine in the gains; only for charts over two gains.
  const Affine& common() const { return common_; }

  /// Whether the polynomial is affine in the fast parameter; if so, use `line`, otherwise `table`.
  bool affine_along_rows() const { return is_gain(chart_.fast.parameter); }

  /// The polynomials of a row as a function of the fast gain.
  AffineLine<Degree> line(std::int64_t row) const {
    const OperatingPoint point = chart_.row(row);
    return along(chart_.fast.parameter,
                 is_gain(chart_.slow.parameter) ? common_ : polynomial_of_(point), point.gains);
  }

  /// The polynomials of every cell of a row.
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
