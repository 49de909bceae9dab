#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "holdfast/core/types.hpp"
#include "holdfast/math/linalg/complex_exponential.hpp"
#include "holdfast/math/poly/polynomial.hpp"

namespace holdfast {

/// The characteristic function p of a sampled loop as a sum over the poles 1 + ε_k of its plant:
///
///     p(λ) = 1 − λ^{−n} w(rλ) (g/λ + Σ (a_k + b_k/λ)/(λ − 1 − ε_k)),   w(λ) = c + d (1 − 1/λ)
///
/// λ^{−n} is a delay of n sampling periods; r ≠ 1 scales the roots, see `radius`. The control gains
/// are factors of a, b and g, or of c and d.
template <class Scalar>
struct PoleSum {
  using Complex = std::complex<Scalar>;  ///< type of poles and residues

  /// The term (a + b/λ)/(λ − 1 − ε) of one pole in the sum.
  struct Part {
    Complex increment;  ///< ε, the pole minus one; accurate also for a pole close to 1
    Complex present;    ///< coefficient a of the sum
    Complex past;       ///< coefficient b of the sum, by which the previous command acts
  };

  /// The filter w(λ) = c + d (1 − 1/λ) of the sensor readings.
  struct Weight {
    Scalar constant;  ///< factor c of the present reading
    Scalar change;    ///< factor d of the difference between present and previous reading
  };

  std::vector<Part> parts;              ///< terms of all poles
  Complex past{0};                      ///< coefficient g of the term g/λ
  Weight weight{Scalar(1), Scalar(0)};  ///< filter w, common to all terms
  Scalar radius{1};  ///< scale r > 0: if λ is a root of p, the loop has root rλ
  int power = 0;     ///< delay n ≥ 0 in sampling periods
};

namespace detail {

/// The simultaneous iteration for all roots of a PoleSum (Ehrlich 1967, Aberth 1973): each root is
/// improved by a Newton step for p with all other roots divided out. Except for the extra roots, a
/// root λ is stored as the difference d = λ − e from a pole e, so that a small d is accurate. A
/// root is found separately, with a Taylor series for the other poles, if it is closer to its pole
/// than half the pole's distance to the next pole and to 0. Such roots are all distinct.
template <class Scalar>
class RootIteration {
 public:
  using Complex = std::complex<Scalar>;

  /// @param extra     number of roots in excess of the poles: order of the pole of p at λ = 0
  /// @param mirrored  whether roots of conjugate poles are first assumed to be conjugate
  RootIteration(const PoleSum<Scalar>& sum, int extra, bool mirrored)
      : weight_(sum.weight),
        radius_(sum.radius),
        power_(sum.power),
        past_(sum.past),
        poles_(sum.parts.size()),
        settled_(poles_ + static_cast<std::size_t>(extra), 0),
        steps_(settled_.size()) {
    for (const auto& part : sum.parts) {
      parts_.push_back({part.increment, part.present, part.past, Complex(0)});
      if (part.past != Complex(0)) past_from_ = std::min(past_from_, parts_.blocks().size() - 1);
    }
    find_mirrors(mirrored);
    std::vector<Complex> first(poles_);
    for (std::size_t i = 0; i < poles_; ++i) {
      settled_[i] = mirrors_[i] < i ? 1 : 0;
      if (settled_[i] == 0) first[i] = first_of(i);
    }
    for (std::size_t i = 0; i < poles_; ++i)
      set_distance(i, mirrors_[i] < i ? std::conj(first[mirrors_[i]]) : first[i]);
    for (int j = 0; j < extra; ++j)
      extras_.push_back(std::polar(
          Scalar(0.3), Scalar(0.7) + Scalar(2) * pi<Scalar> * Scalar(j) / Scalar(extra)));
  }

