#pragma once

#include "support/testing.hpp"

namespace holdfast::test {

/// Random numbers that are the same with every standard library: the engine's raw bits are fixed by
/// the standard, the distributions are not, so they are made here.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /// Uniform in [0, 1), 53 bits.
  double unit() { return static_cast<double>(engine_() >> 11U) * 0x1.0p-53; }

  double uniform(double lower, double upper) { return lower + (upper - lower) * unit(); }

  /// Uniform in the logarithm; 0 < lower < upper.
  double log_uniform(double lower, double upper) {
    return lower * std::exp(unit() * std::log(upper / lower));
  }

  double sign() { return (engine_() >> 63U) != 0 ? 1.0 : -1.0; }

  /// 0 … count − 1.
  std::size_t index(std::size_t count) {
    return static_cast<std::size_t>(unit() * static_cast<double>(count));
  }

  /// Standard normal (Box–Muller).
  double normal() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - unit()));
    return radius * std::cos(6.283185307179586 * unit());
  }

  /// A matrix (fixed-size Eigen type) with entries uniform in (−1, 1).
  template <class Matrix>
  Matrix matrix() {
    Matrix result;
    for (auto& entry : result.reshaped()) entry = typename Matrix::Scalar(uniform(-1.0, 1.0));
    return result;
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace holdfast::test
