#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "holdfast/math/enclosure/enclosure.hpp"
#include "holdfast/orbit/proof/enclosed_modes.hpp"
#include "holdfast/orbit/proof/set_of_states.hpp"

namespace holdfast::detail {

/// The Taylor series of a guard for all motions of a set, a time s after they reached a surface,
///
///     g(s) = Σ_{k<m} c_k sᵏ + c_m sᵐ,   c_k = h Aᵏ w/k!,
///
/// where h w is the guard, A the matrix of the mode, and c_m encloses the remainder.
template <class Number>
class GuardSeries {
 public:
  /// @param guard  guard of the mode in which the set moves
  /// @param set    set of the motions' states
  /// @param terms  number m of terms, EnclosedModes::terms_for() of the time considered
  GuardSeries(const EnclosedGuard<Number>& guard, const SetOfStates<Number>& set, int terms) {
    double size = 0.0;
    for (Eigen::Index i = 0; i < FlowPlace::size; ++i)
      size = std::max(size, set.range(EnclosedModes<Number>::unit(i)).magnitude());
    const auto rest = static_cast<std::size_t>(std::max(terms, least_terms));
    for (std::size_t k = 0; k < rest; ++k) coefficients_.push_back(set.range(guard.terms[k]));
    Number sum;
    for (const Number& entry : guard.terms[rest]) sum += Number(entry.magnitude());
    // |w(ξ)| ≤ e^{‖A‖s} |w|.
    const double most = (Number(EnclosedModes<Number>::most_growth) * sum * Number(size)).upper();
    coefficients_.push_back({-most, most});
  }

  /// The k-th derivative k! c_k at s = 0.
  Number derivative(int order) const {
    Number value = coefficients_[static_cast<std::size_t>(order)];
    for (int k = 2; k <= order; ++k) value *= Number(double(k));
    return value;
  }
  /// An interval that contains g(s) for all s in the given interval.
  Number value(const Number& s) const { return value_without(0, s); }
  /// An interval that contains ġ(s) for all s in the given interval. The formal derivative of c_m
  /// sᵐ encloses the remainder of ġ, h A^m w s^{m−1}/(m−1)!.
  Number slope(const Number& s) const {
    Number sum;
    for (std::size_t k = coefficients_.size(); k-- > 1;)
      sum = sum * s + Number(double(k)) * coefficients_[k];
    return sum;
  }

  /// Whether g(s) > 0 is proved for 0 < s ≤ end, and at s = 0 too if `zeros` is 0.
  /// @param zeros  number of the derivatives g, ġ, g̈, … that vanish exactly at s = 0
  bool is_positive(double end, int zeros) const { return is_positive_on(0.0, end, zeros, 0); }

  /// An interval of s in which g falls through zero, exactly once, for every motion of the set.
  /// @param near  estimate of the zero (s)
  /// @return nullopt where such an interval was not proved
  std::optional<Number> falls_through_zero(double near) const {
    for (int step = 0; step < 8; ++step)
      near -= value(Number(near)).middle() / slope(Number(near)).middle();
    if (!(near > 0.0)) return std::nullopt;
    const Number here = value(Number(near));
    double reach = 1.5 * here.magnitude() / std::abs(slope(Number(near)).middle()) +
                   4.0 * std::numeric_limits<double>::epsilon() * near;
    for (int attempt = 0; attempt < 12 && reach < near; ++attempt, reach *= 1.5) {
      const Number around(near - reach, near + reach);
      if (value(Number(around.lower())).is_positive() &&
          value(Number(around.upper())).is_negative() && slope(around).is_negative())
        return around;
    }
    return std::nullopt;
  }

 private:
  static constexpr int least_terms = 6;  // the first derivative that is not zero is one of them

  /// The quotient g(s)/s^zeros.
  Number value_without(int zeros, const Number& s) const {
    Number sum;
    for (std::size_t k = coefficients_.size(); k-- > static_cast<std::size_t>(zeros);)
      sum = sum * s + coefficients_[k];
    return sum;
  }
  bool is_positive_on(double from, double to, int zeros, int depth) const {
    constexpr int deepest = 48;
    if (value_without(zeros, {from, to}).is_positive()) return true;
    const double middle = 0.5 * (from + to);
    if (depth == deepest || !value_without(zeros, Number(from)).is_positive() ||
        !value_without(zeros, Number(to)).is_positive())
      return false;
    return is_positive_on(from, middle, zeros, depth + 1) &&
           is_positive_on(middle, to, zeros, depth + 1);
  }

  std::vector<Number> coefficients_;
};

}  // namespace holdfast::detail
