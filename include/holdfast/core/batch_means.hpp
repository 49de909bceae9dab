#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace holdfast {

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
