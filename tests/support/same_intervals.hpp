#pragma once

#include <cmath>
#include <vector>

#include "holdfast/core/interval.hpp"
#include "support/testing.hpp"

namespace holdfast::test {

/// Intervals that two ways find are the same; one more or less only where round-off can hardly see
/// it.
/// @param tolerance  of an end, as a share of the two ends' size
/// @return how many were compared
inline int expect_same_intervals(const std::vector<Interval<double>>& found,
                                 const std::vector<Interval<double>>& expected, double tolerance) {
  const auto reach = [](const std::vector<Interval<double>>& intervals) {
    double sum = 0.0;
    for (const Interval<double>& interval : intervals)
      if (std::isfinite(interval.upper - interval.lower)) sum += interval.upper - interval.lower;
    return sum;
  };
  if (found.size() != expected.size()) {
    EXPECT_NEAR(reach(found), reach(expected), 1e-6 * reach(expected));
    return 0;
  }
  for (std::size_t k = 0; k < found.size(); ++k) {
    const double size = std::abs(expected[k].lower) + std::abs(expected[k].upper);
    EXPECT_NEAR(found[k].lower, expected[k].lower, tolerance * size);
    EXPECT_NEAR(found[k].upper, expected[k].upper, tolerance * size);
  }
  return static_cast<int>(found.size());
}

}  // namespace holdfast::test
