#pragma once

#include <cmath>
#include <limits>

#include "holdfast/core/compiler.hpp"

namespace holdfast {

/// A sensor's reading: the multiple of its quantum nearest to the value (a mid-tread quantiser).
///
///     ẑ = q · round(z / q),   |ẑ − z| ≤ q / 2 up to round-off;   q = 0: ẑ = z
///
/// A value halfway between two multiples is rounded to the even multiple (in the processor's
/// default rounding mode). The function is odd and idempotent. For |z / q| ≥ 2⁵¹ in double
/// precision, q is close to the spacing of the floating-point numbers at z, and ẑ = z.
///
/// Where z spreads over more than a quantum, ẑ − z acts like noise uniform over ±q / 2: mean 0,
/// variance q² / 12. In a loop that is unstable without control the rounding causes small
/// chaotic oscillations, called micro-chaos. Both papers below study truncation, not rounding.
///
/// @param value    value z, any unit
/// @param quantum  q ≥ 0 and finite, in the unit of z
/// Sources: B. Widrow and I. Kollár, Quantization Noise, Cambridge University Press (2008);
/// G. Haller and G. Stépán, Micro-chaos in digital control, J. Nonlinear Sci. 6 (1996);
/// G. Csernák and G. Stépán, Digital control as source of chaotic behavior, Int. J. Bifurcation
/// and Chaos 20 (2010).
template <class Scalar>
Scalar quantised(const Scalar& value, const Scalar& quantum) {
  using std::abs;
  using std::nearbyint;
  if (quantum == Scalar(0)) return value;
  // Below this count of quanta the rounded product, divided again, rounds to the same count.
  const Scalar most_quanta = Scalar(0.5) / std::numeric_limits<Scalar>::epsilon();
  const Scalar quanta = value / quantum;
  return abs(quanta) >= most_quanta ? value : Scalar(quantum * nearbyint(quanta));
}

}  // namespace holdfast
