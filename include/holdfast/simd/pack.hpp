#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <xsimd/xsimd.hpp>

#include "holdfast/core/lanes.hpp"
#include "holdfast/core/select.hpp"

/// SIMD packs (`xsimd::batch`) as the number type of the library's templates. A template computes
/// with a pack as many independent cases at a time as a SIMD register has lanes. The compiler
/// options choose the instruction set: SSE2, AVX2, AVX-512, NEON, …. The instruction set is part of
/// the pack's type and thus of the symbol name of each template's instance. Files compiled for
/// different instruction sets can therefore be linked into one program (bench/README.md).

namespace holdfast {

/// The mask type of a pack: one truth value for each lane.
template <class Number, class Architecture>
struct MaskOf<xsimd::batch<Number, Architecture>> {
  /// The type of the result of a comparison of two packs.
  using type = xsimd::batch_bool<Number, Architecture>;

  /// The complement of a mask, lane by lane, by `~`; `!` is slower on some instruction sets.
  static type complement(const type& mask) { return ~mask; }
};

namespace simd {

/// A pack: the numbers of one SIMD register, one in each lane.
template <class Number, class Architecture = xsimd::default_arch>
using Pack = xsimd::batch<Number, Architecture>;

namespace detail {

/// The mask as a number with one bit per lane; the lowest bit belongs to lane 0.
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

/// The 64-bit word whose byte k, 0 or 1, is bit k of `bits`, k = 0 … 7.
inline std::uint64_t spread_to_bytes(std::uint64_t bits) {
  const std::uint64_t one_a_byte = (bits * 0x0101010101010101U) & 0x8040201008040201U;
  return ((one_a_byte + 0x7f7f7f7f7f7f7f7fU) >> 7U) & 0x0101010101010101U;
}

}  // namespace detail
}  // namespace simd

/// Access to the lanes of a pack, at most eight.
template <class Number, class Architecture>
struct Lanes<xsimd::batch<Number, Architecture>> {
  using Pack = xsimd::batch<Number, Architecture>;  ///< type of the pack
  using Value = Number;                             ///< type of the number in one lane
  static constexpr std::size_t count = Pack::size;  ///< number of lanes
  static_assert(count <= 8, "a pack has at most 8 lanes, a byte each of a 64-bit mask");

  /// Reads `count` consecutive numbers into the lanes; `values` need not be aligned for SIMD.
  static Pack load(const Value* values) { return Pack::load_unaligned(values); }
  /// Writes the lanes to `count` consecutive numbers; `values` need not be aligned for SIMD.
  static void store(const Pack& pack, Value* values) { pack.store_unaligned(values); }

  /// Writes `count` bytes to `flags`, one for each lane: 1 where the mask is true, else 0.
  static void store_flags(const typename Pack::batch_bool_type& mask, std::uint8_t* flags) {
    const std::uint64_t bytes = simd::detail::spread_to_bytes(simd::detail::lane_bits(mask));
    std::memcpy(flags, &bytes, count);
  }

  /// Writes the bytes 1 or 0 of two masks: `count` bytes for `first`, then `count` for `second`.
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

/// The properties of a pack that Eigen needs for vectors and matrices of packs.
template <class Number, class Architecture>
struct NumTraits<xsimd::batch<Number, Architecture>>
    : GenericNumTraits<xsimd::batch<Number, Architecture>> {
  using Real = xsimd::batch<Number, Architecture>;  ///< type of the real part: the pack itself
  using NonInteger = Real;                          ///< type of results of division and square root
  using Nested = Real;     ///< type in Eigen's expressions, which store packs by value
  using Literal = Number;  ///< type of constants, which are equal in every lane
};

namespace internal {

/// The alignment (byte) that Eigen adds to arrays of packs: 0, because the pack type itself is
/// aligned. EIGEN_MAX_ALIGN_BYTES can then have the same small value in translation units compiled
/// for different instruction sets.
template <class Number, class Architecture, int Size>
struct compute_default_alignment<xsimd::batch<Number, Architecture>, Size> {
  enum { value = 0 };
};

}  // namespace internal
}  // namespace Eigen
