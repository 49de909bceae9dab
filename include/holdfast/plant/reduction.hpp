#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <limits>
#include <unsupported/Eigen/AutoDiff>

#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"

namespace holdfast {

/// The data from which `reduce_to_frequencies` computes m₁ and k₂ of a two-mass plant.
template <class Scalar>
struct FrequencyReduction {
  Scalar conductor_stiffness;  ///< stiffness k₁ (N/m), > 0
  Scalar absorber_mass;        ///< mass m₂ (kg), > 0
  Scalar first_frequency;      ///< first natural frequency ω₁/2π (Hz), > 0
  Scalar second_frequency;     ///< second natural frequency ω₂/2π (Hz), > ω₁/2π
};

/// Absorber stiffness k₂ and conductor mass m₁ of a two-mass plant with prescribed frequencies.
struct ReducedMasses {
  double absorber_stiffness;  ///< stiffness k₂ (N/m)
  double conductor_mass;      ///< mass m₁ (kg)
  /// The condition number of k₂, Σ |∂ ln k₂/∂ ln p| over the inputs p = k₁, m₂, ω₁, ω₂. If each
  /// input has a small relative error ε, the relative error of k₂ is at most ε times this number.
  double stiffness_condition;
  double mass_condition;     ///< condition number of m₁, Σ |∂ ln m₁/∂ ln p|, same p
  double damping_condition;  ///< condition number of c₁ = 2 ζ √(m₁ k₁), same p; ζ is exact

