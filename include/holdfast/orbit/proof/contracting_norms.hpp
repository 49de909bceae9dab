#pragma once

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "holdfast/core/types.hpp"
#include "holdfast/math/enclosure/enclosure.hpp"
#include "holdfast/math/enclosure/positive_definite.hpp"
#include "holdfast/orbit/proof/contracting_forms.hpp"

namespace holdfast {

/// Norms V_j of deviations e along a periodic sequence of linear maps M_0 … M_{N−1}, one norm per
/// sample j. The sequence is proved to contract in these norms, which form a Lyapunov function,
///
///     V_j(e)² = eᵀ P_j e,   V_{j+1}(M_j e) ≤ s_j V_j(e),   s_{N−1} … s_0 < 1
///
/// The matrices P_j are computed in doubles and then treated as exact. Interval elimination proves
/// the inequalities. Hence all multipliers (eigenvalues of M_{N−1} … M_0) have moduli ≤ s_{N−1} …
/// s_0. @tparam Size  number of entries of e
template <int Size>
class ContractingNorms {
 public:
  /// The two maps of a loop, in the backlash and engaged, as interval matrices (Enclosure).
  using Maps = std::array<Matrix<Enclosure, Size>, 2>;

  /// Computes the norms and proves that the maps of each given loop contract. If loops at the ends
  /// (corners) of parameter ranges are given, the proof is valid for all loops between them, since
  /// eᵀMᵀPM e is convex in M.
  /// @param corners      maps of the loops at the corners; one entry for a single loop
  /// @param sequence     for each sample j the index of M_j in Maps, 0 or 1; not empty
  /// @param log_modulus  estimate of ln |λ| for the multiplier λ of largest modulus
  /// @return nullopt if log_modulus ≥ 0 or no norms are found in which the sequence contracts
  static std::optional<ContractingNorms> of(const std::vector<Maps>& corners,
                                            const std::vector<std::uint8_t>& sequence,
                                            double log_modulus) {
    if (!(log_modulus < 0.0)) return std::nullopt;
    const double rate = detail::contracting_rate(log_modulus, sequence.size());
    const std::array<Form, 2> middles{middle(corners, 0), middle(corners, 1)};
    const Form identity = Form::Identity(middles[0].rows(), middles[0].cols());
    auto forms = detail::contracting_forms<Size>(
        sequence.size(), [&](std::size_t j) -> const Form& { return middles.at(sequence[j]); },
        [&](std::size_t) -> const Form& { return identity; }, rate);
    if (!forms) return std::nullopt;
    ContractingNorms norms;
    norms.forms_ = std::move(*forms);
    norms.factors_.resize(sequence.size());
    if (!norms.prove(corners, sequence, rate)) return std::nullopt;
    return norms;
  }

  /// An upper bound of the norm V_j(e), j = `sample`, over all e in the intervals of `vector`.
  Enclosure size(std::size_t sample, const Vector<Enclosure, Size>& vector) const {
    const Vector<Enclosure, Size> image = forms_[sample].template cast<Enclosure>() * vector;
    return sqrt(Enclosure(vector.dot(image).magnitude()));
  }
  /// The contraction factor s_j of a sample.
  double factor(std::size_t sample) const { return factors_[sample]; }
  /// An upper bound of the product s_{N−1} … s_0; below 1.
  double contraction() const { return contraction_; }

  /// An upper bound of |row · e| / V_j(e), j = `sample`, over all deviations e ≠ 0.
  double reading(std::size_t sample, const RowVector<double, Size>& row) const {
    // κ² P − rowᵀ row ≥ 0, κ² = row P⁻¹ rowᵀ but for rounding; P ≥ I/2 is proved.
    const Form& form = forms_[sample];
    const double exact = row.dot(form.llt().solve(row.transpose()));
    const Enclosure squared(exact * (1.0 + 1e-9));
    const Vector<Enclosure, Size> column = row.transpose().template cast<Enclosure>();
    const Matrix<Enclosure, Size> left =
        form.template cast<Enclosure>() * squared - column * column.transpose();
    if (is_positive_definite<Size>(left)) return sqrt(squared).upper();
    return sqrt(Enclosure(2.0) * Enclosure(column.dot(column).magnitude())).upper();
  }

 private:
  using Form = Matrix<double, Size>;

  /// The mean of one of the two maps over all corners.
  static Form middle(const std::vector<Maps>& corners, std::size_t which) {
    Form sum = corners.front().at(which).template cast<double>();
    for (std::size_t k = 1; k < corners.size(); ++k)
      sum += corners[k].at(which).template cast<double>();
    return sum / static_cast<double>(corners.size());
  }

  bool prove(const std::vector<Maps>& corners, const std::vector<std::uint8_t>& sequence,
             double rate) {
    Enclosure product(1.0);
    for (std::size_t j = 0; j < sequence.size(); ++j) {
      const Form& next = forms_[j + 1 == sequence.size() ? 0 : j + 1];
      const Matrix<Enclosure, Size> form = forms_[j].template cast<Enclosure>();
      const Matrix<Enclosure, Size> half =
          Matrix<Enclosure, Size>::Identity(form.rows(), form.cols()) * Enclosure(0.5);
      if (!is_positive_definite<Size>(form - half)) return false;
      const auto shrinks = [&](const Maps& maps, double factor) {
        const Matrix<Enclosure, Size>& map = maps.at(sequence[j]);
        const Matrix<Enclosure, Size> moved =
            map.transpose() * (next.template cast<Enclosure>() * map).eval();
        return is_positive_definite<Size>(form * square(Enclosure(factor)) - moved);
      };
      // The forms solve the equation for the mean of the corners, and only up to rounding.
      double factor = rate, more = 1e-12;
      while (!std::all_of(corners.begin(), corners.end(),
                          [&](const Maps& maps) { return shrinks(maps, factor); })) {
        if (more > 0.1) return false;
        factor = rate * (1.0 + more);
        more *= 10.0;
      }
      factors_[j] = factor;
      product *= Enclosure(factor);
    }
    contraction_ = product.upper();
    return contraction_ < 1.0;
  }

  std::vector<Form> forms_;
  std::vector<double> factors_;
  double contraction_ = 1.0;
};

}  // namespace holdfast
