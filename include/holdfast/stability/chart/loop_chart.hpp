#pragma once

#include "holdfast/core/axis.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/stability/chart/operating_point.hpp"
#include "holdfast/stability/polynomial/affine_polynomial.hpp"
#include "holdfast/stability/polynomial/characteristic_polynomial.hpp"

namespace holdfast {

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

/// @throws InvalidParameter where both axes vary the same parameter, or a corner of the chart is
/// not an admissible loop
inline void validate(const LoopChart& chart) {
  if (chart.slow.parameter == chart.fast.parameter) {
    throw InvalidParameter("second axis", 0.0, "", "another parameter than the first axis");
  }
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
template <int Degree>
AffineLine<Degree> along(LoopParameter gain, const AffinePolynomial<double, Degree>& polynomial,
                         const PdGains<double>& gains) {
  if (gain == LoopParameter::proportional_gain) {
    return {polynomial.base + gains.differential * polynomial.differential,
            polynomial.proportional};
  }
  return {polynomial.base + gains.proportional * polynomial.proportional, polynomial.differential};
}

/// The characteristic polynomial of a point's loop in powers of λ − 1, for any gains.
template <class Scalar = double>
AffinePolynomial<Scalar, 5> characteristic_polynomial(const OperatingPoint& point) {
  return characteristic_polynomial(sampled_loop(point.plant, point.sampling));
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template AffinePolynomial<double, 5> characteristic_polynomial(const OperatingPoint&);
#endif

}  // namespace holdfast
