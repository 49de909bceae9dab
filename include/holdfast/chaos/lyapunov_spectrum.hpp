#pragma once

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "holdfast/core/types.hpp"
#include "holdfast/math/linalg/reflections.hpp"
#include "holdfast/math/stats/batch_sums.hpp"
#include "holdfast/math/stats/settled_means.hpp"

namespace holdfast {

namespace detail {

/// An orthogonal basis whose vectors are generic, not invariant or null directions of a loop's
/// maps: the reflection I − 2 v vᵀ / ‖v‖², v_i = √(i + 1).
/// @param size  size of the maps
template <class Scalar = double, int Size = 7>
Matrix<Scalar, Size> oblique_basis(Eigen::Index size = Size) {
  Vector<Scalar, Size> normal(size);
  for (Eigen::Index i = 0; i < size; ++i) normal[i] = std::sqrt(static_cast<double>(i) + 1.0);
  return Matrix<Scalar, Size>::Identity(size, size) -
         normal * normal.transpose() * (2.0 / normal.squaredNorm());
}

}  // namespace detail

/// Computes the Lyapunov spectrum of a sequence of tangent maps M_j by a QR factorisation per step.
///
///     M_j Q_j = Q_{j+1} R_{j+1},   λ_i = (1/n) Σ_j ln |(R_j)_ii|   (natural logarithm per step)
///
/// The columns of the orthogonal matrix Q_j are the tangent vectors; R_j is upper triangular; n is
/// the number of steps. Ranks of maps are determined to working precision: a direction contracted
/// about 10¹⁵ times more than others counts as lost. If the smallest rank is r < Size, there are
/// Size − r null directions with exponents of exactly −∞, not logarithms of round-off. Source:
/// Kollár 2022, Eq. (16) (less accurate: Gram–Schmidt); G. Benettin et al., Meccanica 15 (1980).
template <class Scalar, int Size>
class LyapunovSpectrum {
 public:
  /// The present tangent vectors and the sums over all steps since the start or the last restart.
  struct State {
    Matrix<Scalar, Size> basis;      ///< orthogonal matrix Q_n after the last step
    BatchSums<Scalar, Size> sums;    ///< sums of ln |R_ii| over the steps, in batches
    Vector<Scalar, Size> remainder;  ///< term added to Σ ln |R_ii| in exponents(), not in settled()
    int finite = Size;               ///< number of exponents that are not −∞
  };

  /// @param initial_basis  orthogonal Q₀. Its first columns must not span an invariant subspace of
  ///                       the maps: the identity is unsuitable if a coordinate axis is invariant
  explicit LyapunovSpectrum(const Matrix<Scalar, Size>& initial_basis =
                                Matrix<Scalar, Size>::Identity(Size < 0 ? 0 : Size,
                                                               Size < 0 ? 0 : Size))
      : state_{initial_basis, BatchSums<Scalar, Size>(1, initial_basis.rows()),
               Vector<Scalar, Size>::Zero(initial_basis.rows()),
               static_cast<int>(initial_basis.rows())} {}

  /// Constructs a spectrum that continues from a given State.
  explicit LyapunovSpectrum(const State& state) : state_(state) {}

  /// The rank of a map to working precision. For a map that is used many times, compute it once.
  static int rank_of(const Matrix<Scalar, Size>& tangent);

  /// Adds one step with the map `tangent`. `rank`: rank of this map, or of the product of all maps.
  void push(const Matrix<Scalar, Size>& tangent, int rank);

  /// Adds one step with the tangent map `tangent` and computes the rank of this map.
  void push(const Matrix<Scalar, Size>& tangent) { push(tangent, rank_of(tangent)); }

  /// The exponents λ₁ … λ_Size, natural logarithm per step, in the order of the diagonal of R
  /// (descending once converged); −∞ for a null direction, NaN before the first step.
  Vector<Scalar, Size> exponents() const;

  /// The exponents' standard errors by batch means: 0 for a null direction, NaN with < 4 batches.
  Vector<Scalar, Size> standard_errors() const {
    return with(state_.sums.standard_errors(), Scalar(0));
  }

  /// The exponents over the steps after the initial transient, with standard errors, computed by
  /// settled_means(). These errors are also valid on a periodic orbit, where the batch means hardly
  /// scatter. A null direction has the exponent −∞ and the standard error 0.
  SettledMeans<Size> settled() const {
    SettledMeans<Size> found = settled_means(state_.sums);
    found.means = with(found.means, -std::numeric_limits<double>::infinity());
    found.standard_errors = with(found.standard_errors, 0.0);
    return found;
  }

  /// The number n of maps since the start or the last restart.
  std::int64_t steps() const { return state_.sums.steps(); }

  /// Restarts the averages, but keeps the tangent vectors and the number of null directions.
  void restart() {
    state_.sums = BatchSums<Scalar, Size>(1, state_.basis.rows());
    state_.remainder.setZero();
  }

 private:
  Vector<Scalar, Size> with(const Vector<Scalar, Size>& values, Scalar where_null) const {
    Vector<Scalar, Size> result = values;
    result.tail(result.size() - state_.finite).setConstant(where_null);
    return result;
  }

  State state_;
};

template <class Scalar, int Size>
int LyapunovSpectrum<Scalar, Size>::rank_of(const Matrix<Scalar, Size>& tangent) {
  return static_cast<int>(Eigen::FullPivLU<Matrix<Scalar, Size>>(tangent).rank());
}

template <class Scalar, int Size>
void LyapunovSpectrum<Scalar, Size>::push(const Matrix<Scalar, Size>& tangent, int rank) {
  Matrix<Scalar, Size> upper = tangent * state_.basis;
  state_.basis = orthogonal_factor(upper);
  state_.finite = std::min(state_.finite, rank);
  Vector<Scalar, Size> logarithms = Vector<Scalar, Size>::Zero(tangent.rows());
  for (int i = 0; i < state_.finite; ++i) {
    const Scalar stretch = std::abs(upper(i, i));
    if (stretch == Scalar(0)) {
      state_.finite = i;
      break;
    }
    logarithms[i] = std::log(stretch);
  }
  state_.sums.add(logarithms, 1);
}

template <class Scalar, int Size>
Vector<Scalar, Size> LyapunovSpectrum<Scalar, Size>::exponents() const {
  const Scalar steps_taken(static_cast<double>(steps()));
  return with((state_.sums.totals() + state_.remainder) / steps_taken,
              -std::numeric_limits<Scalar>::infinity());
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template class LyapunovSpectrum<double, 5>;
extern template class LyapunovSpectrum<double, 7>;
extern template class LyapunovSpectrum<double, Eigen::Dynamic>;
#endif

}  // namespace holdfast