  /// Iterates. @return whether all roots converged and their sum agrees with the polynomial
  bool converge() {
    for (int sweep = 0; sweep < 200; ++sweep) {
      bool all = true;
      for (std::size_t i = 0; i < settled_.size(); ++i) {
        if (settled_[i] == 0) settled_[i] = improve(i) ? 1 : 0;
        all = all && settled_[i] != 0;
      }
      if (all) return has_their_sum();
      if (sweep == 20) part_mirrors();
      // Round-off of roots close to each other, or to 0, hides the last digits.
      if (sweep != 40) continue;
      tolerance_ = Scalar(1e-12);
      floor_ = Scalar(1e-15);
    }
    return false;
  }

  std::vector<Complex> roots() const {
    std::vector<Complex> found = extras_;
    for (std::size_t i = 0; i < poles_; ++i)
      found.push_back(Complex(1) + (parts_[i][0] + parts_[i][3]));
    return found;
  }

 private:
  using Row = typename ComplexRows<Scalar, 4>::Row;  // e − 1, a, b and d
  static constexpr Scalar parked{-8};                // an e − 1 that no root is near

  /// The Taylor series about a root λ of the sums over all poles e but the root's own: coefficients
  /// Σ a/(λ − e)^{m+1} and Σ b/(λ − e)^{m+1} of (−δ)^m at λ + δ. `nearest` is the distance of the
  /// nearest of these poles.
  struct Series {
    static constexpr std::size_t terms = 3;
    std::array<Complex, terms> a, b;
    Scalar nearest;
  };

  /// The sums over all poles e at a given λ, with their derivatives by λ.
  struct Sums {
    Complex a, b, slope_a, slope_b;  ///< Σ a/(λ − e) and g + Σ b/(λ − e)
    Complex divided_out;             ///< Σ (1/(λ − e) − 1/(λ − z)), z being the roots
  };

  /// The factors λ^{−n} w and λ^{−n−1} w of the sums a and b, with their derivatives.
  struct Factors {
    Complex a, b, slope_a, slope_b;

    Complex of(const Complex& in_a, const Complex& in_b) const { return a * in_a + b * in_b; }
    Complex slope_of(const Complex& in_a, const Complex& in_b) const {
      return slope_a * in_a + slope_b * in_b;
    }
  };

  struct Value {
    Complex value, slope;
  };

  /// Finds the conjugate of each pole; a pole without a conjugate is paired with itself.
  void find_mirrors(bool mirrored) {
    for (std::size_t i = 0; i < poles_; ++i) mirrors_.push_back(i);
    std::size_t begin = 0;  // conjugates are mostly in the same order
    for (std::size_t i = 0; mirrored && i < poles_; ++i) {
      const Complex wanted = std::conj(parts_[i][0]);
      for (std::size_t j = 0; j < poles_ && wanted.imag() > 0; ++j) {
        const std::size_t other = (begin + j) % poles_;
        if (mirrors_[other] != other || parts_[other][0] != wanted) continue;
        mirrors_[i] = other;
        mirrors_[other] = i;
        begin = other + 1;
        break;
      }
    }
  }

  /// The difference d of root i from its pole: final if the root is found separately, otherwise a
  /// first estimate. The estimate is not real, since iterates from the real axis would stay real.
  Complex first_of(std::size_t i) {
    Row own = parts_[i];
    own[3] = Complex(0);
    Series others = series_about(i, own);
    const Factors at = factors_at(own[0]);
    const Complex first = std::polar(Scalar(1), Scalar(0.1)) * at.of(own[1], own[2]) /
                          rest(at, sums_near(others, Complex(0))).value;
    const Scalar reach = std::min(others.nearest, size_of(Complex(1) + own[0])) / Scalar(2);
    for (int turn = 0; turn < 3; ++turn) {
      const Complex d = near_pole(own, others);
      if (!(size_of(d) < reach)) break;
      if (is_settled_alone(own, others, d)) {
        settled_[i] = settled_[mirrors_[i]] = 1;
        return d;
      }
      own[3] = d;
      others = series_about(i, own);
    }
    return std::isfinite(std::abs(first)) ? first : Complex(1e-3, 1e-3);
  }

