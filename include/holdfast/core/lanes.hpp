#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "holdfast/core/types.hpp"

namespace holdfast {

/// Access to the lanes of a number type: one for a scalar, several for a SIMD pack. Generic code
/// reads or writes `count` consecutive numbers at once. Pack types specialise `Lanes` and `MaskOf`.
template <class Scalar>
struct Lanes {
  using Value = Scalar;                    ///< type of the number in one lane
  static constexpr std::size_t count = 1;  ///< number of lanes

  /// Reads `count` consecutive numbers, the first one into lane 0.
  static Scalar load(const Value* values) { return *values; }
  /// Writes all lanes to `count` consecutive numbers, lane 0 first.
  static void store(const Scalar& pack, Value* values) { *values = pack; }

  /// Writes one byte for each lane: 1 where the mask is set, else 0.
  static void store_flags(bool mask, std::uint8_t* flags) { *flags = mask ? 1 : 0; }

  /// Writes one byte, 1 or 0, for each lane of the mask `first`, then for each lane of `second`.
  static void store_flags(bool first, bool second, std::uint8_t* flags) {
    store_flags(first, flags);
    store_flags(second, flags + count);
  }
};

namespace detail {

template <class Scalar>
auto lane_of(const Scalar& pack, std::size_t lane) {
  typename Lanes<Scalar>::Value values[Lanes<Scalar>::count];
  Lanes<Scalar>::store(pack, values);
  return values[lane];
}

/// Builds a pack from one number per lane, or a matrix of packs from one matrix per lane.
/// @param of_lane  function from the index of a lane to a number or a matrix of fixed size
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
