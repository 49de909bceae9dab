#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "holdfast/control/gains.hpp"
#include "holdfast/control/loop_map.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/math/enclosure/complex_enclosure.hpp"
#include "holdfast/math/enclosure/enclosure.hpp"
#include "holdfast/plant/enclosed_poles.hpp"

namespace holdfast {

/// Linear Taylor model of f about λ: f(λ + w) = value + slope · w + r, |r| ≤ rest for |w| ≤ radius.
struct EnclosedExpansion {
  ComplexEnclosure value;  ///< enclosure of f(λ)
  ComplexEnclosure slope;  ///< enclosure of the derivative f′(λ)
  double rest = 0.0;       ///< upper bound of |r|; ∞ where f may have a pole within the radius
};

/// Linear Taylor models of the transfer functions F_z and F_v (`EnclosedResponse`) about a point λ.
struct EnclosedCommandResponse {
  EnclosedExpansion displacement;  ///< expansion of F_z (m/N)
  EnclosedExpansion velocity;      ///< expansion of F_v (m/(N s))
};

/// Enclosure of one or more samplings (period τ, delay δ): τ and the times for which commands act.
struct EnclosedSampling {
  Enclosure period;  ///< sampling period τ (s)
  Enclosure past;  ///< time δ − (k − 1) τ (s) in a sample for which the previous command acts
  Enclosure present;  ///< time k τ − δ (s) in a sample for which the latest command acts
  int commands;       ///< number k of delayed commands, ≥ 1

  /// Creates the enclosure from its members `period`, `past`, `present` and `commands`.
  EnclosedSampling(Enclosure of_period, Enclosure of_past, Enclosure of_present, int on_their_way)
      : period(of_period), past(of_past), present(of_present), commands(on_their_way) {}

  /// The enclosure of all decimals that round to the given doubles τ (s) > 0 and δ (s), 0 … 1000 τ.
  /// If δ/τ is within a relative 10⁻¹² of a whole number, it counts as that number.
  /// @throws InvalidParameter where the sampling is not admissible
  static EnclosedSampling of(const Sampling<double>& sampling) {
    require_positive("sampling period tau", sampling.period, "s");
    require_within("processing delay", sampling.processing_delay, "s", 0.0,
                   1000.0 * sampling.period);
    return of_delay(Enclosure::of_decimal(sampling.period),
                    Enclosure::of_decimal(sampling.processing_delay), held_commands(sampling));
  }
  /// The enclosure for all δ in the interval `delay` (s), within (k − 1) τ … k τ, k = `commands`.
  static EnclosedSampling of_delay(const Enclosure& period, const Enclosure& delay, int commands) {
    const auto within_sample = [&](const Enclosure& time) {
      return Enclosure(std::clamp(time.lower(), 0.0, period.lower()),
                       std::clamp(time.upper(), 0.0, period.upper()));
    };
    const Enclosure past =
        within_sample(delay - Enclosure(static_cast<double>(commands - 1)) * period);
    return {period, past, within_sample(period - past), commands};
  }
};

/// Enclosures of the zero-order-hold transfer functions G of `ModalResponse`, multiplied by λᵏ: F =
/// λᵏ G. Therefore long delays need no inverse powers of λ. The loop's characteristic function is
///
///     q(λ) = λᵏ − P F_z(λ) − D F_v(λ),   F(λ) = λᵏ G(λ) = Σ (a_j λ + b_j)/(λ − e^{s_j τ})
///
/// with k, a_j and b_j as in `ModalResponse`. A conjugate pair of poles forms one quotient f = n/g
/// of real quadratics with leading coefficients n₂ and g₂. With f, f′ and g′ at λ, its remainder is
///
///     f(λ + w) − f − f′ w = w² (n₂ − f g₂ − f′ g′ − f′ g₂ w)/g(λ + w)
///
/// Work: some 300 operations on enclosures per pair and point λ.
class EnclosedResponse {
 public:
  /// @param poles     poles of `enclosed_poles`, at least one, none of which may be 0
  /// @param sampling  enclosure of one or more samplings with a common k
  EnclosedResponse(const std::vector<EnclosedPole>& poles, const EnclosedSampling& sampling)
      : commands_(sampling.commands) {
    for (const EnclosedPole& pole : poles) add(pole, sampling);
  }
  /// @param poles     poles of `enclosed_poles`, at least one, none of which may be 0
  /// @param sampling  sampling as for `EnclosedSampling::of`
  /// @throws InvalidParameter where the sampling is not admissible
  EnclosedResponse(const std::vector<EnclosedPole>& poles, const Sampling<double>& sampling)
      : EnclosedResponse(poles, EnclosedSampling::of(sampling)) {}

  /// The linear Taylor models of F_z and F_v about a point.
  /// @param lambda  point λ
  /// @param radius  radius, > 0, of the disc about λ in which the models are valid
  EnclosedCommandResponse about(const ComplexEnclosure& lambda, double radius) const {
    EnclosedCommandResponse sum;
    for (const Section& section : sections_) section.add_to(sum, lambda, radius);
    return sum;
  }

