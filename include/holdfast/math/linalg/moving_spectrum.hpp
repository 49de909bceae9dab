#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <vector>

#include "holdfast/core/types.hpp"
#include "holdfast/math/linalg/balancing.hpp"
#include "holdfast/math/linalg/eigenbasis.hpp"
#include "holdfast/math/linalg/elimination.hpp"
#include "holdfast/math/linalg/taylor_number.hpp"

namespace holdfast {

/// A real n × n matrix S(x) for −1 ≤ x ≤ 1 as a Taylor polynomial plus a bounded remainder R(x):
///
///     S(x) = I + Σ_k terms[k] xᵏ + R(x),   |R_ij(x)| ≤ remainder_ij
struct TaylorMatrix {
  std::vector<Eigen::MatrixXd> terms;  ///< n × n coefficients of x⁰, x¹, … of S − I; two or more
  Eigen::MatrixXd remainder;           ///< bounds of |R_ij(x)|, n × n, ≥ 0
};

/// A complex vector of n entries, for −1 ≤ x ≤ 1: Σ_k terms[k] xᵏ plus a bounded remainder.
struct MovingVector {
  std::vector<Eigen::VectorXcd> terms;  ///< coefficients of x⁰, x¹, …, each n × 1
  Eigen::VectorXd remainder;            ///< bounds of the remainder's moduli, n × 1, ≥ 0
};

/// An attempt to prove that |λ| < 1 for all eigenvalues λ of a `TaylorMatrix` S(x), −1 ≤ x ≤ 1.
///
/// Let T(x) be S(x) in a basis in which S(0) is upper triangular. A unit lower triangular W(x) =
/// I + Σ_{k ≥ 1} W_k xᵏ and an upper triangular D(x) are computed, power by power of x, such that
///
///     T W = W D + E,   where the series of E begins with the first omitted power.
///
/// Hence S(x) has the eigenvalues of D + W⁻¹E, which are close to D_ii. Moduli and inequalities of
/// matrices are meant entry by entry: |W⁻¹| ≤ (I − Σ|W_k|)⁻¹, since W − I is nilpotent. |D_ii| is
/// bounded by the Taylor polynomial of |D_ii|². Let B be a bound of |D| + |W⁻¹E| for all x. Then
/// the spectral radius of S(x) satisfies
///
///     ρ(S(x)) ≤ ρ(B) < 1   if v = (I − B)⁻¹ [1, …, 1]ᵀ > 0                (Perron, Frobenius)
///
/// If eigenvalues i and j are so close that the series of W_ij may diverge, W_ij is set to 0, and D
/// keeps its entry below the diagonal. A bound of the round-off is added to the remainder of S.
/// Work: about 3 m² products of n × n matrices for m terms.
/// Source: R. A. Horn, C. R. Johnson, Matrix Analysis, 2nd ed., 8.1 and 8.3.
template <class Scalar = double>
class MovingSpectrum {
 public:
  using Complex = std::complex<Scalar>;  ///< complex type of the triangular form

  /// Attempts the proof. @param matrix  matrix S(x); the proof fails if an entry is not finite
  /// @throws InvalidParameter for fewer than two terms, or where the sizes disagree
  explicit MovingSpectrum(const TaylorMatrix& matrix);

  /// Whether all eigenvalues of S(0), as computed in floating point, have a modulus < 1.
  bool inside_at_centre() const { return inside_at_centre_; }

  /// Whether the proof succeeded: |λ| < 1 for all eigenvalues λ of S(x), −1 ≤ x ≤ 1.
  bool inside() const { return inside_; }

  /// The frequency responses c (λ(x) I − S(x))⁻¹ g(x), one for each row c, as Taylor polynomials
  /// with remainder, valid if `inside()` and |λ(x)| = 1 for all x. The remainder bounds truncation,
  /// but not round-off, by |(λI − T)⁻¹| ≤ (I + Σ|W_k|) (I − B)⁻¹ (I − Σ|W_k|)⁻¹.
  /// @param from_one  number λ(x) − 1, with as many terms as S
  /// @param source    input vector g(x), with as many terms as S
  /// @param rows      matrix of n columns; its rows are the output vectors c
  /// @throws InvalidParameter where the number of terms or the width of a row differs from S
  std::vector<TaylorNumber> responses(const TaylorNumber& from_one, const MovingVector& source,
                                      const Eigen::MatrixXd& rows) const;

 private:
  using Form = Matrix<Complex, Eigen::Dynamic>;
  using Bound = Matrix<Scalar, Eigen::Dynamic>;
  using Pairs = Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic>;

