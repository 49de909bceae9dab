#pragma once

#include <cmath>
#include <cstddef>

#include "holdfast/core/compiler.hpp"

namespace holdfast {

/// The standard error of a proportion that is estimated from n independent draws:
///
///     √(s (1 − s)/(n + 2)),   s = (count + ½)/(n + 1)
///
/// It is the posterior standard deviation for Jeffreys's prior. For large n it tends to the usual
/// √(s (1 − s)/n); for count = 0 or count = n it remains positive. Source: L. D. Brown, T. T. Cai,
/// A. DasGupta, Interval estimation for a binomial proportion, Statistical Science 16 (2001).
/// @param count  number of draws with the property in question, 0 … n
/// @param all    number n of all draws
inline double share_error(std::size_t count, std::size_t all) {
  const auto n = static_cast<double>(all);
  const double share = (static_cast<double>(count) + 0.5) / (n + 1.0);
  return std::sqrt(share * (1.0 - share) / (n + 2.0));
}

}  // namespace holdfast
