#pragma once

#include "holdfast/core/types.hpp"
#include "holdfast/math/enclosure/enclosure.hpp"
#include "holdfast/orbit/proof/enclosed_modes.hpp"

namespace holdfast::detail {

/// Where the motions are that began in a ball: of each of them, y being its place there,
///
///     w = centre + D y,   |y| ≤ radius,   D one of the matrices in `spread`
///
/// The centre encloses the motion of y = 0; the spread is the derivative by y, on the whole ball,
/// of where a motion meets a surface (the mean value theorem). Where they meet it at different
/// instants `at_once` is the derivative at one instant after them all, carried back by the flow to
/// the instant of the centre: what the saltation matrix makes of it, without the way along the
/// flow, which is large and falls out again.
template <class Number>
struct SetOfStates {
  using State = Vector<Number, FlowPlace::size>;      ///< w
  using Spread = Matrix<Number, FlowPlace::size, 6>;  ///< D
  using Row = FlowRow<Number>;                        ///< a functional of w

  State centre = State::Zero();     ///< of y = 0
  Spread spread = Spread::Zero();   ///< D
  Spread at_once = Spread::Zero();  ///< used where `is_apart`
  bool is_apart = false;            ///< they met the surface at different instants
  double radius = 0.0;              ///< of the ball

  /// The derivative at one instant.
  const Spread& together() const { return is_apart ? at_once : spread; }

  /// A functional at the centre.
  Number at_centre(const Row& row) const { return product(row, centre); }
  /// At least how far it is from that on the ball.
  Number deviation(const Row& row) const {
    if (radius == 0.0) return {};
    Number sum;
    for (Eigen::Index k = 0; k < spread.cols(); ++k) sum += square(product(row, spread.col(k)));
    return sqrt(sum) * Number(radius);
  }
  /// A functional on the whole ball.
  Number range(const Row& row) const {
    const double most = deviation(row).upper();
    return at_centre(row) + Number(-most, most);
  }

  /// Gives a coordinate the values of a functional, exactly alike, now and from now on.
  void assign(Eigen::Index coordinate, const Row& row) {
    assign_where_met(coordinate, row);
    if (is_apart) at_once.row(coordinate) = (row * at_once).eval();
  }
  /// Assigns a row to a coordinate on the motions that are on the surface alone.
  void assign_where_met(Eigen::Index coordinate, const Row& row) {
    const Number value = at_centre(row);
    const RowVector<Number, 6> change = row * spread;
    centre[coordinate] = value;
    spread.row(coordinate) = change;
  }
  /// Gives a coordinate one value.
  void assign(Eigen::Index coordinate, const Number& value) {
    centre[coordinate] = value;
    spread.row(coordinate).setZero();
    at_once.row(coordinate).setZero();
  }

 private:
  /// Most entries of the rows are zero.
  template <class Column>
  static Number product(const Row& row, const Column& column) {
    Number sum;
    for (Eigen::Index i = 0; i < row.size(); ++i)
      if (row[i].magnitude() > 0.0) sum += row[i] * column[i];
    return sum;
  }
};

}  // namespace holdfast::detail