  Eigen::Index size() const { return terms_.front().rows(); }
  std::size_t order() const { return terms_.size() - 1; }

  /// Transforms the terms and the remainder to the coordinates V = Q X, in which S(0) is diagonal
  /// except for pairs of close eigenvalues.
  void take(const TaylorMatrix& matrix) {
    const Eigen::Index n = matrix.remainder.rows();
    const BalancedMatrix<double, Eigen::Dynamic> similar(matrix.terms.front());
    const Eigen::VectorXd factors = similar.factors, inverse = factors.cwiseInverse();
    const auto balanced = [&](const Eigen::MatrixXd& entries) -> Eigen::MatrixXd {
      return inverse.asDiagonal() * entries * factors.asDiagonal();
    };
    const Form unitary = detail::TriangularForm<Scalar>(similar.balanced).basis;
    const Form form = unitary.adjoint() * (similar.balanced * unitary);
    find_cleared(form, unitary.adjoint() * (balanced(matrix.terms[1]) * unitary));
    const Form x = diagonalising(form);
    const Form basis = unitary * x, back = unit_upper_inverse_times(x, unitary.adjoint());
    basis_ = factors.asDiagonal() * basis;
    back_ = back * inverse.asDiagonal();
    Bound rounded = Bound::Zero(n, n);
    for (const Eigen::MatrixXd& term : matrix.terms) {
      const Eigen::MatrixXd entries = balanced(term);
      terms_.push_back(back * (entries * basis));
      rounded += entries.cwiseAbs();
    }
    remainder_ =
        back.cwiseAbs() * (rounding() * rounded + balanced(matrix.remainder)) * basis.cwiseAbs();
    count_inverse(back, basis);
    remainder_ += terms_[0].cwiseAbs().template triangularView<Eigen::StrictlyLower>();
    terms_[0].template triangularView<Eigen::StrictlyLower>().setZero();
  }

  /// A bound of the relative round-off of the matrix products in this class.
  Scalar rounding() const {
    return Scalar(4) * static_cast<Scalar>(static_cast<std::size_t>(size()) + terms_.size()) *
           std::numeric_limits<Scalar>::epsilon();
  }

  /// Adds to the remainder the error of using `back` for V⁻¹, V = `basis`. If back·V = I + G, then
  /// V⁻¹ S V = (I + G)⁻¹ (back S V). If |G| is not small, the remainder is ∞ and the proof fails.
  void count_inverse(const Form& back, const Form& basis) {
    const Bound identity = Bound::Identity(size(), size());
    off_ = (back * basis - Form::Identity(size(), size())).cwiseAbs() +
           rounding() * (back.cwiseAbs() * basis.cwiseAbs());
    if (!(off_.rowwise().sum().maxCoeff() < Scalar(0.5))) {
      remainder_.setConstant(std::numeric_limits<Scalar>::infinity());
      return;
    }
    off_ = eliminated(Bound(identity - off_), off_).cwiseAbs();
    Bound all = remainder_;
    for (const Form& term : terms_) all += term.cwiseAbs();
    remainder_ += off_ * all;
  }

  /// Selects the pairs of eigenvalues far enough apart for the series of W to converge. They are
  /// called uncoupled, since W makes D zero below the diagonal for these pairs.
  void find_cleared(const Form& form, const Form& moved) {
    const Eigen::Index n = form.rows();
    cleared_ = Pairs::Constant(n, n, false);
    for (Eigen::Index j = 0; j < n; ++j) {
      for (Eigen::Index i = j + 1; i < n; ++i) {
        const double there = std::abs(moved(i, j)), coupled = std::abs(form(j, i));
        const double back = coupled + std::abs(moved(j, i));
        const double drift = std::abs(moved(i, i) - moved(j, j)) + 2.0 * std::sqrt(there * back);
        const double distance = std::abs(form(i, i) - form(j, j));
        cleared_(i, j) = cleared_(j, i) = drift < 0.6 * distance && coupled < 1e5 * distance;
      }
    }
  }

  /// The unit upper triangular X for which (X⁻¹ T X)_ij = 0, i < j, for each uncoupled pair (i, j).
  Form diagonalising(const Form& t) const {
    const Eigen::Index n = t.rows();
    Form x = Form::Identity(n, n), d = t;
    for (Eigen::Index width = 1; width < n; ++width) {
      for (Eigen::Index i = 0, j = width; j < n; ++i, ++j) {
        Complex left = t(i, j);
        for (Eigen::Index p = i + 1; p < j; ++p) left += t(i, p) * x(p, j) - x(i, p) * d(p, j);
        d(i, j) = cleared_(i, j) ? Complex(0) : left;
        if (cleared_(i, j)) x(i, j) = left / (t(j, j) - t(i, i));
      }
    }
    return x;
  }

