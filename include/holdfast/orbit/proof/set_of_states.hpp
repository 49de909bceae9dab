#pragma once

#include "holdfast/core/types.hpp"
#include "holdfast/math/enclosure/enclosure.hpp"
#include "holdfast/orbit/proof/enclosed_modes.hpp"

namespace holdfast::detail {

/// The set of states w (FlowPlace) reached by motions from positions y in a ball,
///
///     w = centre + D y,   |y| ≤ radius,   D one of the matrices in `spread`
///
/// The centre encloses the motion with y = 0. The spread encloses, on the whole ball, the
/// derivative with respect to y of the point where a motion reaches a surface (mean value theorem).
/// If the motions reach the surface at different instants, `at_once` is the derivative at one later
/// instant, transported back by the flow to the instant at which the centre reaches it. It includes
/// the saltation matrix, but not the large displacement along the flow, which cancels.
template <class Number>
struct SetOfStates {
  using State = Vector<Number, FlowPlace::size>;      ///< state w (FlowPlace)
  using Spread = Matrix<Number, FlowPlace::size, 6>;  ///< matrix D, the derivative of w by y
  using Row = FlowRow<Number>;                        ///< linear function of w

  State centre = State::Zero();     ///< state for y = 0
  Spread spread = Spread::Zero();   ///< matrix D, the derivative of w with respect to y
  Spread at_once = Spread::Zero();  ///< derivative at one instant, used where `is_apart`
  bool is_apart = false;  ///< whether the motions reached the surface at different instants
  double radius = 0.0;    ///< radius of the ball of positions y

  /// The derivative of w with respect to y at one instant that is common to all motions.
  const Spread& together() const { return is_apart ? at_once : spread; }

  /// The value of a linear function of w at the centre.
  Number at_centre(const Row& row) const { return product(row, centre); }
  /// An upper bound of a linear function's deviation, on the ball, from its value at the centre.
  Number deviation(const Row& row) const {
    if (radius == 0.0) return {};
    Number sum;
    for (Eigen::Index k = 0; k < spread.cols(); ++k) sum += square(product(row, spread.col(k)));
    return sqrt(sum) * Number(radius);
  }
  /// An interval that contains the values of a linear function of w on the whole ball.
  Number range(const Row& row) const {
    const double most = deviation(row).upper();
    return at_centre(row) + Number(-most, most);
  }

  /// Replaces a coordinate of w by row · w; updates `centre`, `spread` and, if apart, `at_once`.
  void assign(Eigen::Index coordinate, const Row& row) {
    assign_where_met(coordinate, row);
    if (is_apart) at_once.row(coordinate) = (row * at_once).eval();
  }
  /// Sets a coordinate as assign() does, but only in `centre` and `spread`.
  void assign_where_met(Eigen::Index coordinate, const Row& row) {
    const Number value = at_centre(row);
    const RowVector<Number, 6> change = row * spread;
    centre[coordinate] = value;
    spread.row(coordinate) = change;
  }
  /// Sets a coordinate of w to the same value for all motions.
  void assign(Eigen::Index coordinate, const Number& value) {
    centre[coordinate] = value;
    spread.row(coordinate).setZero();
    at_once.row(coordinate).setZero();
  }

 private:
  /// The product of a row and a column; zero entries of the row are skipped.
  template <class Column>
  static Number product(const Row& row, const Column& column) {
    Number sum;
    for (Eigen::Index i = 0; i < row.size(); ++i)
      if (row[i].magnitude() > 0.0) sum += row[i] * column[i];
    return sum;
  }
};

}  // namespace holdfast::detail
