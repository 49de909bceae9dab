#pragma once

#include <cmath>

#include "holdfast/core/types.hpp"

namespace holdfast {

namespace detail {

/// The largest power of two that is not larger than a size; 1 where that is not finite and > 0.
template <class Scalar>
Scalar power_of_two_below(const Scalar& size) {
  using std::ilogb;
  using std::isfinite;
  using std::ldexp;
  return size > Scalar(0) && isfinite(size) ? ldexp(Scalar(1), ilogb(size)) : Scalar(1);
}

}  // namespace detail

/// Units of z̃ = [z; u_{j−1}] that belong to a plant: 1 m, ω · 1 m and k · 1 m, where a
/// displacement z₁ of 1 m is pulled back with the acceleration ω² and the force k.
///
/// What is solved for in them is the same whatever units of mass and time the plant is given in,
/// and no coordinate is larger than another for its unit alone. They are rounded down to powers of
/// two, so that changing to them rounds nothing.
/// @param state_matrix      A, 4 × 4
/// @param excitation_input  c, 4 × 1
/// @return of [z₁, ż₁, z₂, ż₂, u]; 1 where the plant does not tell
template <class Scalar>
Vector<Scalar, 5> plant_scaling(const Matrix<Scalar, 4>& state_matrix,
                                const Vector<Scalar, 4>& excitation_input) {
  using std::abs;
  using std::sqrt;
  const Scalar acceleration = abs(state_matrix(1, 0));
  const Scalar velocity = detail::power_of_two_below(Scalar(sqrt(acceleration)));
  return {Scalar(1), velocity, Scalar(1), velocity,
          detail::power_of_two_below(Scalar(acceleration / abs(excitation_input[1])))};
}

}  // namespace holdfast
