#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>
#include <vector>

#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"

namespace holdfast {

/// The impedance of a device measured on a shaker: force over velocity of its clamp at ascending
/// frequencies.
///
/// Real and imaginary part are interpolated linearly: if no row supplies power, no value between
/// two rows does. Outside the measured range the result is NaN.
class MeasuredImpedance {
 public:
  /// A row of the measurement.
  struct Row {
    double angular_frequency;        ///< angular frequency ω (rad/s), > 0
    std::complex<double> impedance;  ///< impedance Z (N s/m), Re Z ≥ 0
  };

  /// @param rows  at least two rows with ascending ω
  /// @throws InvalidParameter for one row or none, ω not ascending, Re Z < 0, or values not finite
  explicit MeasuredImpedance(std::vector<Row> rows) : rows_(std::move(rows)) {
    require_within("rows of a measured impedance", static_cast<double>(rows_.size()), "", 2, 1e7);
    double before = 0.0;
    for (const Row& row : rows_) {
      require_finite("measured impedance", std::abs(row.impedance), "N s/m");
      if (!(std::isfinite(row.angular_frequency) && row.angular_frequency > before))
        throw InvalidParameter("angular frequency of a measured impedance", row.angular_frequency,
                               "rad/s", "above that of the row before");
      if (!(row.impedance.real() >= -giving * std::abs(row.impedance)))
        throw InvalidParameter("real part of a measured impedance", row.impedance.real(), "N s/m",
                               ">= 0: a passive device gives no power");
      before = row.angular_frequency;
    }
  }

  /// The impedance Z at ω (rad/s); NaN outside the measured range.
  std::complex<double> at(double angular_frequency) const {
    const auto above = std::lower_bound(
        rows_.begin(), rows_.end(), angular_frequency,
        [](const Row& row, double omega) { return row.angular_frequency < omega; });
    if (above == rows_.end()) return {std::nan(""), std::nan("")};
    if (above->angular_frequency == angular_frequency) return above->impedance;
    if (above == rows_.begin()) return {std::nan(""), std::nan("")};
    const Row& below = *(above - 1);
    const double share = (angular_frequency - below.angular_frequency) /
                         (above->angular_frequency - below.angular_frequency);
    return below.impedance + share * (above->impedance - below.impedance);
  }

  double lowest() const { return rows_.front().angular_frequency; }  ///< ω (rad/s) of the first row
  double highest() const { return rows_.back().angular_frequency; }  ///< ω (rad/s) of the last row

 private:
  static constexpr double giving = 1e-9;  // of |Z|: the round-off of a phase of 90°

  std::vector<Row> rows_;
};

/// Impedance Z (N s/m) of a measured device at s = iω; at any other s the value for ω = |s|, an
/// approximation for modes that decay by a few per cent per cycle.
/// @return NaN outside the measured range
inline std::complex<double> impedance(const MeasuredImpedance& device,
                                      const std::complex<double>& s) {
  const std::complex<double> z = device.at(std::abs(s));
  return s.imag() < 0.0 ? std::conj(z) : z;
}

}  // namespace holdfast
