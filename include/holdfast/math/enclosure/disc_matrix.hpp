#pragma once

#include <Eigen/Core>
#include <complex>
#include <limits>
#include <utility>

#include "holdfast/math/enclosure/complex_enclosure.hpp"

namespace holdfast {

/// A complex matrix that is proved to lie, entry by entry, within radii of a centre: many
/// `ComplexEnclosure`, of which a product costs three products of doubles.
struct DiscMatrix {
  Eigen::MatrixXcd centre;  ///< m × n
  Eigen::MatrixXd radius;   ///< m × n, ≥ 0

  /// Filled by entries.
  DiscMatrix(Eigen::Index rows, Eigen::Index columns)
      : centre(Eigen::MatrixXcd::Zero(rows, columns)),
        radius(Eigen::MatrixXd::Zero(rows, columns)) {}
  /// That matrix itself.
  explicit DiscMatrix(Eigen::MatrixXcd exact)
      : centre(std::move(exact)), radius(Eigen::MatrixXd::Zero(centre.rows(), centre.cols())) {}

  /// Entry i, j.
  ComplexEnclosure at(Eigen::Index i, Eigen::Index j) const { return {centre(i, j), radius(i, j)}; }
  /// Makes entry i, j that disc.
  void set(Eigen::Index i, Eigen::Index j, const ComplexEnclosure& disc) {
    centre(i, j) = disc.middle();
    radius(i, j) = disc.radius();
  }
};

/// A X of a matrix A of doubles. Each of the sums is of n products; in whatever order it is taken,
/// a rounding of each term and of each sum adds up to less than
///
///     |fl(A X) − A X| ≤ 4 (n + 4) u |A| |X|,   u = 2⁻⁵³
///
/// and of sums of numbers ≥ 0 as much of themselves. Products below the least normal number lose
/// no more than it. Source: S. M. Rump, Fast and parallel interval arithmetic, BIT 39 (1999),
/// pp. 534–554.
/// @param left   A, m × n
/// @param right  X, n × p
inline DiscMatrix product(const Eigen::MatrixXcd& left, const DiscMatrix& right) {
  const auto terms = static_cast<double>(left.cols() + 4);
  const double rounding = 4.0 * terms * 0x1.0p-53;
  const Eigen::MatrixXd size = left.cwiseAbs();
  DiscMatrix result(left * right.centre);
  const Eigen::MatrixXd missed = right.radius + 2.0 * rounding * right.centre.cwiseAbs();
  result.radius = (size * missed) * (1.0 + 4.0 * rounding);
  result.radius.array() += terms * std::numeric_limits<double>::min();
  return result;
}

}  // namespace holdfast
