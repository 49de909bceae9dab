#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <unsupported/Eigen/AutoDiff>
#include <utility>
#include <vector>

#include "holdfast/control/enclosed_loop.hpp"
#include "holdfast/control/gains.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/math/enclosure/enclosure.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "holdfast/stability/chart/chart.hpp"
#include "holdfast/stability/polynomial/characteristic_polynomial.hpp"

namespace holdfast {

/// Verdict of a stability proof on all loops whose parameters lie in a box (closed ranges).
enum class ProvedStability {
  stable,     ///< every loop is asymptotically stable
  unstable,   ///< every loop has a root with |λ| > 1, or Re s > 0 in the continuous loop
  undecided,  ///< neither stability nor instability is proved for all loops
};

/// Closed rectangle ("box") of gains P and D; it may be degenerate, that is, a segment or a point.
struct GainBox {
  double proportional_from;  ///< lower end of P (N/m)
  double proportional_to;    ///< upper end of P (N/m)
  double differential_from;  ///< lower end of D (N s/m)
  double differential_to;    ///< upper end of D (N s/m)

  /// The area of the box in the plane of P and D (N²·s/m²).
  double area() const {
    return (proportional_to - proportional_from) * (differential_to - differential_from);
  }
};

/// A box of gains with the verdict on its loops.
struct ProvedBox {
  GainBox gains;              ///< ranges of the gains P and D
  ProvedStability stability;  ///< stability of all loops with gains in the box
};

/// Chart of proved stability: boxes that cover a grid without overlap, each with a verdict. A box
/// is a cell of the grid or a part of a cell. Boxes ascend in P and, for equal P, in D.
struct ProvedChart {
  std::vector<ProvedBox> boxes;  ///< boxes of the chart, at least one

  /// The total area of the boxes in the plane of P and D (N²·s/m²).
  double area() const {
    double sum = 0.0;
    for (const ProvedBox& box : boxes) sum += box.gains.area();
    return sum;
  }
  /// The fraction (0 … 1) of the chart's area that has the verdict `stability`.
  double share(ProvedStability stability) const {
    double sum = 0.0;
    for (const ProvedBox& box : boxes)
      if (box.stability == stability) sum += box.gains.area();
    return sum / area();
  }
};

namespace detail {

/// Hurwitz's conditions on a polynomial with coefficients a_0 … a_n, n = 4 or 5: numbers that are
/// all > 0 if all roots have Re < 0, and all ≥ 0 if all have Re ≤ 0. By Liénard and Chipart, all
/// roots have Re < 0 if the first `sufficing` numbers are > 0. H_k: Hurwitz determinants.
///
///     a_n a_0,  a_n a_2,  a_n a_{n−1},  H₃ a_n (n = 4) or H₂ and H₄ (n = 5);  then all others
///
/// Source: F. R. Gantmacher, The Theory of Matrices, vol. 2 (1959), ch. XV, §§ 6 and 13.
template <class Number, int Degree>
struct HurwitzConditions {
  static constexpr std::size_t sufficing = Degree == 4 ? 4 : 5;
  static constexpr std::size_t count = Degree == 4 ? 6 : 8;
  static constexpr std::size_t n = Degree;

  template <class Coefficients>
  static std::array<Number, count> of(const Coefficients& a) {
    const Number second = a[n - 1] * a[n - 2] - a[n] * a[n - 3];
    if constexpr (Degree == 4) {
      const Number third = a[1] * second - a[3] * (a[3] * a[0]);
      return {a[4] * a[0], a[4] * a[2], a[4] * a[3], a[4] * third, a[4] * a[1], second};
    } else {
      const Number x2 = a[4] * a[1] - a[5] * a[0];
      const Number x3 = a[1] * a[2] - a[0] * a[3];
      const Number third = a[2] * second - a[4] * x2;
      const Number fourth = x3 * second - x2 * x2;
      return {a[5] * a[0], a[5] * a[2], a[5] * a[4], second,
              fourth,      a[5] * a[1], a[5] * a[3], a[5] * third};
    }
  }
};

}  // namespace detail

/// Proves stability or instability for all gains in a box. For each of Hurwitz's conditions f > 0,
/// the range of f over a box with the centre (P₀, D₀) is enclosed by the mean value form:
///
///     f(P, D) ∈ f(P₀, D₀) + ∂f/∂P [box] (P − P₀) + ∂f/∂D [box] (D − D₀)
///
/// with ∂f/∂P and ∂f/∂D enclosed over the box. The overestimation is quadratic in the box's size.
template <int Degree>
class GainBoxProof {
 public:
  /// @param polynomial  characteristic polynomial with enclosures of its coefficients; its stable
  ///                    roots have Re < 0
  explicit GainBoxProof(HalfPlanePolynomial<Enclosure, Degree> polynomial)
      : polynomial_(std::move(polynomial)) {}

