#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "holdfast/core/types.hpp"

namespace holdfast {

/// The means and standard errors of several long correlated time series, found in constant memory.
///
/// The time steps are divided into batches of equal length; the last batch is open until complete.
/// When `Batches` are complete, they are merged in pairs. The errors are reliable once a batch is
/// longer than the correlation time. Source: P. W. Glynn, D. L. Iglehart, Simulation output
/// analysis using standardized time series, 1990.
/// @tparam Number   number type of the series and their sums
/// @tparam Series   number of series, or Eigen::Dynamic
/// @tparam Batches  number of complete batches at which pairs are merged, even, ≥ 4
template <class Number, int Series, std::size_t Batches = 64>
class BatchSums {
  static_assert(Batches % 2 == 0 && Batches >= 4, "Batches must be even and at least 4");

 public:
  using Sums = Vector<Number, Series>;  ///< one sum for each series

  /// Constructs empty sums. `first_length` is the number of steps in a batch before any merge, ≥ 1.
  /// The number of series is needed only if the template parameter `Series` is Eigen::Dynamic.
  explicit BatchSums(std::int64_t first_length = 1, Eigen::Index series = Series < 0 ? 0 : Series)
      : open_(Sums::Constant(series, Number(0))), length_(first_length) {
    sums_.fill(open_);
  }

  /// Adds the sum of each series over the next `steps` steps, 0 ≤ steps ≤ steps_left().
  void add(const Sums& sums, std::int64_t steps) {
    open_ += sums;
    open_steps_ += steps;
    if (open_steps_ == length_) close();
  }

  /// The number of steps added so far, including those of the open batch.
  std::int64_t steps() const {
    return static_cast<std::int64_t>(complete_) * length_ + open_steps_;
  }
  /// The number of steps until the open batch is complete, ≥ 1.
  std::int64_t steps_left() const { return length_ - open_steps_; }
  /// The number of complete batches, 0 … Batches − 1; a merge of pairs halves the number.
  std::size_t complete_batches() const { return complete_; }

  /// The present number of steps in a batch; a merge of pairs doubles it.
  std::int64_t batch_length() const { return length_; }
  /// The sum of each series over the steps of complete batch k, 0 ≤ k < complete_batches().
  const Sums& batch(std::size_t k) const { return sums_[k]; }

  /// The sum of each series over all steps except those of the first `first` complete batches.
  Sums totals(std::size_t first = 0) const {
    Sums total = open_;
    for (std::size_t k = first; k < complete_; ++k) total += sums_[k];
    return total;
  }

  /// The standard errors of the mean values of the series, estimated from the scatter of group
  /// means. A group is `merged` ≥ 1 successive complete batches; the first `first` are left out.
  /// @return one error for each series; NaN with fewer than four groups
  Sums standard_errors(std::size_t merged = 1, std::size_t first = 0) const {
    using std::sqrt;
    const std::size_t batches = (complete_ - first) / merged;
    if (batches < 4)
      return Sums::Constant(open_.size(), Number(std::numeric_limits<double>::quiet_NaN()));
    Sums centre = Sums::Constant(open_.size(), Number(0)), spread = centre;
    for (std::size_t k = 0; k < batches * merged; ++k) centre += sums_[first + k];
    const Number share(1.0 / static_cast<double>(batches));
    for (std::size_t k = 0; k < batches; ++k) {
      Sums deviation = -share * centre;
      for (std::size_t m = 0; m < merged; ++m) deviation += sums_[first + k * merged + m];
      spread += deviation.cwiseProduct(deviation);
    }
    const Number unit(1.0 / static_cast<double>(length_ * static_cast<std::int64_t>(merged)));
    const Number freedom(1.0 / static_cast<double>(batches * (batches - 1)));
    for (auto& entry : spread) entry = unit * sqrt(entry * freedom);
    return spread;
  }

 private:
  void close() {
    sums_[complete_++] = open_;
    open_ = Sums::Constant(open_.size(), Number(0));
    open_steps_ = 0;
    if (complete_ < Batches) return;
    for (std::size_t k = 0; k < Batches / 2; ++k) sums_[k] = sums_[2 * k] + sums_[2 * k + 1];
    complete_ = Batches / 2;
    length_ *= 2;
  }

  std::array<Sums, Batches> sums_;
  Sums open_;
  std::size_t complete_ = 0;
  std::int64_t open_steps_ = 0;
  std::int64_t length_;
};

}  // namespace holdfast
