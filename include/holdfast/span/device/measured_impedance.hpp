#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>
#include <vector>

#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"

namespace holdfast {

/// A device's impedance measured on a shaker: force over clamp velocity at ascending frequencies.
///
/// Real and imaginary part of the impedance Z are interpolated linearly between rows. Each row must
/// have Re Z ≥ 0 up to round-off, as for a passive device. Outside the measured range Z is NaN.
class MeasuredImpedance {
 public:
  /// One row of the measured table: a frequency and the impedance at this frequency.
  struct Row {
    double angular_frequency;        ///< angular frequency ω (rad/s), > 0
    std::complex<double> impedance;  ///< impedance Z (N s/m), Re Z ≥ −10⁻⁹ |Z|
  };

  /// @param rows  2 … 10⁷ rows with strictly ascending ω
  /// @throws InvalidParameter for another number or order of rows, or a value out of range
  explicit MeasuredImpedance(std::vector<Row> rows) : rows_(std::move(rows)) {
    require_within("number of rows of a measured impedance", static_cast<double>(rows_.size()), "",
                   2, 1e7);
    double before = 0.0;
    for (const Row& row : rows_) {
      require_finite("measured impedance", std::abs(row.impedance), "N s/m");
      if (!(std::isfinite(row.angular_frequency) && row.angular_frequency > before))
        throw InvalidParameter("angular frequency of a measured impedance", row.angular_frequency,
                               "rad/s", "above the angular frequency of the previous row");
      if (!(row.impedance.real() >= -giving * std::abs(row.impedance)))
        throw InvalidParameter("real part of a measured impedance", row.impedance.real(), "N s/m",
                               ">= 0 in every row, as a passive device supplies no power");
      before = row.angular_frequency;
    }
  }

  /// The impedance Z (N s/m) at an angular frequency ω (rad/s); NaN outside the measured range.
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

/// The impedance Z(s) (N s/m) of a measured device, approximated by the measured value at ω = |s|.
/// This is exact for s = iω and acceptable for modes that decay by a few per cent per cycle.
/// @return Z, for Im s < 0 the complex conjugate of the measured value; NaN if |s| is out of range
inline std::complex<double> impedance(const MeasuredImpedance& device,
                                      const std::complex<double>& s) {
  const std::complex<double> z = device.at(std::abs(s));
  return s.imag() < 0.0 ? std::conj(z) : z;
}

}  // namespace holdfast
