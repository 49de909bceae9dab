#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "holdfast/math/poly/polynomial.hpp"
#include "holdfast/stability/boundary/root_pair_curve.hpp"
#include "holdfast/stability/polynomial/affine_polynomial.hpp"

namespace holdfast {

/// A differential gain at which a row of fixed P meets the boundary.
template <class Scalar>
struct RowCrossing {
  Scalar differential;  ///< D (N s/m)
  Scalar uncertainty;   ///< D (N s/m) within which round-off leaves the place of the boundary open
};

/// The crossings of one row, ascending in D: at most one for each arc and each of the two lines.
template <class Scalar>
class CrossingList {
 public:
  using Crossing = RowCrossing<Scalar>;        ///< what the list holds
  static constexpr std::size_t capacity = 16;  ///< 11 arcs and 2 lines at most, and a few to spare

  /// The crossing of least D.
  const Crossing* begin() const { return crossings_.data(); }
  /// One past the crossing of largest D.
  const Crossing* end() const { return crossings_.data() + size_; }
  /// Number of crossings of the row, 0 … capacity.
  std::size_t size() const { return size_; }
  /// Crossing number `index` from the least D, 0 ≤ index < size(), unchecked.
  const Crossing& operator[](std::size_t index) const { return crossings_[index]; }

  /// Leaves no crossing, ready for the next row.
  void clear() { size_ = 0; }

  /// Keeps the order; a crossing at infinity is none, and one beyond the capacity is dropped.
  void insert(const Crossing& crossing) {
    if (!std::isfinite(crossing.differential) || size_ == capacity) return;
    std::size_t place = size_++;
    for (; place > 0 && crossings_[place - 1].differential > crossing.differential; --place) {
      crossings_[place] = crossings_[place - 1];
    }
    crossings_[place] = crossing;
  }

 private:
  std::array<Crossing, capacity> crossings_{};
  std::size_t size_ = 0;
};

/// Where rows of fixed proportional gain cross the boundary of the gain plane.
///
/// The root pair on the axis at the gain P is a root of n(Y) − P Δ(Y) on each arc of
/// `RootPairCurve` that takes P: one Newton iteration inside the arc, which starts from the row
/// before and so needs one or two steps where rows are close. D follows from the even or the odd
/// part, whichever is better conditioned. The lines w = 0 and w = ∞ are linear in D.
/// Exchange the roles of P and D in the polynomial for rows of fixed D.
template <class Scalar, int Degree>
class RowCrossings {
 public:
  /// @param polynomial  in a variable whose stable half-plane is Re < 0
  explicit RowCrossings(const AffinePolynomial<Scalar, Degree>& polynomial) : curve_(polynomial) {
    for (const MonotoneArc<Scalar>& arc : curve_.arcs()) branches_.push_back({arc});
  }

  /// The curve of root pairs that the rows cross.
  const RootPairCurve<Scalar>& curve() const { return curve_; }

  /// The crossings at the proportional gain P (N/m), finite.
  const CrossingList<Scalar>& at(const Scalar& proportional_gain) {
    crossings_.clear();
    add_line(proportional_gain, &ParityParts<Scalar>::even, 0);
    constexpr auto leading =
        Degree % 2 == 0 ? &ParityParts<Scalar>::even : &ParityParts<Scalar>::odd;
    add_line(proportional_gain, leading, 2);
    for (Branch& branch : branches_) {
      if (!branch.arc.passes(proportional_gain)) continue;
      follow(branch, proportional_gain);
      crossings_.insert(crossing_at(proportional_gain, branch.square));
    }
    return crossings_;
  }

 private:
  static constexpr Scalar unknown_ = std::numeric_limits<Scalar>::quiet_NaN();
  static constexpr Scalar rounding_ = Scalar(32) * std::numeric_limits<Scalar>::epsilon();

  using Part = Vector<Scalar, 3> ParityParts<Scalar>::*;

  struct Branch {
    MonotoneArc<Scalar> arc;
    Scalar square = unknown_;            // Y of the row before
    Scalar square_per_gain = Scalar(0);  // dY/dP there
    Scalar proportional_gain = Scalar(0);
  };

  /// Newton's method, halving the arc where it would leave it.
  void follow(Branch& branch, const Scalar& proportional_gain) const {
    MonotoneArc<Scalar> bracket = branch.arc;
    const bool negative_at_start = bracket.start.residual(proportional_gain) < Scalar(0);
    Scalar square =
        branch.square + branch.square_per_gain * (proportional_gain - branch.proportional_gain);
    typename RootPairCurve<Scalar>::Residual at_square{};
    for (int iteration = 0; iteration < 200; ++iteration) {
      if (!(square > bracket.start.square && square < bracket.end.square))
        square = bracket.inside();
      at_square = curve_.residual(square, proportional_gain);
      ((at_square.value < Scalar(0)) == negative_at_start ? bracket.start : bracket.end).square =
          square;
      const Scalar step = at_square.value / at_square.slope;
      const Scalar next = square - step;
      const bool settled =
          std::abs(step) <= Scalar(2) * std::numeric_limits<Scalar>::epsilon() * square;
      if (settled ||
          !(bracket.start.square < bracket.inside() && bracket.inside() < bracket.end.square)) {
        break;
      }
      square = next;
    }
    branch.square = square;
    branch.square_per_gain = at_square.denominator / at_square.slope;
    branch.proportional_gain = proportional_gain;
  }

  RowCrossing<Scalar> crossing_at(const Scalar& proportional_gain, const Scalar& square) const {
    const Scalar even_slope = evaluate(curve_.differential().even, square);
    const Scalar odd_slope = evaluate(curve_.differential().odd, square);
    const bool even_is_steeper = even_slope * even_slope > odd_slope * odd_slope * square;
    return even_is_steeper
               ? solve_part(&ParityParts<Scalar>::even, proportional_gain, square, even_slope)
               : solve_part(&ParityParts<Scalar>::odd, proportional_gain, square, odd_slope);
  }

  /// b + P p + D d = 0 for one part at Y. Its terms may cancel: round-off is that of their sizes.
  RowCrossing<Scalar> solve_part(Part part, const Scalar& proportional_gain, const Scalar& square,
                                 const Scalar& slope) const {
    const Vector<Scalar, 3> sum =
        curve_.base().*part + proportional_gain * curve_.proportional().*part;
    const Vector<Scalar, 3> sizes =
        (curve_.base().*part).cwiseAbs() +
        std::abs(proportional_gain) * (curve_.proportional().*part).cwiseAbs();
    return {-evaluate(sum, square) / slope, rounding_ * evaluate(sizes, square) / std::abs(slope)};
  }

  /// The line on which one coefficient vanishes; none where D does not move it.
  void add_line(const Scalar& proportional_gain, Part part, int k) {
    const Scalar slope = (curve_.differential().*part)[k];
    if (slope == Scalar(0)) return;
    const Scalar base = (curve_.base().*part)[k];
    const Scalar term = proportional_gain * (curve_.proportional().*part)[k];
    crossings_.insert(
        {-(base + term) / slope, rounding_ * (std::abs(base) + std::abs(term)) / std::abs(slope)});
  }

  RootPairCurve<Scalar> curve_;
  std::vector<Branch> branches_;
  CrossingList<Scalar> crossings_;
};

}  // namespace holdfast