  /// The difference d of a root from its pole e, by Newton steps with the poles' Taylor series;
  /// NaN without convergence, for example if the start is real and the root complex.
  Complex near_pole(const Row& own, const Series& others) const {
    Complex d = own[3];
    Scalar before(0);
    for (int step = 0; step < 12; ++step) {
      const Value left =
          without_pole(own, d, factors_at(own[0] + d), sums_near(others, d - own[3]));
      const Complex change = left.value / left.slope;
      d -= change;
      const Scalar size = size_of(change), shrinking = std::min(Scalar(1), size / before);
      if (size * shrinking <= tolerance_ * size_of(d) + floor_) return d;
      before = size;
    }
    return {std::numeric_limits<Scalar>::quiet_NaN(), Scalar(0)};
  }

  /// Whether truncation of the Taylor series hardly moves the root. The omitted terms are estimated
  /// from the last two terms by powers of the ratio of d's change to the nearest pole's distance.
  bool is_settled_alone(const Row& own, const Series& others, const Complex& d) const {
    constexpr std::size_t last = Series::terms - 1;
    const Scalar change = size_of(d - own[3]), ratio = change / others.nearest;
    const auto left_out = [&](const std::array<Complex, Series::terms>& of) {
      return std::pow(change, Scalar(last - 1)) * ratio *
             (size_of(of[last - 1]) * ratio + size_of(of[last]) * change);
    };
    const Factors at = factors_at(own[0] + d);
    const Value left = without_pole(own, d, at, sums_near(others, d - own[3]));
    const Scalar error = size_of(d) / size_of(left.slope) *
                         (size_of(at.a) * left_out(others.a) + size_of(at.b) * left_out(others.b));
    return Scalar(10) * error <= tolerance_ * size_of(d) + floor_;
  }

  /// Restarts unconverged roots of conjugate poles separately, since they may be real and unequal.
  void part_mirrors() {
    for (std::size_t i = 0; i < poles_; ++i) {
      const std::size_t other = std::exchange(mirrors_[i], i);
      if (other <= i || settled_[i] != 0) continue;
      mirrors_[other] = other;
      settled_[other] = 0;
      for (const std::size_t k : {i, other}) set_distance(k, first_of(k));
    }
  }

  /// The modulus |z|, without the overflow protection of std::abs().
  static Scalar size_of(const Complex& z) { return std::sqrt(std::norm(z)); }

  void set_distance(std::size_t i, const Complex& d) {
    Row row = parts_[i];
    row[3] = d;
    parts_.set(i, row);
  }

  /// The Taylor series, over all other poles, about the root that belongs to pole i.
  Series series_about(std::size_t i, const Row& own) {
    Series series{};
    parts_.set(i, {Complex(parked), Complex(0), Complex(0), Complex(0)});
    series.nearest = add_series<1>(own, 0, series.a);
    if (past_from_ < parts_.blocks().size()) add_series<2>(own, past_from_, series.b);
    parts_.set(i, own);
    return series;
  }

  /// Computes a (`column` 1) or b (2) of a `Series` from the poles of blocks `from` and later.
  /// @return distance from λ to the nearest pole
  template <std::size_t column>
  Scalar add_series(const Row& own, std::size_t from,
                    std::array<Complex, Series::terms>& series) const {
    using Lanes = ComplexLanes<Scalar>;
    Lanes first, second, third;
    typename Lanes::Reals nearest = first.re;
    for (std::size_t k = from; k < parts_.blocks().size(); ++k) {
      const auto& block = parts_.blocks()[k];
      const Lanes away = (own[0] - block[0]) + own[3];
      const typename Lanes::Reals scale = (away.re * away.re + away.im * away.im).inverse();
      const Lanes inverse{away.re * scale, -away.im * scale};
      nearest = nearest.max(scale);
      const auto one = block[column] * inverse, two = one * inverse;
      first += one;
      second += two;
      third += two * inverse;
    }
    series = {first.sum(), second.sum(), third.sum()};
    return Scalar(1) / std::sqrt(nearest.maxCoeff());
  }