  /// The stability proved for all loops with gains in a box; `undecided` without a proof.
  ProvedStability operator()(const GainBox& box) const {
    const Enclosure p(box.proportional_from, box.proportional_to);
    const Enclosure d(box.differential_from, box.differential_to);
    const auto at_centre = Conditions::of(polynomial_.at({p.middle(), d.middle()}));
    const auto over_box = detail::HurwitzConditions<Moving, Degree>::of(moving_coefficients(p, d));
    std::size_t positive = 0;
    for (std::size_t k = 0; k < Conditions::count; ++k) {
      const auto& slopes = over_box[k].derivatives();
      const Enclosure mean_value = at_centre[k] + slopes[0] * (p - Enclosure(p.middle())) +
                                   slopes[1] * (d - Enclosure(d.middle()));
      const Enclosure value = intersection(mean_value, over_box[k].value());
      if (value.is_negative()) return ProvedStability::unstable;
      if (k < Conditions::sufficing && value.is_positive()) ++positive;
    }
    return positive == Conditions::sufficing ? ProvedStability::stable : ProvedStability::undecided;
  }

 private:
  using Conditions = detail::HurwitzConditions<Enclosure, Degree>;
  using Moving = Eigen::AutoDiffScalar<Vector<Enclosure, 2>>;

  auto moving_coefficients(const Enclosure& p, const Enclosure& d) const {
    const Polynomial<Enclosure, Degree> values = polynomial_.at({p, d});
    std::array<Moving, Conditions::n + 1> a;
    for (int k = 0; k <= Degree; ++k)
      a[static_cast<std::size_t>(k)] = {
          values[k],
          Vector<Enclosure, 2>(polynomial_.proportional[k], polynomial_.differential[k])};
    return a;
  }

