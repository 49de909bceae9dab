#pragma once

#include "holdfast/core/compiler.hpp"

namespace holdfast {

/// Branching on data, written once for scalars and for SIMD packs.
///
/// A kernel never says `if (a < b)` on its number type; it computes a mask and selects. For a plain
/// scalar the mask is `bool`. A pack type brings its own overloads of `select`, `any` and `all`,
/// found by argument-dependent lookup, and a specialisation of `MaskOf`.
template <class Scalar>
struct MaskOf {
  using type = bool;  ///< what a comparison of two `Scalar`s gives

  /// The lanes that a mask does not have.
  static constexpr bool complement(bool mask) { return !mask; }
};

/// The type of a comparison of two `Scalar`s.
template <class Scalar>
using Mask = typename MaskOf<Scalar>::type;

/// The lanes of a mask that another one does not have.
template <class Scalar>
constexpr Mask<Scalar> without(const Mask<Scalar>& mask, const Mask<Scalar>& other) {
  return mask & MaskOf<Scalar>::complement(other);
}

/// `mask ? when_true : when_false`, lane by lane.
template <class Value>
constexpr Value select(bool mask, const Value& when_true, const Value& when_false) {
  return mask ? when_true : when_false;
}

/// True when some lane of the mask is set.
constexpr bool any(bool mask) { return mask; }

/// True when every lane of the mask is set.
constexpr bool all(bool mask) { return mask; }

}  // namespace holdfast
