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

/// Everything that decides the stability of a sampled loop.
struct OperatingPoint {
  TwoMass<double> plant;      ///< m (kg), k (N/m) and c (N s/m) of both masses
  Sampling<double> sampling;  ///< τ (s) and δ (s)
  PdGains<double> gains;      ///< P (N/m) and D (N s/m)
};

/// One number of a loop: what an axis of a chart varies, or by what a sensitivity is taken.
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

/// True for P and D, in which the characteristic polynomial is affine; any other parameter needs a
/// matrix exponential for each of its values.
constexpr bool is_gain(LoopParameter parameter) {
  return parameter >= LoopParameter::proportional_gain;
}

/// The number of a loop that a parameter names.
inline double& value_of(OperatingPoint& point, LoopParameter parameter) {
  auto& [plant, sampling, gains] = point;
  double* const all[] = {&plant.conductor_mass,     &plant.conductor_stiffness,
                         &plant.conductor_damping,  &plant.absorber_mass,
                         &plant.absorber_stiffness, &plant.absorber_damping,
                         &sampling.period,          &sampling.processing_delay,
                         &gains.proportional,       &gains.differential};
  return *all[static_cast<int>(parameter)];
}

/// Gives a parameter a value; with τ the processing delay keeps its fraction of it, of which
/// rounding makes no more than a whole.
inline void set(OperatingPoint& point, LoopParameter parameter, double value) {
  if (parameter == LoopParameter::sampling_period) {
    const double fraction = point.sampling.processing_delay / point.sampling.period;
    point.sampling.processing_delay = fraction == 1.0 ? value : fraction * value;
  }
  value_of(point, parameter) = value;
}

/// An axis of a chart: a parameter of the loop and its values.
struct LoopAxis {
  LoopParameter parameter;  ///< the one that varies
  Axis values;              ///< in the SI unit of the parameter
};

/// A chart of the sampled loop over any two of its parameters; the others are those of the point.
struct LoopChart {
  /// The loop in which a cell replaces two values; where τ is replaced and δ is not, δ is scaled
  /// with it.
  OperatingPoint point;
  LoopAxis slow;  ///< one value a row
  LoopAxis fast;  ///< one value a column

  /// The loop of a row, with the fast parameter still that of the point.
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

/// @throws InvalidParameter where both axes vary the same parameter or one does not ascend, or a
/// corner of the chart is not an admissible loop
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
  Polynomial<double, Degree> constant;  ///< at x = 0, constant coefficient first
  Polynomial<double, Degree> slope;     ///< per unit of x, N/m of P or N s/m of D
};

/// The characteristic polynomial along one of the gains, the other being that of the point.
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

/// The characteristic polynomials of the cells of a chart, with as few matrix exponentials as its
/// axes allow: one in all where both axes are gains; one a row or one a column where one of them
/// is; one a cell where none is.
template <int Degree, PolynomialVariable Variable>
class ChartPolynomials {
 public:
  /// Characteristic polynomial at any gains, from which the chart is computed.
  using Affine = AffinePolynomial<double, Degree, Variable>;
  /// From a loop to it.
  using PolynomialOf = Affine (*)(const OperatingPoint&);

  /// Polynomials along a row, one coefficient after the other: columns × (Degree + 1).
  using Table = Eigen::Matrix<double, Eigen::Dynamic, Degree + 1>;

  /// @param chart          copied
  /// @param polynomial_of  that of `StabilityChartRows` or `RadiusChartRows`
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

  /// Cells of a row: values of the fast parameter.
  std::int64_t columns() const { return chart_.fast.values.count; }
  /// The two axes and the loop that they vary.
  const LoopChart& chart() const { return chart_; }

  /// The polynomial of all cells where both axes are gains.
  const Affine& common() const { return common_; }

  /// True where the polynomial is affine in the fast parameter: `line` then serves, else `table`.
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