  HalfPlanePolynomial<Enclosure, Degree> polynomial_;
};

namespace detail {

inline PdGains<double> middle_of(const GainBox& box) {
  return {Enclosure(box.proportional_from, box.proportional_to).middle(),
          Enclosure(box.differential_from, box.differential_to).middle()};
}

inline std::vector<GainBox> cells_of(const GainGrid& grid) {
  std::vector<GainBox> cells;
  for (std::int64_t i = 0; i + 1 < grid.proportional.count; ++i)
    for (std::int64_t j = 0; j + 1 < grid.differential.count; ++j)
      cells.push_back({grid.proportional.at(i), grid.proportional.at(i + 1),
                       grid.differential.at(j), grid.differential.at(j + 1)});
  return cells;
}

/// Rejects a grid without cells or with cells as narrow as round-off, or a share outside 0 … 1.
inline void validate_proved(const GainGrid& grid, double undecided) {
  validate(grid);
  for (const Axis& axis : {grid.proportional, grid.differential}) {
    const auto count = static_cast<double>(axis.count);
    require_within("number of grid points along an axis", count, "", 2.0, 1e9);
    // In narrower cells rounding might change the order of the points.
    const double size = std::max(std::abs(axis.min), std::abs(axis.max));
    const double least = 16.0 * std::numeric_limits<double>::epsilon() * size;
    if (!((axis.max - axis.min) / count > least))
      throw InvalidParameter("width of a cell of the chart", (axis.max - axis.min) / (count - 1.0),
                             "", "larger than round-off: give fewer points or a wider range");
  }
  require_within("largest undecided share", undecided, "", 0.0, 1.0);
}

inline void sort_boxes(ProvedChart& chart) {
  std::sort(chart.boxes.begin(), chart.boxes.end(), [](const ProvedBox& a, const ProvedBox& b) {
    return std::pair(a.gains.proportional_from, a.gains.differential_from) <
           std::pair(b.gains.proportional_from, b.gains.differential_from);
  });
}

/// The four quarters of a box; empty where a side has no double between its ends.
inline std::vector<GainBox> quarters_of(const GainBox& box) {
  const auto [p0, p2, d0, d2] = box;
  const double p1 = 0.5 * p0 + 0.5 * p2, d1 = 0.5 * d0 + 0.5 * d2;
  if (!(p0 < p1 && p1 < p2 && d0 < d1 && d1 < d2)) return {};
  return {{p0, p1, d0, d1}, {p0, p1, d1, d2}, {p1, p2, d0, d1}, {p1, p2, d1, d2}};
}

/// Quarters undecided boxes repeatedly. It stops when their area is at most `most_area` (N²·s/m²),
/// when none can be divided, or when quartering might give more than `most_boxes` boxes.
/// @param open     undecided items, each with a box `gains`; on return those still undecided
/// @param take     function (item, quarter) that adds the quarter to `open` or to the decided boxes
/// @param decided  function () → number of decided boxes
template <class Open, class Take, class Decided>
void quarter(std::vector<Open>& open, double most_area, std::size_t most_boxes, const Take& take,
             const Decided& decided) {
  const auto area = [&] {
    double sum = 0.0;
    for (const Open& box : open) sum += box.gains.area();
    return sum;
  };
  bool refined = true;
  while (refined && area() > most_area && decided() + 4 * open.size() <= most_boxes) {
    refined = false;
    for (Open& box : std::exchange(open, {})) {
      const auto quarters = quarters_of(box.gains);
      refined = refined || !quarters.empty();
      for (const GainBox& part : quarters) take(box, part);
      if (quarters.empty()) open.push_back(std::move(box));
    }
  }
}

}  // namespace detail

/// Computes a chart of proved stability. The first boxes are the cells of the grid. Undecided boxes
/// are quartered until they make up at most the fraction `undecided` of the chart's area.
/// @param decide      function from GainBox to ProvedStability, for example a GainBoxProof
/// @param grid        grid points, at least 2 on each ascending axis; cells lie between the points
/// @param undecided   accepted undecided fraction of the area, 0 … 1
/// @param most_boxes  largest number of boxes; quartering stops before it might be exceeded
/// @throws InvalidParameter where the grid or the share is not admissible
template <class Decide>
ProvedChart proved_chart(const Decide& decide, const GainGrid& grid, double undecided = 1e-3,
                         std::size_t most_boxes = std::size_t{1} << 22) {
  detail::validate_proved(grid, undecided);
  ProvedChart chart;
  std::vector<ProvedBox> open;
  const auto take = [&](const ProvedBox&, const GainBox& box) {
    const ProvedStability stability = decide(box);
    (stability == ProvedStability::undecided ? open : chart.boxes).push_back({box, stability});
  };
  double whole = 0.0;
  for (const GainBox& cell : detail::cells_of(grid)) {
    whole += cell.area();
    take({}, cell);
  }
  detail::quarter(open, undecided * whole, most_boxes, take, [&] { return chart.boxes.size(); });
  chart.boxes.insert(chart.boxes.end(), open.begin(), open.end());
  detail::sort_boxes(chart);
  return chart;
}

/// Stability proof over boxes of gains for the continuous loop of two masses without delay. The
/// proof includes all decimal parameters that round to the given doubles.
/// @throws InvalidParameter where the two masses are not admissible
inline GainBoxProof<4> gain_box_proof(const TwoMass<double>& plant) {
  return GainBoxProof<4>(characteristic_polynomial(enclosed(plant)));
}

/// Stability proof over boxes of gains for the sampled loop of two masses. The proof includes all
/// decimal parameters that round to the given doubles.
/// @throws InvalidParameter where the two masses or the sampling are not admissible
inline GainBoxProof<5> gain_box_proof(const TwoMass<double>& plant,
                                      const Sampling<double>& sampling) {
  const auto loop = sampled_loop(enclosed(plant), enclosed(sampling));
  return GainBoxProof<5>(in_half_plane(characteristic_polynomial(loop)));
}

}  // namespace holdfast