  /// The sums at a distance δ from the centre of a series, without `divided_out`.
  Sums sums_near(const Series& series, const Complex& delta) const {
    Sums at{series.a.back(), series.b.back(), Complex(0), Complex(0), Complex(0)};
    for (std::size_t m = Series::terms - 1; m-- > 0;) {
      at.slope_a = -at.a - delta * at.slope_a;
      at.slope_b = -at.b - delta * at.slope_b;
      at.a = series.a[m] - delta * at.a;
      at.b = series.b[m] - delta * at.b;
    }
    at.b += past_;
    return at;
  }

  Sums sums_at(const Complex& e, const Complex& d) const {
    ComplexLanes<Scalar> a, b, slope_a, slope_b, divided_out;
    for (std::size_t k = 0; k < parts_.blocks().size(); ++k) {
      const auto& [increment, present, past, distance] = parts_.blocks()[k];
      const auto from_pole = (e - increment) + d, from_root = from_pole - distance;
      const auto both = (from_pole * from_root).inverse(), away = from_root * both;
      const auto of_a = present * away;
      a += of_a;
      slope_a += of_a * away;
      divided_out += distance * both;
      if (k < past_from_) continue;
      const auto of_b = past * away;
      b += of_b;
      slope_b += of_b * away;
    }
    return {a.sum(), b.sum() + past_, -slope_a.sum(), -slope_b.sum(), -divided_out.sum()};
  }

  /// The sums over all other poles at the root that belongs to pole i.
  Sums without(std::size_t i, const Row& own) {
    parts_.set(i, {Complex(parked), Complex(0), Complex(0), Complex(0)});
    const Sums others = sums_at(own[0], own[3]);
    parts_.set(i, own);
    return others;
  }

  Factors factors_at(const Complex& mu) const {
    const Complex back = inverse(Complex(1) + mu);  // 1/λ
    Complex before(1);
    for (int j = 0; j < power_; ++j) before *= back;
    const Complex change = ((radius_ - Scalar(1)) / radius_ + mu) * back;  // 1 − 1/(rλ)
    const Complex a = (weight_.constant + weight_.change * change) * before;
    const Complex slope =
        weight_.change / radius_ * back * back * before - Scalar(power_) * a * back;
    return {a, a * back, slope, (slope - a * back) * back};
  }

  static Value rest(const Factors& at, const Sums& sums) {
    return {Complex(1) - at.of(sums.a, sums.b),
            -at.slope_of(sums.a, sums.b) - at.of(sums.slope_a, sums.slope_b)};
  }

  /// The value and slope of d p(λ), which has no pole at e.
  static Value without_pole(const Row& own, const Complex& d, const Factors& at,
                            const Sums& others) {
    const Value other = rest(at, others);
    return {d * other.value - at.of(own[1], own[2]),
            other.value + d * other.slope - at.slope_of(own[1], own[2])};
  }

  /// The sum Σ (1/λ − 1/(λ − z)) over the extra roots except root i.
  Complex extras_divided_out(std::size_t i, const Complex& lambda) const {
    Complex sum(0);
    for (std::size_t j = 0; j < extras_.size(); ++j) {
      sum += inverse(lambda);
      if (poles_ + j != i) sum -= inverse(lambda - extras_[j]);
    }
    return sum;
  }

  /// Improves root i. @return whether it has converged
  bool improve(std::size_t i) {
    if (i >= poles_) {
      Complex& root = extras_[i - poles_];
      const Sums all = sums_at(root - Complex(1), Complex(0));
      return take(i, root, rest(factors_at(root - Complex(1)), all), all, root);
    }
    const Row own = parts_[i];
    Complex d = own[3];
    const Sums others = without(i, own);
    const Value left = without_pole(own, d, factors_at(own[0] + d), others);
    const bool settled = take(i, d, left, others, Complex(1) + (own[0] + d));
    set_distance(i, d);
    if (mirrors_[i] != i) set_distance(mirrors_[i], std::conj(d));
    return settled;
  }

