#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "holdfast/core/types.hpp"
#include "holdfast/math/stats/batch_sums.hpp"

namespace holdfast {

/// The mean values of several time series after their initial transient, with standard errors.
template <int Series>
struct SettledMeans {
  Vector<double, Series> means;            ///< means over the averaged steps
  Vector<double, Series> standard_errors;  ///< standard errors; NaN with fewer than four batches
  std::int64_t steps;                      ///< number of averaged steps
  std::int64_t left_out;                   ///< number of steps left out at the start as transient
};

namespace detail {

template <int Series, std::size_t Batches>
class SettledBatches {
  using Means = Vector<double, Series>;

 public:
  explicit SettledBatches(const BatchSums<double, Series, Batches>& sums) : sums_(sums) {
    if (sums.complete_batches() < 8) return;
    while (from_ <= sums.complete_batches() / 4 && begins_otherwise())
      from_ = std::max<std::size_t>(1, 2 * from_);
  }

  SettledMeans<Series> means() const {
    const std::int64_t left_out = static_cast<std::int64_t>(from_) * sums_.batch_length();
    const std::int64_t steps = sums_.steps() - left_out;
    const Means found = sums_.totals(from_) / static_cast<double>(steps);
    return {found, errors(found, static_cast<double>(steps)), steps, left_out};
  }

 private:
  /// The mean per step over the batches first … last − 1.
  Means mean(std::size_t first, std::size_t last) const {
    return (sums_.totals(first) - sums_.totals(last)) /
           (static_cast<double>(last - first) * static_cast<double>(sums_.batch_length()));
  }

  /// The standard errors from batch `first` on: the larger estimate, from batches or from pairs.
  Means scatter(std::size_t first) const {
    const Means single = sums_.standard_errors(1, first);
    if (sums_.complete_batches() - first < 8) return single;
    return single.cwiseMax(sums_.standard_errors(2, first));
  }

  /// Whether the first series still has a transient: its mean over the next batches (as many as are
  /// left out, at least one) and its mean over all later batches differ by more than six standard
  /// errors, as estimated from the second half of all batches.
  bool begins_otherwise() const {
    const std::size_t all = sums_.complete_batches(), half = all / 2;
    const std::size_t next = std::max<std::size_t>(1, 2 * from_);
    const double shares =
        1.0 / static_cast<double>(next - from_) + 1.0 / static_cast<double>(all - next);
    const double difference = mean(from_, next)[0] - mean(next, all)[0];
    constexpr double rounding = 1e-13;
    return std::abs(difference) >
           6.0 * std::sqrt(static_cast<double>(all - half) * shares) * scatter(half)[0] + rounding;
  }

  /// The range max − min of s_n − n · mean at the batch ends; s_n: sum over the first n used steps.
  Means width(const Means& found) const {
    Means deviation = Means::Zero(found.size()), low = deviation, high = deviation;
    const double length = static_cast<double>(sums_.batch_length());
    for (std::size_t k = from_; k < sums_.complete_batches(); ++k) {
      deviation += sums_.batch(k) - length * found;
      low = low.cwiseMin(deviation);
      high = high.cwiseMax(deviation);
    }
    return high - low;
  }

  /// The difference (modulus) of two means: second quarter and second half of the used batches;
  /// or, if over a quarter is left out, later half of the omitted batches and all used batches.
  Means drift() const {
    const std::size_t all = sums_.complete_batches(), half = (from_ + all) / 2;
    if (from_ > all / 4) return (mean(from_ / 2, from_) - mean(from_, all)).cwiseAbs();
    return (mean(from_ + (all - from_) / 4, half) - mean(half, all)).cwiseAbs();
  }

  Means errors(const Means& found, double steps) const {
    const Means scattered = scatter(from_);
    if (sums_.complete_batches() < 4) return scattered;
    constexpr double share = 1.1 / 2.5758293035489;  // P(|Z| ≤ 2.57…) = 99 %
    return scattered.cwiseMax(share * (width(found) / steps).cwiseMax(drift()));
  }

  const BatchSums<double, Series, Batches>& sums_;
  std::size_t from_ = 0;  // number of batches left out at the start
};

}  // namespace detail

/// The mean values of several series without their transient, with standard errors.
///
/// The first b batches are left out as transient, b = 0, 1, 2, 4, … up to half of all. b is
/// increased until two means of the first series agree within six standard errors: the mean over
/// the next b batches (one if b = 0) and the mean over all later batches. With fewer than eight
/// batches b = 0. The standard error is the largest of three estimates for the remaining N steps:
///
/// - the standard error from batch means, or from means of pairs of batches if the latter is larger
/// - 0.43 R/N with the range R = max − min over n of (sum over the first n steps) − n · mean. It is
///   the largest of the three if the batch means hardly scatter, as for a periodic series
/// - 0.43 times the difference of two means, an estimate of a bias that decays like 1/N: over the
///   second quarter and the second half of the N steps; or, if b exceeds a quarter of all batches,
///   over the later half of the b batches and over all N steps
///
/// The factor 0.43 = 1.1/2.576 contains the two-sided 99 % quantile of the normal distribution.
/// @param sums  batch sums of the series, of one step or more
template <int Series, std::size_t Batches>
SettledMeans<Series> settled_means(const BatchSums<double, Series, Batches>& sums) {
  return detail::SettledBatches<Series, Batches>(sums).means();
}

}  // namespace holdfast