  static Form unit_upper_inverse_times(const Form& x, Form right) {
    for (Eigen::Index i = x.rows() - 1; i >= 0; --i)
      for (Eigen::Index p = i + 1; p < x.rows(); ++p) right.row(i) -= x(i, p) * right.row(p);
    return right;
  }

  /// The product (νI − T₀)⁻¹ r for a column r and the upper triangular T₀.
  Eigen::VectorXcd solved(const Complex& nu, Eigen::VectorXcd right) const {
    for (Eigen::Index i = size() - 1; i >= 0; --i) {
      for (Eigen::Index p = i + 1; p < size(); ++p) right[i] += terms_[0](i, p) * right[p];
      right[i] /= nu - terms_[0](i, i);
    }
    return right;
  }

  /// Appends the coefficients W_k and D_k = r + T₀W_k − W_kT₀ of the next power k of x, where
  /// r = T_k + Σ_{0<l<k} (T_l W_{k−l} − W_l D_{k−l}). W_k is such that (D_k)_ij = 0, i > j, for
  /// each uncoupled pair (i, j).
  void split(const Form& r) {
    const Form& t = terms_[0];
    const Eigen::Index n = size();
    Form w = Form::Zero(n, n);
    for (Eigen::Index i = n - 1; i > 0; --i) {
      for (Eigen::Index j = 0; j < i; ++j) {
        if (!cleared_(i, j)) continue;
        Complex right = -r(i, j);
        for (Eigen::Index p = i + 1; p < n; ++p) right -= t(i, p) * w(p, j);
        for (Eigen::Index q = 0; q < j; ++q) right += w(i, q) * t(q, j);
        w(i, j) = right / (t(i, i) - t(j, j));
      }
    }
    Form d = r + t * w - w * t;
    for (Eigen::Index j = 0; j < n; ++j)
      for (Eigen::Index i = j + 1; i < n; ++i)
        if (cleared_(i, j)) d(i, j) = 0.0;
    turning_.push_back(std::move(w));
    diagonal_.push_back(std::move(d));
  }

  void split_all() {
    const Eigen::Index n = size();
    turning_.push_back(Form::Zero(n, n));
    diagonal_.push_back(terms_[0]);
    for (std::size_t k = 1; k <= order(); ++k) {
      Form r = terms_[k];
      for (std::size_t l = 1; l < k; ++l)
        r += terms_[l] * turning_[k - l] - turning_[l] * diagonal_[k - l];
      split(r);
    }
  }

  /// The sums Σ_{k > s} |F_k| of the moduli of matrices F_k (`forms`), for every index s.
  static std::vector<Bound> sums_beyond(const std::vector<Form>& forms) {
    std::vector<Bound> sums(forms.size(), Bound::Zero(forms[0].rows(), forms[0].cols()));
    for (std::size_t s = forms.size() - 1; s > 0; --s) sums[s - 1] = sums[s] + forms[s].cwiseAbs();
    return sums;
  }

  /// A lower bound of 1 − |D_ii(x)| for all x; if it is ≤ 0, the proof fails.
  double distance(Eigen::Index i) const {
    const std::size_t m = order();
    double outside = 0.0;  // |D|² − 1, at most
    for (std::size_t k = 0; k <= 2 * m; ++k) {
      double q = k <= m ? 2.0 * diagonal_[k](i, i).real() : 0.0;
      for (std::size_t l = k > m ? k - m : 0; l <= std::min(k, m); ++l)
        q += (diagonal_[l](i, i) * std::conj(diagonal_[k - l](i, i))).real();
      outside += k == 0 ? q : k % 2 == 0 ? std::max(q, 0.0) : std::abs(q);
    }
    return -outside / (1.0 + std::sqrt(std::max(0.0, 1.0 + outside)));
  }

