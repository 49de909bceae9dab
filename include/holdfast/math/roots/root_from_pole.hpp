#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include "holdfast/core/compiler.hpp"

namespace holdfast {

/// The root s of 1 − ε g(s) = 0 at ε = 1, found by continuation in ε from the pole s = p of g at
/// ε = 0. For example, p is an eigenvalue of a structure without a device, and s the eigenvalue
/// after a device with the loop gain g is added.
///
/// Euler's predictor and the secant method solve 1/g(s) = ε; 1/g is smooth at the pole. ε moves
/// from 0 to 1 slightly off the real axis to keep conjugate roots apart. Steps are shortened where
/// the root's path bends. If the root is less than 10⁻⁷ |p| from the pole, g is
/// replaced by r/(s − p) + b with constants r and b. Where two roots meet, either may be followed.
/// @param loop_gain  complex function g of a complex number, evaluated some hundred times
/// @param pole       simple pole p ≠ 0 of g, exact to round-off
/// @return root s at ε = 1, not verified; NaN if 1000 steps do not suffice
template <class LoopGain>
std::complex<double> root_from_pole(const LoopGain& loop_gain, const std::complex<double>& pole) {
  using Complex = std::complex<double>;
  const double close = 1e-9 * std::abs(pole);
  const Complex here = loop_gain(pole + close), beside = loop_gain(pole + 2.0 * close);
  // g = r/(s − p) + b nearby.
  const Complex residue = 2.0 * close * (here - beside);
  const Complex moved = residue / (1.0 - (here - residue / close));
  if (!(std::abs(moved) > 100.0 * close)) return pole + moved;

  const auto strength = [&](const Complex& s) { return 1.0 / loop_gain(s); };
  const auto on_path = [](double t) { return Complex(t, 0.05 * t * (1.0 - t)); };
  Complex root = pole, slope = 1.0 / residue;
  double done = 0.0, step = 1.0 / 64.0;
  for (int steps = 0; steps < 1000; ++steps) {
    const double next = std::min(1.0, done + step);
    Complex before = root, at_before = on_path(done);
    const Complex expected = root + (on_path(next) - at_before) / slope;
    const double way = std::abs(expected - root);
    Complex s = expected;
    bool settled = false;
    for (int turn = 0; turn < 8 && !settled; ++turn) {
      const Complex at_s = strength(s), secant = (at_s - at_before) / (s - before);
      before = s;
      at_before = at_s;
      s += (on_path(next) - at_s) / (std::isfinite(std::abs(secant)) ? secant : slope);
      const double enough = next < 1.0 ? 1e-3 : 1e-9;  // the next correction would be far smaller
      settled = std::abs(s - before) <= 1e-12 * std::abs(s) + enough * way;
    }
    if (!settled || !(std::abs(s - expected) <= 0.1 * way)) {
      step /= 3.0;
      continue;
    }
    root = s;
    done = next;
    if (done == 1.0) return root;
    slope = (strength(root + close) - strength(root)) / close;
    step = std::min(2.0 * step, 1.0 / 8.0);
  }
  return {std::numeric_limits<double>::quiet_NaN(), 0.0};
}

}  // namespace holdfast
