#pragma once

#include <cmath>
#include <complex>

#include "holdfast/core/compiler.hpp"

namespace holdfast {

/// e^x − 1 of a complex number to full relative accuracy.
template <class Scalar>
std::complex<Scalar> complex_expm1(const std::complex<Scalar>& x) {
  const Scalar half_sine = std::sin(x.imag() / Scalar(2)), grown = std::expm1(x.real());
  return {grown * std::cos(x.imag()) - Scalar(2) * half_sine * half_sine,
          (grown + Scalar(1)) * std::sin(x.imag())};
}

/// e^{iθ} − 1 to full relative accuracy: how far a point of the unit circle is from 1.
/// @param angle  θ (rad)
template <class Scalar>
std::complex<Scalar> circle_increment(const Scalar& angle) {
  return complex_expm1(std::complex<Scalar>(0, angle));
}

/// ∫₀^t e^{s r} dr = (e^{st} − 1)/s, also near s = 0.
/// @param s  1/s
/// @param t  s
template <class Scalar>
std::complex<Scalar> exponential_integral(const std::complex<Scalar>& s, const Scalar& t) {
  return s == std::complex<Scalar>(0) ? std::complex<Scalar>(t) : complex_expm1(s * t) / s;
}

}  // namespace holdfast
