#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "holdfast/core/types.hpp"

namespace holdfast::detail {

/// The integrals of several functions over one interval, computed by the tanh–sinh rule:
///
///     x = middle + half · tanh(½π sinh t),   ∫ f dx = half Σ h f(x) ½π cosh t / cosh²(½π sinh t)
///
/// The integrands may have branch points of square-root type at the ends. The step h of t is halved
/// until no integral changes by more than the tolerance. If this fails, for instance with a branch
/// point close to the interval, the interval is halved. Source: H. Takahasi, M. Mori, Double
/// exponential formulas for numerical integration, 1974.
template <class Scalar, class Integrand>
class SlabQuadrature {
 public:
  using Values = std::vector<Scalar>;

  /// @param integrand  function x ↦ values of the integrands, the same number of them for every x
  /// @param tolerance  absolute tolerance of each integral, ≥ 0
  SlabQuadrature(Integrand integrand, const Scalar& tolerance)
      : integrand_(integrand), tolerance_(tolerance) {}

  Values integrate(const Scalar& lower, const Scalar& upper) const {
    return integrate(lower, upper, deepest_);
  }

 private:
  static constexpr int deepest_ = 8, finest_ = 6;

  Values integrate(const Scalar& lower, const Scalar& upper, int depth) const {
    const Scalar half = (upper - lower) / Scalar(2), middle = lower + half;
    Values sum = integrand_(middle);
    scale(sum, pi<Scalar> / Scalar(2));
    Scalar step(1);
    add_nodes(sum, lower, upper, step, step);
    Values coarse = sum;
    for (int level = 1; level <= finest_; ++level) {
      step /= Scalar(2);
      add_nodes(sum, lower, upper, step, Scalar(2) * step);
      Values fine = sum;
      scale(fine, half * step);
      if (level > 2 && change(coarse, fine) <= tolerance_) return fine;
      coarse = fine;
    }
    if (depth == 0 || !(lower < middle && middle < upper)) return coarse;
    Values result = integrate(lower, middle, depth - 1);
    add(result, integrate(middle, upper, depth - 1), Scalar(1));
    return result;
  }

  /// Adds the nodes t = ±first, ±(first + stride), … up to weights below round-off.
  void add_nodes(Values& sum, const Scalar& lower, const Scalar& upper, const Scalar& first,
                 const Scalar& stride) const {
    const Scalar half = (upper - lower) / Scalar(2);
    for (Scalar t = first; t < Scalar(3.8); t += stride) {
      const Scalar argument = pi<Scalar> / Scalar(2) * std::sinh(t);
      // 1 − tanh(a) = 2 / (1 + e^{2a}): the distance to the end without cancellation.
      const Scalar from_end = half * Scalar(2) / (Scalar(1) + std::exp(Scalar(2) * argument));
      const Scalar cosine = std::cosh(argument);
      const Scalar weight = pi<Scalar> / Scalar(2) * std::cosh(t) / (cosine * cosine);
      add(sum, integrand_(lower + from_end), weight);
      add(sum, integrand_(upper - from_end), weight);
    }
  }

  static void add(Values& sum, const Values& values, const Scalar& weight) {
    for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += weight * values[k];
  }

  static void scale(Values& values, const Scalar& factor) {
    for (Scalar& value : values) value *= factor;
  }

  static Scalar change(const Values& coarse, const Values& fine) {
    Scalar largest(0);
    for (std::size_t k = 0; k < fine.size(); ++k) {
      largest = std::max(largest, Scalar(std::abs(fine[k] - coarse[k])));
    }
    return largest;
  }

  Integrand integrand_;
  Scalar tolerance_;
};

}  // namespace holdfast::detail
