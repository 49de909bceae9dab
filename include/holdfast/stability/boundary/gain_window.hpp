#pragma once

#include "holdfast/control/gains.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/stability/boundary/boundary_point.hpp"

namespace holdfast {

/// A range of differential gains, N s/m.
struct DifferentialRange {
  double lower;  ///< D (N s/m), finite
  double upper;  ///< D (N s/m), finite, > lower
};

/// A rectangle of the gain plane, its edges included.
struct GainWindow {
  ProportionalRange proportional;  ///< P (N/m)
  DifferentialRange differential;  ///< D (N s/m)

  /// Extent in P (N/m).
  double width() const { return proportional.upper - proportional.lower; }
  /// Extent in D (N s/m).
  double height() const { return differential.upper - differential.lower; }

  /// N²s/m².
  double area() const { return width() * height(); }

  /// True within the edges or on them; 10⁻¹² of the size is granted to round-off.
  template <class Scalar>
  bool contains(const PdGains<Scalar>& gains) const {
    const Scalar p_slack(1e-12 * width()), d_slack(1e-12 * height());
    return gains.proportional >= Scalar(proportional.lower) - p_slack &&
           gains.proportional <= Scalar(proportional.upper) + p_slack &&
           gains.differential >= Scalar(differential.lower) - d_slack &&
           gains.differential <= Scalar(differential.upper) + d_slack;
  }
};

/// @throws InvalidParameter unless lower < upper in both ranges, all finite
inline void validate(const GainWindow& window) {
  validate(window.proportional);
  require_finite("lower end of the differential gains", window.differential.lower, "N s/m");
  require_positive("width of the range of differential gains", window.height(), "N s/m");
}

}  // namespace holdfast