  /// The linear Taylor model of λᵏ, with |r| ≤ k (k − 1)/2 (|λ| + radius)^{k−2} radius².
  /// @param lambda  point λ
  /// @param radius  radius, > 0, of the disc about λ in which the model is valid
  EnclosedExpansion power_about(const ComplexEnclosure& lambda, double radius) const {
    const auto k = static_cast<double>(commands_);
    EnclosedExpansion result;
    result.slope = power(lambda, commands_ - 1) * Enclosure(k);
    result.value = power(lambda, commands_);
    if (commands_ < 2) return result;
    const Enclosure reach = Enclosure(lambda.magnitude()) + radius;
    const Enclosure curvature = power(ComplexEnclosure(reach), commands_ - 2).real();
    result.rest = (Enclosure(0.5 * k * (k - 1.0)) * curvature * square(Enclosure(radius))).upper();
    return result;
  }

  /// The number k of delayed commands.
  int held_commands() const { return commands_; }
  /// The number of eigenvalues λ = e^{sτ} of the plant without control with |λ| > r; `nullopt`
  /// where an eigenvalue may lie on the circle |λ| = r.
  /// @param radius  radius r, > 0
  std::optional<int> poles_outside(double radius) const {
    int count = 0;
    for (const Section& section : sections_) {
      // On the unit circle Re s tells more than e^{sτ}.
      const bool outside =
          radius == 1.0 ? section.growth.is_positive() : section.pole.least_modulus() > radius;
      const bool inside =
          radius == 1.0 ? section.growth.is_negative() : section.pole.magnitude() < radius;
      if (!outside && !inside) return std::nullopt;
      if (outside) count += section.is_pair ? 2 : 1;
    }
    return count;
  }

 private:
  /// The numerator n(λ) of F_z or F_v, constant coefficient first.
  using Numerator = std::array<Enclosure, 3>;

  struct Section {
    ComplexEnclosure pole;  // e^{sτ}
    Enclosure growth;       // Re s
    bool is_pair;
    Numerator displacement, velocity;

    void add_to(EnclosedCommandResponse& sum, const ComplexEnclosure& lambda, double radius) const {
      const ComplexEnclosure to_pole = lambda - pole;
      // 0 where the disc may reach the pole: nothing is known of the rest then.
      double least = std::max((Enclosure(to_pole.least_modulus()) - radius).lower(), 0.0);
      ComplexEnclosure divisor = to_pole, divisor_slope(1.0);
      if (is_pair) {
        const ComplexEnclosure to_partner = lambda - conj(pole);
        const double other = (Enclosure(to_partner.least_modulus()) - radius).lower();
        least = other > 0.0 ? std::max((Enclosure(least) * other).lower(), 0.0) : 0.0;
        divisor = to_pole * to_partner;
        divisor_slope = to_pole + to_partner;
      }
      const Around at{lambda, inverse(divisor), divisor_slope, radius, least};
      at.add(displacement, is_pair, sum.displacement);
      at.add(velocity, is_pair, sum.velocity);
    }
  };

  /// A point λ with 1/g and g′ of the denominator g at λ, and a lower bound of |g| near λ.
  struct Around {
    const ComplexEnclosure& lambda;
    ComplexEnclosure inverse_divisor, divisor_slope;
    double radius, least_divisor;  // not above |g(λ + w)|

    void add(const Numerator& n, bool is_pair, EnclosedExpansion& sum) const {
      const ComplexEnclosure value =
          (lambda * (lambda * n[2] + ComplexEnclosure(n[1])) + ComplexEnclosure(n[0])) *
          inverse_divisor;
      const ComplexEnclosure slope =
          (lambda * (2.0 * n[2]) + n[1] - value * divisor_slope) * inverse_divisor;
      sum.value += value;
      sum.slope += slope;
      ComplexEnclosure second = ComplexEnclosure(n[2]) - slope * divisor_slope;
      Enclosure third;
      if (is_pair) {
        second = second - value;
        third = slope.magnitude();
      }
      const Enclosure bound = square(Enclosure(radius)) *
                              (Enclosure(second.magnitude()) + third * radius) / least_divisor;
      sum.rest = (Enclosure(sum.rest) + bound).upper();
    }
  };

  void add(const EnclosedPole& pole, const EnclosedSampling& sampling) {
    const ComplexEnclosure present = exponential(pole.s * sampling.present);
    const ComplexEnclosure past = exponential(pole.s * sampling.past);
    const ComplexEnclosure a = pole.residue * (present - 1.0);
    const ComplexEnclosure b = pole.residue * present * (past - 1.0);
    const ComplexEnclosure reached = exponential(pole.s * sampling.period);
    const auto numerator = [&](const ComplexEnclosure& now, const ComplexEnclosure& before) {
      if (!pole.is_pair) return Numerator{before.real(), now.real(), 0.0};
      return Numerator{-2.0 * (before * conj(reached)).real(),
                       2.0 * (before.real() - (now * conj(reached)).real()), 2.0 * now.real()};
    };
    sections_.push_back(
        {reached, pole.s.real(), pole.is_pair, numerator(a / pole.s, b / pole.s), numerator(a, b)});
  }

  std::vector<Section> sections_;
  int commands_ = 1;
};

}  // namespace holdfast
