#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <xsimd/xsimd.hpp>

#include "holdfast/core/lanes.hpp"
#include "holdfast/core/select.hpp"

/// The library's kernels on SIMD packs: `xsimd::batch` is made a number type like any other, so
/// that a kernel written for `double` works on as many cells at once as the processor has lanes.
/// The instruction set is that for which the unit is compiled: SSE2, AVX2, AVX-512, NEON, …. It is
/// part of the pack's type, and so of the name of every kernel on it: units compiled for several of
/// them go together into one program (bench/README.md).

namespace holdfast {

/// Comparing packs gives one truth value a lane.
template <class Number, class Architecture>
struct MaskOf<xsimd::batch<Number, Architecture>> {
  /// One truth value a lane.
  using type = xsimd::batch_bool<Number, Architecture>;

  /// The lanes that a mask does not have; `!` of a mask takes it apart on some instruction sets.
  static type complement(const type& mask) { return ~mask; }
};

namespace simd {

/// As many numbers as one register of the target holds.
template <class Number, class Architecture = xsimd::default_arch>
using Pack = xsimd::batch<Number, Architecture>;

namespace detail {

/// One bit a lane of a mask of doubles, the first lane lowest.
template <class Architecture>
std::uint64_t lane_bits(const xsimd::batch_bool<double, Architecture>& mask) {
  constexpr std::size_t count = xsimd::batch_bool<double, Architecture>::size;
#if XSIMD_WITH_AVX512F
  if constexpr (count == 8) return static_cast<std::uint64_t>(static_cast<__mmask8>(mask.data));
#endif
#if XSIMD_WITH_AVX
  if constexpr (count == 4) return static_cast<std::uint64_t>(_mm256_movemask_pd(mask));
#endif
#if XSIMD_WITH_SSE2
  if constexpr (count == 2) return static_cast<std::uint64_t>(_mm_movemask_pd(mask));
#else
  bool lanes[count];
  mask.store_unaligned(lanes);
  std::uint64_t bits = 0;
  for (std::size_t lane = 0; lane < count; ++lane) bits |= std::uint64_t{lanes[lane]} << lane;
  return bits;
#endif
}

/// Bit k of the lowest eight becomes byte k, 0 or 1.
inline std::uint64_t spread_to_bytes(std::uint64_t bits) {
  const std::uint64_t one_a_byte = (bits * 0x0101010101010101U) & 0x8040201008040201U;
  return ((one_a_byte + 0x7f7f7f7f7f7f7f7fU) >> 7U) & 0x0101010101010101U;
}

}  // namespace detail
}  // namespace simd

/// The lanes of a pack, at most eight.
template <class Number, class Architecture>
struct Lanes<xsimd::batch<Number, Architecture>> {
  using Pack = xsimd::batch<Number, Architecture>;  ///< the pack itself
  using Value = Number;                             ///< what one lane holds
  static constexpr std::size_t count = Pack::size;  ///< how many numbers a register holds
  static_assert(count <= 8, "a mask is spread to one 64-bit word");

  /// `count` neighbours, at any address that suits a `Value`.
  static Pack load(const Value* values) { return Pack::load_unaligned(values); }
  /// Writes `count` neighbours, at any address that suits a `Value`.
  static void store(const Pack& pack, Value* values) { pack.store_unaligned(values); }

  /// One byte a lane: 1 where the mask is set, else 0.
  static void store_flags(const typename Pack::batch_bool_type& mask, std::uint8_t* flags) {
    const std::uint64_t bytes = simd::detail::spread_to_bytes(simd::detail::lane_bits(mask));
    std::memcpy(flags, &bytes, count);
  }

  /// Flags of two neighbouring masks, 2 `count` bytes.
  static void store_flags(const typename Pack::batch_bool_type& first,
                          const typename Pack::batch_bool_type& second, std::uint8_t* flags) {
    if constexpr (2 * count <= 8) {
      const std::uint64_t bits = simd::detail::lane_bits(first) | simd::detail::lane_bits(second)
                                                                      << count;
      const std::uint64_t bytes = simd::detail::spread_to_bytes(bits);
      std::memcpy(flags, &bytes, 2 * count);
    } else {
      store_flags(first, flags);
      store_flags(second, flags + count);
    }
  }
};

}  // namespace holdfast

namespace Eigen {

/// Packs as entries of small vectors and matrices.
template <class Number, class Architecture>
struct NumTraits<xsimd::batch<Number, Architecture>>
    : GenericNumTraits<xsimd::batch<Number, Architecture>> {
  using Real = xsimd::batch<Number, Architecture>;  ///< a pack is real: its own real part
  using NonInteger = Real;                          ///< of quotients and roots
  using Nested = Real;                              ///< a pack is kept by value in expressions
  using Literal = Number;                           ///< of constants, the same in every lane
};

namespace internal {

/// Packs are aligned as their own type wants it. Eigen's alignment of numbers may then be set to
/// that of the narrowest instruction set (EIGEN_MAX_ALIGN_BYTES), in which units compiled for
/// several of them agree.
template <class Number, class Architecture, int Size>
struct compute_default_alignment<xsimd::batch<Number, Architecture>, Size> {
  enum { value = 0 };
};

}  // namespace internal
}  // namespace Eigen
