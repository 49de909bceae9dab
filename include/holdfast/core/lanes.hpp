#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "holdfast/core/types.hpp"

namespace holdfast {

/// The lanes of a number type: a scalar has one, a SIMD pack several. A pack type specialises this
/// beside `MaskOf`, so that a kernel can read and write as many neighbours as there are lanes and
/// hand a lane that needs more care to scalar code.
template <class Scalar>
struct Lanes {
  using Value = Scalar;                    ///< what one lane holds
  static constexpr std::size_t count = 1;  ///< how many lanes there are

  /// Reads `count` neighbours, the first one into lane 0.
  static Scalar load(const Value* values) { return *values; }
  /// Writes all lanes to `count` neighbours, lane 0 first.
  static void store(const Scalar& pack, Value* values) { *values = pack; }

  /// One byte a lane: 1 where the mask is set, else 0.
  static void store_flags(bool mask, std::uint8_t* flags) { *flags = mask ? 1 : 0; }

  /// Flags of two neighbouring masks.
  static void store_flags(bool first, bool second, std::uint8_t* flags) {
    store_flags(first, flags);
    store_flags(second, flags + count);
  }
};

namespace detail {

/// The number in one lane of a pack.
template <class Scalar>
auto lane_of(const Scalar& pack, std::size_t lane) {
  typename Lanes<Scalar>::Value values[Lanes<Scalar>::count];
  Lanes<Scalar>::store(pack, values);
  return values[lane];
}

/// The numbers or matrices of all lanes side by side.
/// @param of_lane  (lane) → number or matrix of fixed size
template <class Scalar, class OfLane>
auto from_lanes(const OfLane& of_lane) {
  using Value = std::decay_t<decltype(of_lane(0))>;
  if constexpr (std::is_arithmetic_v<Value>) {
    typename Lanes<Scalar>::Value values[Lanes<Scalar>::count];
    for (std::size_t lane = 0; lane < Lanes<Scalar>::count; ++lane) values[lane] = of_lane(lane);
    return Lanes<Scalar>::load(values);
  } else {
    Matrix<Scalar, Value::RowsAtCompileTime, Value::ColsAtCompileTime> result;
    for (Eigen::Index i = 0; i < result.size(); ++i)
      result(i) = from_lanes<Scalar>([&](std::size_t lane) { return of_lane(lane)(i); });
    return result;
  }
}

}  // namespace detail

}  // namespace holdfast
