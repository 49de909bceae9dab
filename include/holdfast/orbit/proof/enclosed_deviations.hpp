#pragma once

#include <cstddef>

#include "holdfast/core/types.hpp"
#include "holdfast/math/enclosure/enclosure.hpp"
#include "holdfast/orbit/proof/contracting_norms.hpp"
#include "holdfast/orbit/switching_borders.hpp"

namespace holdfast::detail {

/// The row whose product with the state z̃ is Δz or, for `of_velocity`, Δż.
inline RowVector<double, 5> relative_row(bool of_velocity) {
  const Eigen::Index first = of_velocity ? 1 : 0;
  return RowVector<double, 5>::Unit(2 + first) - RowVector<double, 5>::Unit(first);
}

/// A row vector of doubles with a bound of the Euclidean length of its error.
struct RowWithError {
  RowVector<double, 6> row = RowVector<double, 6>::Zero();  ///< computed row
  Enclosure error;  ///< bound of the Euclidean length of the error

  /// The difference of two rows, its rounding errors included.
  RowWithError operator-(const RowWithError& other) const {
    RowWithError difference{row - other.row, error + other.error};
    for (const double entry : difference.row) difference.error += Enclosure(rounding_of(entry));
    return difference;
  }
  /// An upper bound of the row's length.
  Enclosure length() const {
    Enclosure sum;
    for (const double entry : row) sum += square(Enclosure(entry));
    return sqrt(sum) + error;
  }
};

/// The six deviations along an orbit that begin as the unit vectors of [z̃; gap] in a weighted norm.
/// They are computed in doubles; their errors are bounded in contracting norms of the maps.
template <class Number>
class EnclosedDeviations {
 public:
  using Columns = Eigen::Matrix<double, 5, 6>;   ///< six deviations of z̃
  using Enclosed = Eigen::Matrix<Number, 5, 6>;  ///< the six deviations, enclosed
  using Map = Matrix<Number, 5>;                 ///< map of z̃ over a sample
  using Norms = ContractingNorms<5>;             ///< norms in which the orbit's maps contract

  /// @param weights  weights of [z̃; gap], the last one 1
  /// @param units    units of z̃, powers of two
  EnclosedDeviations(const Norms& norms, const Vector<double, 6>& weights,
                     const Vector<double, 5>& units)
      : norms_(norms) {
    for (Eigen::Index i = 0; i < 5; ++i) weights_[i] = Number(weights[i]) * Number(units[i]);
    Enclosed exact = Enclosed::Zero();
    for (Eigen::Index i = 0; i < 5; ++i) exact(i, i) = Number(1.0) / weights_[i];
    take(0, exact, Number());
    gap_.row = RowVector<double, 6>::Unit(5);
  }

  /// The six deviations of Δz (m) or of Δż (in the unit of ż) at a sample.
  RowWithError relative(std::size_t sample, bool of_velocity) const {
    const Eigen::Index first = of_velocity ? 1 : 0;
    const Number error = error_ * Number(norms_.reading(sample, relative_row(of_velocity)));
    return RowWithError{columns_.row(2 + first), error} - RowWithError{columns_.row(first), {}};
  }
  /// The six deviations of the position of the drive's gap (m).
  const RowWithError& gap() const { return gap_; }

  /// Propagates the deviations from `sample` to `next` by the sample's map and contact decision.
  void advance(std::size_t sample, std::size_t next, const ContactDecision& decision,
               const Map& map) {
    if (decision.engaged) gap_ = {};
    if (!decision.engaged && !decision.was_inside) gap_ = relative(sample, false);
    take(next, map * columns_.template cast<Number>(), Number(norms_.factor(sample)) * error_);
  }

  /// Whether, after whole periods, all deviations of initial length 1 are proved shorter than 1.
  bool have_contracted(bool with_gap) const {
    Number sum, error;
    for (Eigen::Index i = 0; i < 5; ++i) {
      for (const double entry : columns_.row(i)) sum += square(weights_[i] * Number(entry));
      error += weights_[i] * error_ * Number(norms_.reading(0, RowVector<double, 5>::Unit(i)));
    }
    if (with_gap) {
      for (const double entry : gap_.row) sum += square(Number(entry));
      error += gap_.error;
    }
    return (sqrt(sum) + error).upper() < 1.0;
  }

 private:
  /// Stores the midpoints of `exact`; their error is `carried` + √(Σ V_j(exact − midpoint)²).
  void take(std::size_t sample, const Enclosed& exact, const Number& carried) {
    columns_ = exact.template cast<double>();
    const Enclosed wrong = exact - columns_.template cast<Number>();
    Number sum;
    for (Eigen::Index i = 0; i < 6; ++i) sum += square(norms_.size(sample, wrong.col(i)));
    error_ = Number((carried + sqrt(sum)).upper());
  }

  const Norms& norms_;
  Vector<Number, 5> weights_;  // of z̃ in units
  Columns columns_ = Columns::Zero();
  Number error_;
  RowWithError gap_;
};

}  // namespace holdfast::detail
