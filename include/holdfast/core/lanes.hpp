#pragma once

#include <cstddef>
#include <cstdint>

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

  /// Those of two neighbouring masks.
  static void store_flags(bool first, bool second, std::uint8_t* flags) {
    store_flags(first, flags);
    store_flags(second, flags + count);
  }
};

}  // namespace holdfast
