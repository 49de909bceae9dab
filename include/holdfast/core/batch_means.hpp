#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"

namespace holdfast {

/// The z with P(|Z| ≤ z) = confidence for a standard normal Z, by Newton's method.
/// @param confidence  0 < confidence ≤ 0.9999
/// @throws InvalidParameter for another confidence
inline double normal_quantile(double confidence) {
  require_within("confidence", confidence, "", 1e-9, 0.9999);
  double z = 0.0;
  // P is concave for z ≥ 0: from 0 the iterates rise towards the root and cannot pass it.
  for (int step = 0; step < 60; ++step) {
    const double missing = std::erfc(z / std::sqrt(2.0)) - (1.0 - confidence);
    z += missing * std::sqrt(pi<double> / 2.0) * std::exp(0.5 * z * z);
  }
  return z;
}

/// The t with P(|T| ≤ t) = confidence for Student's T of ν degrees of freedom: the expansion of
/// Abramowitz & Stegun 26.7.5 about the normal quantile. At 95 % it is right to 0.2 % from three
/// degrees of freedom on.
/// @param degrees_of_freedom  ν ≥ 3
/// @throws InvalidParameter for another confidence (see normal_quantile) or ν
inline double student_quantile(double confidence, double degrees_of_freedom) {
  require_within("degrees of freedom", degrees_of_freedom, "", 3.0, 1e15);
  const double x = normal_quantile(confidence), square = x * x, v = 1.0 / degrees_of_freedom;
  const double first = x * (square + 1) / 4;
  const double second = x * ((5 * square + 16) * square + 3) / 96;
  const double third = x * (((3 * square + 19) * square + 17) * square - 15) / 384;
  const double fourth =
      x * ((((79 * square + 776) * square + 1482) * square - 1920) * square - 945) / 92160;
  return x + v * (first + v * (second + v * (third + v * fourth)));
}

/// Mean of a long correlated series with its standard error, in constant memory.
///
/// The series is cut into equal batches; when all `Batches` are full, neighbours are merged and the
/// batch length doubles, so that between Batches/2 and Batches complete batches cover a
/// series of more than Batches values. The error is that of the mean of the batch means; it is
/// honest once a batch is longer than the correlation. Source: P. W. Glynn, D. L. Iglehart,
/// Simulation output analysis using standardized time series, 1990.
template <class Scalar, std::size_t Batches = 64>
class BatchMeans {
  static_assert(Batches % 2 == 0 && Batches >= 4, "batches are merged in pairs");

 public:
  void push(const Scalar& value) {
    open_sum_ += value;
    ++count_;
    if (++open_length_ == batch_length_) close_batch();
  }

  /// Number of values taken in.
  std::int64_t count() const { return count_; }

  /// Mean of all values; NaN before the first.
  Scalar mean() const {
    Scalar sum = open_sum_;
    for (std::size_t k = 0; k < complete_; ++k) sum += sums_[k];
    return sum / Scalar(static_cast<double>(count_));
  }

  /// Standard error of the mean from the complete batches; NaN while there are fewer than four.
  Scalar standard_error() const {
    if (complete_ < 4) return std::numeric_limits<Scalar>::quiet_NaN();
    const Scalar batches(static_cast<double>(complete_));
    const Scalar length(static_cast<double>(batch_length_));
    Scalar centre(0), spread(0);
    for (std::size_t k = 0; k < complete_; ++k) centre += sums_[k] / length;
    centre /= batches;
    for (std::size_t k = 0; k < complete_; ++k) {
      const Scalar deviation = sums_[k] / length - centre;
      spread += deviation * deviation;
    }
    return std::sqrt(spread / (batches * (batches - Scalar(1))));
  }

  /// Number of complete batches, which the standard error comes from.
  std::size_t batches() const { return complete_; }

  /// Half the width of the interval about the mean that covers the true mean with the given
  /// confidence: Student's quantile for one degree of freedom less than there are batches, times
  /// the standard error. NaN while there are fewer than four.
  /// @throws InvalidParameter unless 0 < confidence ≤ 0.9999
  Scalar half_width(double confidence) const {
    if (complete_ < 4) return std::numeric_limits<Scalar>::quiet_NaN();
    const double freedom = static_cast<double>(complete_ - 1);
    return Scalar(student_quantile(confidence, freedom)) * standard_error();
  }

 private:
  void close_batch() {
    sums_[complete_++] = open_sum_;
    open_sum_ = Scalar(0);
    open_length_ = 0;
    if (complete_ < Batches) return;
    for (std::size_t k = 0; k < Batches / 2; ++k) sums_[k] = sums_[2 * k] + sums_[2 * k + 1];
    complete_ = Batches / 2;
    batch_length_ *= 2;
  }

  std::array<Scalar, Batches> sums_{};
  Scalar open_sum_{0};
  std::size_t complete_ = 0;
  std::int64_t open_length_ = 0;
  std::int64_t batch_length_ = 1;
  std::int64_t count_ = 0;
};

}  // namespace holdfast