  /// Whether an error of 1 % of the inputs may cause an error of 100 % of k₂ or m₁, for instance
  /// near `ReductionOutcome::double_solution`. The result is false where no solution exists.
  bool is_ill_conditioned() const {
    constexpr double largest_condition = 100.0;
    return stiffness_condition > largest_condition || mass_condition > largest_condition;
  }
};

/// The number of two-mass plants with the prescribed natural frequencies.
enum class ReductionOutcome {
  two_solutions,    ///< two plants exist: both roots k₂ are real and distinct
  double_solution,  ///< one plant exists, a double root k₂; condition numbers are infinite
  no_solution,      ///< no real plant has these frequencies
};

/// The solutions of the reduction to two natural frequencies.
struct ReductionResult {
  ReductionOutcome outcome;  ///< number of plants in `solutions`
  /// The discriminant ((1/ω₁ − 1/ω₂)² k₁/m₂) − 1: 0 for a double solution, negative for none.
  double discriminant;
  /// The plants, smaller k₂ first: the same plant twice for a double solution, NaN where no plant
  /// exists. The plant of Kollár 2022, Table 1, is the first.
  std::array<ReducedMasses, 2> solutions;
  double largest_absorber_mass;         ///< largest m₂ (kg) for which a plant exists at this k₁
  double smallest_conductor_stiffness;  ///< smallest k₁ (N/m) for which a plant exists at this m₂
};

/// The largest absorber mass m₂ = k₁ (1/ω₁ − 1/ω₂)² (kg) with which a plant has k₁, ω₁ and ω₂.
template <class Scalar>
Scalar largest_absorber_mass(const FrequencyReduction<Scalar>& asked) {
  const Scalar room = (Scalar(1) / asked.first_frequency - Scalar(1) / asked.second_frequency) /
                      (Scalar(2) * pi_of<Scalar>());
  return asked.conductor_stiffness * room * room;
}

/// The discriminant ((1/ω₁ − 1/ω₂)² k₁/m₂) − 1, negative where no real plant exists.
template <class Scalar>
Scalar reduction_discriminant(const FrequencyReduction<Scalar>& asked) {
  return largest_absorber_mass(asked) / asked.absorber_mass - Scalar(1);
}

/// The smaller or the larger stiffness k₂ (N/m) with which the undamped plant has the natural
/// frequencies ω₁ and ω₂. Both are roots of
///
///     k₂²/m₂ + k₂ (m₂ Ω²/k₁ − ω₁² − ω₂²) + m₂ Ω² = 0,   Ω = ω₁ ω₂
///     k₂ = m₂ Ω (q ∓ √(q² − 1)),   q = (ω₁² + ω₂² − m₂ Ω²/k₁)/(2 Ω)
///
/// q − 1 is computed as m₂ Ω/(2 k₁) times the discriminant, without cancellation near q = 1.
/// @param asked   k₁, m₂ and the two frequencies; the discriminant must be ≥ 0
/// @param larger  whether the larger root is returned
template <class Scalar>
Scalar absorber_stiffness_root(const FrequencyReduction<Scalar>& asked, bool larger) {
  using std::sqrt;
  const Scalar first = Scalar(2) * pi_of<Scalar>() * asked.first_frequency;
  const Scalar second = Scalar(2) * pi_of<Scalar>() * asked.second_frequency;
  const Scalar scale = asked.absorber_mass * first * second;
  const Scalar excess =
      scale / (Scalar(2) * asked.conductor_stiffness) * reduction_discriminant(asked);
  const Scalar grown = Scalar(1) + excess + sqrt(excess * (excess + Scalar(2)));
  return larger ? Scalar(scale * grown) : Scalar(scale / grown);
}

/// The conductor mass m₁ = k₁ k₂/(m₂ ω₁²ω₂²) (kg) for a given k₂ (N/m).
template <class Scalar>
Scalar reduced_conductor_mass(const FrequencyReduction<Scalar>& asked,
                              const Scalar& absorber_stiffness) {
  const Scalar turn = Scalar(2) * pi_of<Scalar>();
  const Scalar product = turn * turn * asked.first_frequency * asked.second_frequency;
  return asked.conductor_stiffness * absorber_stiffness / (asked.absorber_mass * product * product);
}

/// The conductor damping c₁ = 2 m₁ ω ζ (N s/m), where ω = √(k₁/m₁) is the conductor's natural
/// frequency without the absorber (Kollár 2022, Eq. 3).
/// @throws InvalidParameter where m₁ or k₁ is not positive or ζ is outside 0 … 1
inline double conductor_damping(double conductor_mass, double conductor_stiffness_value,
                                double damping_ratio) {
  require_positive("conductor mass m1", conductor_mass, "kg");
  require_positive("conductor stiffness k1", conductor_stiffness_value, "N/m");
  require_within("damping ratio zeta", damping_ratio, "", 0.0, 1.0);
  return 2.0 * std::sqrt(conductor_mass * conductor_stiffness_value) * damping_ratio;
}

namespace detail {

/// A number with its derivatives by ln k₁, ln m₂, ln ω₁, ln ω₂ (a dual number).
template <class Scalar>
using ReductionDual = Eigen::AutoDiffScalar<Vector<Scalar, 4>>;

template <class Scalar>
FrequencyReduction<ReductionDual<Scalar>> logarithmic_seeds(
    const FrequencyReduction<Scalar>& asked) {
  const auto seed = [](const Scalar& value, int index) {
    return ReductionDual<Scalar>(value, value * Vector<Scalar, 4>::Unit(index));
  };
  return {seed(asked.conductor_stiffness, 0), seed(asked.absorber_mass, 1),
          seed(asked.first_frequency, 2), seed(asked.second_frequency, 3)};
}

template <class Scalar>
ReducedMasses reduced_masses(const FrequencyReduction<Scalar>& asked, bool larger) {
  const auto seeded = logarithmic_seeds(asked);
  const ReductionDual<Scalar> stiffness = absorber_stiffness_root(seeded, larger);
  const ReductionDual<Scalar> mass = reduced_conductor_mass(seeded, stiffness);
  const double damping_condition =
      0.5 * (mass.derivatives() / mass.value() + Vector<Scalar, 4>::Unit(0)).template lpNorm<1>();
  return {stiffness.value(), mass.value(),
          stiffness.derivatives().template lpNorm<1>() / stiffness.value(),
          mass.derivatives().template lpNorm<1>() / mass.value(), damping_condition};
}

}  // namespace detail

/// Computes m₁ and k₂ of all two-mass plants with given k₁, m₂ and natural frequencies ω₁ and ω₂. A
/// plant exists only if 1/ω₁ − 1/ω₂ ≥ √(m₂/k₁); otherwise the outcome is `no_solution`.
/// @throws InvalidParameter unless all inputs are finite and > 0 and the frequencies ascend
template <class Scalar = double>
ReductionResult reduce_to_frequencies(const FrequencyReduction<Scalar>& asked) {
  require_positive("conductor stiffness k1", asked.conductor_stiffness, "N/m");
  require_positive("absorber mass m2", asked.absorber_mass, "kg");
  require_positive("first frequency", asked.first_frequency, "Hz");
  require_positive("second frequency", asked.second_frequency, "Hz");
  if (asked.second_frequency <= asked.first_frequency)
    throw InvalidParameter("second frequency", asked.second_frequency, "Hz",
                           "above the first frequency");
  ReductionResult result{};
  result.largest_absorber_mass = largest_absorber_mass(asked);
  result.smallest_conductor_stiffness =
      asked.conductor_stiffness * (asked.absorber_mass / result.largest_absorber_mass);
  result.discriminant = reduction_discriminant(asked);
  if (result.discriminant < 0.0) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    result.outcome = ReductionOutcome::no_solution;
    result.solutions.fill({none, none, none, none, none});
    return result;
  }
  result.outcome = result.discriminant > 0.0 ? ReductionOutcome::two_solutions
                                             : ReductionOutcome::double_solution;
  result.solutions = {detail::reduced_masses(asked, false), detail::reduced_masses(asked, true)};
  return result;
}

}  // namespace holdfast
