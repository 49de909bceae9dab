#pragma once

#include <cmath>

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
/// @param confidence          0 < confidence ≤ 0.9999
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

}  // namespace holdfast
