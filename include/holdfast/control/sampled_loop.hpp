#pragma once

#include "holdfast/control/gains.hpp"
#include "holdfast/control/zero_order_hold.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/plant/ports.hpp"
#include "holdfast/plant/two_mass.hpp"

namespace holdfast {

/// The sampling period of the control computer and its processing delay.
template <class Scalar>
struct Sampling {
  static_assert(is_real<Scalar>, "a time is a real number: Sampling<double>");

  Scalar period;  ///< sampling period τ (s), > 0
  Scalar processing_delay =
      Scalar(0);  ///< processing delay δ (s) from a sample to its force; > τ only in a LoopMap
};

/// Validates a sampling. @throws InvalidParameter unless τ > 0 and 0 ≤ δ ≤ τ, both finite
inline void validate(const Sampling<double>& sampling) {
  require_positive("sampling period tau", sampling.period, "s");
  require_within("processing delay", sampling.processing_delay, "s", 0.0, sampling.period);
}

/// The plant ż = A z + b u + c F in a sampled loop. The computer samples z every τ. It applies the
/// control force u_j of sample j after the delay δ and holds it for τ.
///
/// The control force is thus u_{j−1} in [t_j, t_j + δ) and u_j in [t_j + δ, t_{j+1}). For an
/// excitation held at its value F_j = F(t_j), the step is exactly
///
///     z_{j+1} = A_d z_j + Γ₁ u_{j−1} + Γ₀ u_j + c_d F_j
///     A_d = e^{Aτ},  Γ₀ = ∫₀^{τ−δ} e^{As} ds b,  Γ₁ = e^{A(τ−δ)} ∫₀^δ e^{As} ds b,
///     c_d = ∫₀^τ e^{As} ds c
///
/// With z̃_j = [z_j; u_{j−1}] the step is z̃_{j+1} = S z̃_j + [c_d; 0] F_j while the drive
/// transmits the force. While the belt is in its gap, S* replaces S. δ = τ gives the matrices
/// printed in Kollár 2022, Eqs. (13)–(14). δ = 0 reproduces that paper's numerical results
/// (docs/reading-the-paper.md). For δ > τ see `LoopMap`.
/// @tparam States  N, the order of the plant; 4 for the two masses, Eigen::Dynamic for any
template <class Scalar, int States = 4>
struct SampledLoop {
  Sampling<Scalar> sampling;               ///< period τ and delay δ of the matrices below
  Matrix<Scalar, States> transition;       ///< transition matrix A_d, N × N
  Matrix<Scalar, States> increment;        ///< A_d − I, N × N, accurate even for small τ
  Vector<Scalar, States> previous_force;   ///< response Γ₁ per newton of u_{j−1}, N × 1
  Vector<Scalar, States> present_force;    ///< response Γ₀ per newton of u_j, N × 1
  Vector<Scalar, States> held_excitation;  ///< response c_d per newton of F held over τ, N × 1

  /// The map S while the drive transmits, 5 × 5: [A_d + Γ₀ K, Γ₁; K, 0], K = [P, D, 0, 0]. For
  /// plants other than two masses see LoopMap::closed_map(). Source: Kollár 2022, Eq. (14) (δ = τ).
  Matrix<Scalar, 5> engaged_map(const PdGains<Scalar>& gains) const {
    static_assert(States == 4, "only a plant of two masses has the feedback row [P, D, 0, 0]");
    Matrix<Scalar, 5> map = backlash_map();
    map.template topLeftCorner<4, 4>() += present_force * gains.feedback_row();
    map.template bottomLeftCorner<1, 4>() = gains.feedback_row();
    return map;
  }

  /// The map S* in the gap, (N + 1) × (N + 1): [A_d, Γ₁; 0, 0]. Source: Kollár 2022, Eq. (14).
  Matrix<Scalar, larger_size(States, 1)> backlash_map() const {
    const Eigen::Index n = transition.rows();
    Matrix<Scalar, larger_size(States, 1)> map =
        Matrix<Scalar, larger_size(States, 1)>::Zero(n + 1, n + 1);
    map.template topLeftCorner<States, States>(n, n) = transition;
    map.template topRightCorner<States, 1>(n, 1) = previous_force;
    return map;
  }
};

/// Converts a loop to another number type, for instance to a SIMD pack with equal lanes.
template <class To, class From, int States>
SampledLoop<To, States> converted(const SampledLoop<From, States>& loop) {
  return {{To(loop.sampling.period), To(loop.sampling.processing_delay)},
          loop.transition.template cast<To>(),
          loop.increment.template cast<To>(),
          loop.previous_force.template cast<To>(),
          loop.present_force.template cast<To>(),
          loop.held_excitation.template cast<To>()};
}

/// Computes the sampled loop of a linear plant.
///
/// With Φ(h) = ∫₀ʰ e^{As} ds the matrices are A_d − I = A Φ(τ), Γ₀ = Φ(τ−δ) b, Γ₁ =
/// e^{A(τ−δ)} Φ(δ) b and c_d = Φ(τ) c. These products lose no digits where τ is small. Φ(δ) and
/// Φ(τ−δ) are computed by zero_order_hold().
/// @param plant     two admissible masses, or another linear plant with finite matrices
/// @param sampling  period τ (s), ≥ 0, and delay δ (s), 0 ≤ δ ≤ τ; τ = 0 gives A_d = I
/// @tparam Plant    type with `state_matrix()`, `control_input()` and `excitation_input()`
/// @throws InvalidParameter where τ, δ or the plant is not admissible, or the sizes disagree
template <class Plant, class Scalar = ScalarOf<Plant>>
SampledLoop<Scalar, states_of<Plant>> sampled_loop(
    const Plant& plant, const Sampling<detail::Undeduced<Scalar>>& sampling) {
  static_assert(!detail::HasController<Plant>::value,
                "motions of a plant with its own controller need event_motion()");
  constexpr int states = states_of<Plant>;
  detail::require_admissible(plant);
  const Matrix<Scalar, states> a = plant.state_matrix();
  const Vector<Scalar, states> b = plant.control_input();
  require_size("columns of the state matrix", a.cols(), a.rows());
  require_size("size of the control input", b.size(), a.rows());
  require_size("size of the excitation input", plant.excitation_input().size(), a.rows());
  const Scalar entries = a.sum() + b.sum() + plant.excitation_input().sum();
  require_finite("sum of the entries of the plant's matrices", static_cast<double>(entries), "");
  const auto period = static_cast<double>(sampling.period);
  require_non_negative("sampling period tau", period, "s");
  require_within("processing delay", static_cast<double>(sampling.processing_delay), "s", 0.0,
                 period);
  const Matrix<Scalar, states> identity = Matrix<Scalar, states>::Identity(a.rows(), a.cols());
  const auto before =
      zero_order_hold<Scalar, states, states>(a, identity, sampling.processing_delay);
  const auto after = zero_order_hold<Scalar, states, states>(
      a, identity, sampling.period - sampling.processing_delay);
  const Matrix<Scalar, states> integral = after.input + after.transition * before.input;
  const Matrix<Scalar, states> increment = a * integral;

  SampledLoop<Scalar, states> loop;
  loop.sampling = sampling;
  loop.transition = identity + increment;
  loop.increment = increment;
  loop.previous_force = after.transition * (before.input * b);
  loop.present_force = after.input * b;
  loop.held_excitation = integral * plant.excitation_input();
  return loop;
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template SampledLoop<double> sampled_loop(const TwoMass<double>&, const Sampling<double>&);
#endif

}  // namespace holdfast
