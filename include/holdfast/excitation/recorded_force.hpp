#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "holdfast/core/errors.hpp"

namespace holdfast {

/// The kinds of interpolation of a recorded force between its rows.
enum class RecordInterpolation : std::uint8_t {
  linear,  ///< linear interpolation between the two rows
  held     ///< constant: the force of the earlier row
};

/// The straight line value + slope (t − t₀) that a force F(t) follows from an instant t₀ on.
struct LinearPiece {
  double value;  ///< force at t₀ (N)
  double slope;  ///< slope dF/dt (N/s)
};

/// A force given by rows (t_k, F_k), k = 0 … n − 1, and zero before and after these times:
///
///     linear:  F(t) = F_k + (F_{k+1} − F_k) (t − t_k)/(t_{k+1} − t_k)
///     held:    F(t) = F_k                                for t_k ≤ t < t_{k+1}, k ≤ n − 2
///
/// F is continuous from the right and zero at t_{n−1}. With `linear`, F_{n−1} is thus only
/// the limit that F approaches for t → t_{n−1}. With `held`, F_{n−1} is not used: the last row
/// only ends the interval before it.
///
/// Work of each evaluation: a binary search over the rows.
class RecordedForce {
 public:
  /// @param times          times t_k (s), two or more, strictly increasing
  /// @param forces         forces F_k (N), one for each time
  /// @param interpolation  interpolation between the rows
  /// @throws InvalidParameter for fewer than two rows, unequal numbers of times and forces, values
  ///         that are not finite, times that do not increase, and where a duration or a
  ///         slope between rows is not finite
  RecordedForce(std::vector<double> times, std::vector<double> forces,
                RecordInterpolation interpolation)
      : times_(std::move(times)), forces_(std::move(forces)), interpolation_(interpolation) {
    check_sizes();
    for (std::size_t row = 0; row < times_.size(); ++row) check_row(row);
    require_finite("duration of the recorded force", last_time() - first_time(), "s");
    if (interpolation_ == RecordInterpolation::held) return;
    for (std::size_t row = 0; row + 1 < times_.size(); ++row) {
      require_finite("slope of the recorded force", slope_after(row), "N/s");
    }
  }

  /// The first time t_0 (s).
  double first_time() const { return times_.front(); }
  /// The last time t_{n−1} (s).
  double last_time() const { return times_.back(); }
  /// The interpolation between the rows.
  RecordInterpolation interpolation() const { return interpolation_; }
  /// The times t_k (s), strictly increasing.
  const std::vector<double>& times() const { return times_; }
  /// The forces F_k (N), as many as there are times.
  const std::vector<double>& forces() const { return forces_; }

  /// The force F (N) at a time (s).
  double at(double time) const { return piece(time).value; }

  /// The line that the force follows from t₀ = `time` (s) up to `next_break(time)`.
  LinearPiece piece(double time) const {
    const std::size_t after = first_row_after(time);
    if (after == 0 || after == times_.size()) return {0.0, 0.0};
    const std::size_t row = after - 1;
    if (interpolation_ == RecordInterpolation::held) return {forces_[row], 0.0};
    const double slope = slope_after(row);
    return {forces_[row] + slope * (time - times_[row]), slope};
  }

  /// The first instant (s) after `time` at which F may jump or kink: the time of the next row, even
  /// if F is smooth there; +∞ at and after the last row.
  double next_break(double time) const {
    const std::size_t after = first_row_after(time);
    return after == times_.size() ? std::numeric_limits<double>::infinity() : times_[after];
  }

 private:
  std::size_t first_row_after(double time) const {
    const auto after = std::upper_bound(times_.begin(), times_.end(), time);
    return static_cast<std::size_t>(after - times_.begin());
  }

  double slope_after(std::size_t row) const {
    return (forces_[row + 1] - forces_[row]) / (times_[row + 1] - times_[row]);
  }

  void check_sizes() const {
    const auto rows = static_cast<double>(times_.size());
    if (times_.size() < 2) {
      throw InvalidParameter("rows of the recorded force", rows, "", ">= 2");
    }
    if (forces_.size() != times_.size()) {
      throw InvalidParameter("number of recorded forces", static_cast<double>(forces_.size()), "",
                             "equal to the number of instants");
    }
  }

  void check_row(std::size_t row) const {
    require_finite("time of the recorded force", times_[row], "s");
    require_finite("recorded force", forces_[row], "N");
    if (row > 0 && !(times_[row] > times_[row - 1])) {
      throw InvalidParameter("time of the recorded force", times_[row], "s",
                             "later than the time of the row before");
    }
  }

  std::vector<double> times_;
  std::vector<double> forces_;
  RecordInterpolation interpolation_;
};

}  // namespace holdfast
