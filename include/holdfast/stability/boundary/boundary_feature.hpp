#pragma once

#include "holdfast/control/gains.hpp"
#include "holdfast/stability/boundary/boundary_point.hpp"

namespace holdfast {

/// What is special about a point of the boundary in the plane of P (across) and D (up).
enum class BoundaryFeatureKind {
  vertical_tangent,    ///< dP/dθ = 0: a stable interval of D opens or closes here
  horizontal_tangent,  ///< dD/dθ = 0: a stable interval of P opens or closes here
  cusp,                ///< dP/dθ = dD/dθ = 0: a double pair, the curve turns back on itself
  crossing,            ///< two curves, or the curve of pairs with itself
  end,                 ///< the curve of pairs ends on a line: a double root λ = ±1 (s = 0)
};

/// A root, or pair, on the boundary of stability.
template <class Scalar>
struct BoundaryRoot {
  BoundaryCurve curve;  ///< on which it lies
  Scalar angle;         ///< θ (rad) 0 … π, or ω (rad/s) for the continuous loop
};

/// One special point of the boundary. The two roots are the same but for crossings and ends.
template <class Scalar>
struct BoundaryFeature {
  BoundaryFeatureKind kind;     ///< tells what the two roots are
  BoundaryRoot<Scalar> first;   ///< the pair, of two pairs the slower one; of two lines λ = +1
  BoundaryRoot<Scalar> second;  ///< the line, or the faster pair; of two lines λ = −1
  PdGains<Scalar> gains;        ///< P (N/m) and D (N s/m), finite
  Scalar residual;  ///< larger |p(x)| of the two roots, over the sum of the moduli of its terms
  /// Of a tangent: one of the other kind lies so near that the two are nearly a cusp, where a small
  /// change of the loop swaps them, and stable intervals appear or vanish.
  bool nearly_cusp = false;
};

}  // namespace holdfast