  /// Takes one step of `unknown`, a root λ or its difference from a pole; a root at 0 is unchanged.
  /// @return whether the root has converged: this step or the next one, as predicted, is negligible
  bool take(std::size_t i, Complex& unknown, const Value& p, const Sums& others,
            const Complex& lambda) {
    const Complex divided_out = others.divided_out + extras_divided_out(i, lambda);
    const Complex step = p.value / (p.slope + p.value * divided_out);
    const Scalar size = std::abs(step);
    if (!std::isfinite(size)) return std::abs(lambda) < Scalar(1e-15);
    unknown -= step;
    const Scalar shrinking = std::min(Scalar(1), size / std::exchange(steps_[i], size));
    return size * shrinking <= tolerance_ * std::abs(unknown) + floor_;
  }

  /// Whether the roots z have the right sum: the sum of the poles, plus w(∞) (g + Σ a) where n = 0.
  bool has_their_sum() const {
    const Scalar weight = weight_.constant + weight_.change;
    Complex sum = power_ == 0 ? -weight * past_ : Complex(0);
    Scalar size(0);
    for (std::size_t i = 0; i < poles_; ++i) {
      const Row row = parts_[i];
      sum += row[3];
      size += std::abs(row[3]);
      if (power_ == 0) sum -= weight * row[1];
    }
    for (const Complex& root : extras_) {
      sum += root;
      size += std::abs(root);
    }
    return std::abs(sum) <= Scalar(1e-9) * size + Scalar(1e-14) * Scalar(poles_);
  }

  typename PoleSum<Scalar>::Weight weight_;
  Scalar radius_;
  int power_;
  Complex past_;                                                     // g
  std::size_t past_from_ = std::numeric_limits<std::size_t>::max();  // first block with a b
  Scalar tolerance_{1e-14}, floor_{1e-17};
  std::size_t poles_;
  std::vector<std::size_t> mirrors_;
  ComplexRows<Scalar, 4> parts_{parked};
  std::vector<Complex> extras_;
  std::vector<char> settled_;
  std::vector<Scalar> steps_;  // last step of each root
};

}  // namespace detail

/// All roots λ of a PoleSum of N poles, by about 3 to 30 iterations of order N² operations each.
/// @param sum     function p with one pole or more; complex poles are in conjugate pairs
/// @param late    whether any coefficient b or g differs from zero
/// @return all roots; empty if n > 19, or if the iteration does not converge to roots with the
///         correct sum, as happens for multiple roots
template <class Scalar>
std::vector<std::complex<Scalar>> pole_sum_roots(PoleSum<Scalar> sum, bool late) {
  using Complex = std::complex<Scalar>;
  const auto all = std::exchange(sum.parts, {});
  // Poles that decay within a sample count as one pole at λ = 0; the others become roots there.
  typename PoleSum<Scalar>::Part dead{Complex(-1), Complex(0), Complex(0)};
  std::size_t of_dead = 0;
  for (const auto& part : all) {
    if (std::abs(Complex(1) + part.increment) > Scalar(1e-14)) {
      sum.parts.push_back(part);
      continue;
    }
    ++of_dead;
    dead.present += part.present;
    dead.past += part.past;
  }
  const int extra = sum.power + (late ? 1 : 0) + (sum.weight.change != Scalar(0) ? 1 : 0);
  if (of_dead > 0) sum.parts.push_back(dead);
  if (sum.parts.empty() || sum.power > 19) return {};
  detail::RootIteration iteration(sum, extra, true);
  // If two iterates have converged to the same root, all restart without assumed symmetry.
  if (!iteration.converge() && !(iteration = detail::RootIteration(sum, extra, false)).converge())
    return {};
  auto roots = iteration.roots();
  for (; of_dead > 1; --of_dead) roots.emplace_back(0);
  return roots;
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template std::vector<std::complex<double>> pole_sum_roots(PoleSum<double>, bool);
#endif

}  // namespace holdfast
