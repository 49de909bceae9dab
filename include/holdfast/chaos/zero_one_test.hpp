#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"

namespace holdfast {

namespace detail {

/// The walk (p(n), q(n)) of the 0–1 test in the plane, with its mean-square displacement over n =
/// 1, 2, … steps. One object is used for all frequencies c, without further allocation.
class ZeroOneWalk {
 public:
  /// @param centred  the series without its mean
  explicit ZeroOneWalk(const std::vector<double>& centred)
      : centred_(centred),
        lags_(std::min(centred.size() / 10, most_lags)),
        horizontal_(centred.size() + 1, 0.0),
        vertical_(centred.size() + 1, 0.0),
        displacement_(lags_, 0.0) {}

  /// The correlation K_c of the mean-square displacement with the lag, for c = `frequency`.
  double correlation(double frequency) {
    walk(frequency);
    std::fill(displacement_.begin(), displacement_.end(), 0.0);
    const std::size_t available = centred_.size() - lags_ + 1;
    const std::size_t starts = std::min(available, most_starts);
    for (std::size_t k = 0; k < starts; ++k) add_displacements(k * available / starts);
    return correlation_with_lag();
  }

 private:
  static constexpr std::size_t most_lags = 500, most_starts = 5000;

  void walk(double frequency) {
    for (std::size_t j = 0; j < centred_.size(); ++j) {
      const double angle = frequency * static_cast<double>(j + 1);
      horizontal_[j + 1] = horizontal_[j] + centred_[j] * std::cos(angle);
      vertical_[j + 1] = vertical_[j] + centred_[j] * std::sin(angle);
    }
  }

  void add_displacements(std::size_t start) {
    const double x = horizontal_[start], y = vertical_[start];
    const double* later_x = horizontal_.data() + start + 1;
    const double* later_y = vertical_.data() + start + 1;
    double* displacement = displacement_.data();
    for (std::size_t n = 0; n < lags_; ++n) {
      const double dx = later_x[n] - x, dy = later_y[n] - y;
      displacement[n] += dx * dx + dy * dy;
    }
  }

  double correlation_with_lag() const {
    const double count = static_cast<double>(lags_), middle = 0.5 * (count - 1.0);
    double mean = 0.0, spread = 0.0, product = 0.0;
    for (const double value : displacement_) mean += value / count;
    for (std::size_t n = 0; n < lags_; ++n) {
      const double deviation = displacement_[n] - mean;
      spread += deviation * deviation;
      product += deviation * (static_cast<double>(n) - middle);
    }
    const double lag_spread = count * (count * count - 1.0) / 12.0;
    return spread > 0.0 ? product / std::sqrt(spread * lag_spread) : 0.0;
  }

  const std::vector<double>& centred_;
  std::size_t lags_;
  std::vector<double> horizontal_, vertical_;
  std::vector<double> displacement_;
};

/// The series minus its mean, divided by its extent; empty where it is constant to round-off.
inline std::vector<double> without_mean(std::vector<double> series) {
  double mean = 0.0, largest = 0.0;
  const auto [low, high] = std::minmax_element(series.begin(), series.end());
  const double extent = *high - *low;
  for (const double value : series) {
    mean += value / static_cast<double>(series.size());
    largest = std::max(largest, std::abs(value));
  }
  if (extent <= 64.0 * std::numeric_limits<double>::epsilon() * largest) return {};
  for (double& value : series) value = (value - mean) / extent;
  return series;
}

/// The median of sorted values, for an even number the mean of the two in the middle.
inline double median_of_sorted(const std::vector<double>& sorted) {
  const double place = 0.5 * static_cast<double>(sorted.size() - 1);
  const std::size_t below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (place - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

}  // namespace detail

/// Computes the result K of the 0–1 test for chaos of a series φ₁ … φ_N; needs no embedding.
///
///     p(n) = Σ_{j≤n} φ_j cos jc,   q(n) = Σ_{j≤n} φ_j sin jc
///     D(n) = mean_j [(p(j+n) − p(j))² + (q(j+n) − q(j))²]
///     K_c  = correlation of D(n) with n,   n = 1 … min(N/10, 500);   K = median of K_c over c
///
/// D stays bounded for a regular series and grows like n for a chaotic one. The mean of φ is
/// subtracted first, since it would add an oscillating term to D. Shifting or scaling φ does not
/// change K. The frequencies c = π/5 + (3π/5) {k g} (rad per sample), k = 1, 2, …, are evenly
/// spread and equal in every run; {·} is the fractional part, 1/g the real root of x³ = x + 1. If c
/// is a frequency of the series, K_c is 1 even without chaos; the median ignores these few c.
///
/// K is near 0 for any motion, even a chaotic one, that is sampled much faster than it varies. The
/// test is unreliable for fewer than about 500 samples of a motion with several frequencies. A
/// constant series has K = 0. Work for each c: a cosine and a sine per sample, and displacements
/// over at most 500 lags n from at most 5000 evenly spaced j.
/// Source: G. A. Gottwald, I. Melbourne, SIAM J. Appl. Dyn. Syst. 8 (2009), 129–145.
/// @return K, near 0 for a regular motion, near 1 for a chaotic one
/// @param series       200 … 100 000 finite values
/// @param frequencies  number of frequencies c, 1 … 1000
/// @throws InvalidParameter for a number of samples or frequencies out of range, or a value that is
/// not finite
/// @tparam Series  std::vector<double>
template <class Series = std::vector<double>>
double zero_one_test(const Series& series, int frequencies = 100) {
  require_within("number of samples", static_cast<double>(series.size()), "", 200.0, 1e5);
  require_within("number of frequencies", frequencies, "", 1.0, 1000.0);
  for (const double value : series) require_finite("value of the series", value, "");
  const std::vector<double> centred = detail::without_mean(series);
  if (centred.empty()) return 0.0;

  detail::ZeroOneWalk walk(centred);
  std::vector<double> correlations(static_cast<std::size_t>(frequencies));
  for (std::size_t k = 0; k < correlations.size(); ++k) {
    const double turns = 0.7548776662466927 * static_cast<double>(k + 1);
    const double frequency = pi<double> * (0.2 + 0.6 * (turns - std::floor(turns)));
    correlations[k] = walk.correlation(frequency);
  }
  std::sort(correlations.begin(), correlations.end());
  return detail::median_of_sorted(correlations);
}

}  // namespace holdfast