  void bound() {
    split_all();
    const Eigen::Index n = size();
    const Bound identity = Bound::Identity(n, n);
    const std::vector<Bound> turned = sums_beyond(turning_), kept = sums_beyond(diagonal_);
    turned_ = turned[0];
    Bound missed = remainder_ * (identity + turned_);
    for (std::size_t l = 1; l <= order(); ++l)
      missed +=
          terms_[l].cwiseAbs() * turned[order() - l] + turning_[l].cwiseAbs() * kept[order() - l];
    // Unit lower triangular: solved from the top, nothing is subtracted.
    const Bound unit = identity - turned_;
    missed = unit.template triangularView<Eigen::UnitLower>().solve(missed);
    reserve_ = -(kept[0] + diagonal_[0].cwiseAbs() + missed);
    for (Eigen::Index i = 0; i < n; ++i) {
      const double reserve = distance(i) - missed(i, i);
      if (!(reserve > 0.0)) return;
      reserve_(i, i) = reserve;
    }
    const Eigen::VectorXd v = eliminated(reserve_, Eigen::VectorXd(Eigen::VectorXd::Ones(n)));
    inside_ = v.allFinite() && v.minCoeff() > 0.0 && (reserve_ * v).minCoeff() > 0.5;
  }

  Pairs cleared_;                         // which pairs of eigenvalues are uncoupled
  std::vector<Form> terms_;               // T_k, of S − I
  Bound remainder_;                       // bound of R in the basis V
  Bound off_;                             // |V⁻¹ back⁻¹ − I|
  std::vector<Form> turning_, diagonal_;  // W_k and D_k, of W − I and D − I
  Form basis_, back_;                     // V and V⁻¹ of the matrix as it is given
  Bound turned_;                          // Σ |W_k|
  Bound reserve_;                         // I − B
  bool inside_at_centre_ = false, inside_ = false;
};

template <class Scalar>
MovingSpectrum<Scalar>::MovingSpectrum(const TaylorMatrix& matrix) {
  require_within("number of terms", static_cast<double>(matrix.terms.size()), "", 2.0, 1e6);
  for (const Eigen::MatrixXd& term : matrix.terms) {
    require_size("rows of a Taylor term", term.rows(), matrix.remainder.rows());
    require_size("columns of a Taylor term", term.cols(), matrix.remainder.cols());
  }
  if (!matrix.terms.front().allFinite()) return;
  take(matrix);
  inside_at_centre_ =
      ((2.0 * terms_[0].diagonal().real() + terms_[0].diagonal().cwiseAbs2()).maxCoeff() < 0.0);
  if (inside_at_centre_ && remainder_.allFinite()) bound();
}

template <class Scalar>
std::vector<TaylorNumber> MovingSpectrum<Scalar>::responses(const TaylorNumber& from_one,
                                                            const MovingVector& source,
                                                            const Eigen::MatrixXd& rows) const {
  require_size("number of terms", static_cast<Eigen::Index>(from_one.terms.size()),
               static_cast<Eigen::Index>(terms_.size()));
  require_size("number of terms", static_cast<Eigen::Index>(source.terms.size()),
               static_cast<Eigen::Index>(terms_.size()));
  require_size("columns of the rows", rows.cols(), size());
  std::vector<Eigen::VectorXcd> y;
  std::vector<Eigen::VectorXd> beyond(order() + 1, Eigen::VectorXd::Zero(size()));
  for (std::size_t k = 0; k <= order(); ++k) {
    Eigen::VectorXcd right = back_ * source.terms[k];
    for (std::size_t l = 1; l <= k; ++l)
      right += terms_[l] * y[k - l] - from_one.terms[l] * y[k - l];
    y.push_back(solved(from_one.terms[0], std::move(right)));
  }
  for (std::size_t k = order(); k > 0; --k) beyond[k - 1] = beyond[k] + y[k].cwiseAbs();
  const Eigen::VectorXd all = beyond[0] + y[0].cwiseAbs();
  Eigen::VectorXd missed =
      back_.cwiseAbs() * source.remainder + remainder_ * all + from_one.remainder * all;
  for (std::size_t l = 1; l <= order(); ++l)
    missed += terms_[l].cwiseAbs() * beyond[order() - l] +
              std::abs(from_one.terms[l]) * beyond[order() - l];
  const Bound unit = Bound::Identity(size(), size()) - turned_;
  missed = unit.template triangularView<Eigen::UnitLower>().solve(missed);
  missed = eliminated(reserve_, missed).cwiseAbs();
  missed += turned_ * missed;
  std::vector<TaylorNumber> result;
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    const Eigen::RowVectorXcd row = rows.row(i) * basis_;
    result.push_back({{}, row.cwiseAbs().dot(missed)});
    for (const Eigen::VectorXcd& term : y) result.back().terms.push_back((row * term).value());
  }
  return result;
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template class MovingSpectrum<double>;
#endif

}  // namespace holdfast
