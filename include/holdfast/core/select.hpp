#pragma once

#include "holdfast/core/compiler.hpp"

namespace holdfast {

/// The mask type of a number type: the type of the result of a comparison, for instance a < b.
///
/// Numerical code computes a mask and calls select() instead of branching by `if (a < b)`. The code
/// then works for scalars and SIMD packs. The mask of a scalar is `bool`. A pack type overloads
/// `select`, `any` and `all`, found by argument-dependent lookup, and specialises `MaskOf`.
template <class Scalar>
struct MaskOf {
  using type = bool;  ///< type of the result of a comparison of two `Scalar`s

  /// The complement of a mask.
  static constexpr bool complement(bool mask) { return !mask; }
};

/// The type of the result of a comparison of two `Scalar`s.
template <class Scalar>
using Mask = typename MaskOf<Scalar>::type;

/// The mask that is set in each lane where `mask` is set and `other` is not.
template <class Scalar>
constexpr Mask<Scalar> without(const Mask<Scalar>& mask, const Mask<Scalar>& other) {
  return mask & MaskOf<Scalar>::complement(other);
}

/// Returns `mask ? when_true : when_false`; the overloads for packs select lane by lane.
template <class Value>
constexpr Value select(bool mask, const Value& when_true, const Value& when_false) {
  return mask ? when_true : when_false;
}

/// Whether at least one lane of the mask is set; a `bool` is the mask of one lane.
constexpr bool any(bool mask) { return mask; }

/// Whether every lane of the mask is set; a `bool` is the mask of one lane.
constexpr bool all(bool mask) { return mask; }

}  // namespace holdfast
