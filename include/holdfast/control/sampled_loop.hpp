#pragma once

#include "holdfast/control/gains.hpp"
#include "holdfast/control/zero_order_hold.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/plant/ports.hpp"
#include "holdfast/plant/two_mass.hpp"

namespace holdfast {

/// The instants at which the computer samples and its force acts: period and delay.
template <class Scalar>
struct Sampling {
  static_assert(is_real<Scalar>, "a time is a real number: Sampling<double>");

  Scalar period;  ///< sampling period τ (s), > 0
  Scalar processing_delay =
      Scalar(0);  ///< processing delay δ (s) from a sample to its force, 0 ≤ δ ≤ τ
};

/// Validates a sampling. @throws InvalidParameter unless τ > 0 and 0 ≤ δ ≤ τ, both finite
inline void validate(const Sampling<double>& sampling) {
  require_positive("sampling period tau", sampling.period, "s");
  require_within("processing delay", sampling.processing_delay, "s", 0.0, sampling.period);
}

/// The plant with a computer. It samples every τ and applies each force δ later, held for τ.
///
/// The force is u_{j−1} in [t_j, t_j + δ) and u_j in [t_j + δ, t_{j+1}), so that exactly
///
///     z_{j+1} = A_d z_j + Γ₁ u_{j−1} + Γ₀ u_j + c_d F_j
///     A_d = e^{Aτ},  Γ₀ = ∫₀^{τ−δ} e^{As} ds b,  Γ₁ = e^{A(τ−δ)} ∫₀^δ e^{As} ds b,  c_d = ∫₀^τ
///     e^{As} ds c
///
/// With z̃_j = [z_j; u_{j−1}] the step is z̃_{j+1} = S z̃_j + [c_d; 0] F_j outside the backlash and
/// S* z̃_j + [c_d; 0] F_j inside. δ = τ gives the matrices printed in Kollár 2022, Eqs. (13)–(14);
/// δ = 0 gives the map behind the paper's numbers (docs/reading-the-paper.md). For a delay of more
/// than one sample see control/loop_map.hpp.
/// @tparam States  N, the order of the plant; 4 for the two masses, Eigen::Dynamic for any
template <class Scalar, int States = 4>
struct SampledLoop {
  Sampling<Scalar> sampling;          ///< period τ and delay δ of the matrices below
  Matrix<Scalar, States> transition;  ///< transition matrix A_d, N × N
  Matrix<Scalar, States> increment;   ///< A_d − I, N × N, to full relative accuracy for any τ
  Vector<Scalar, States> previous_force;   ///< response Γ₁ per newton of u_{j−1}, N × 1
  Vector<Scalar, States> present_force;    ///< response Γ₀ per newton of u_j, N × 1
  Vector<Scalar, States> held_excitation;  ///< response c_d per newton of F held over τ, N × 1

  /// The map S of Eq. (14) for any δ with the force transmitted, 5 × 5: [A_d + Γ₀ K, Γ₁; K, 0], K =
  /// [P, D, 0, 0]. Only the two masses have this map; for other plants see LoopMap::closed_map().
  Matrix<Scalar, 5> engaged_map(const PdGains<Scalar>& gains) const {
    static_assert(States == 4, "only a plant of two masses has the feedback row [P, D, 0, 0]");
    Matrix<Scalar, 5> map = backlash_map();
    map.template topLeftCorner<4, 4>() += present_force * gains.feedback_row();
    map.template bottomLeftCorner<1, 4>() = gains.feedback_row();
    return map;
  }

  /// The map S* of Eq. (14) for any δ in the backlash, (N + 1) × (N + 1): [A_d, Γ₁; 0, 0].
  Matrix<Scalar, larger_size(States, 1)> backlash_map() const {
    const Eigen::Index n = transition.rows();
    Matrix<Scalar, larger_size(States, 1)> map =
        Matrix<Scalar, larger_size(States, 1)>::Zero(n + 1, n + 1);
    map.template topLeftCorner<States, States>(n, n) = transition;
    map.template topRightCorner<States, 1>(n, 1) = previous_force;
    return map;
  }
};

/// Converts a loop to another number type, for instance to a pack whose lanes are all equal.
template <class To, class From, int States>
SampledLoop<To, States> converted(const SampledLoop<From, States>& loop) {
  return {{To(loop.sampling.period), To(loop.sampling.processing_delay)},
          loop.transition.template cast<To>(),
          loop.increment.template cast<To>(),
          loop.previous_force.template cast<To>(),
          loop.present_force.template cast<To>(),
          loop.held_excitation.template cast<To>()};
}

/// The sampled loop of a linear plant.
///
/// With Φ(h) = ∫₀ʰ e^{As} ds, from one augmented exponential for each of the two parts of the
/// period, every matrix of the loop is a product: A_d − I = A Φ(τ), Γ₀ = Φ(τ−δ) b, Γ₁ = e^{A(τ−δ)}
/// Φ(δ) b, c_d = Φ(τ) c. No small matrix is a difference of large ones.
/// @param plant     two admissible masses, or another finite plant
/// @param sampling  0 ≤ δ ≤ τ; τ = 0 gives the identity
/// @tparam Plant    type with `state_matrix()`, `control_input()` and `excitation_input()`
/// @throws InvalidParameter where sampling or plant are not admissible, or the sizes disagree
template <class Plant, class Scalar = ScalarOf<Plant>>
SampledLoop<Scalar, states_of<Plant>> sampled_loop(
    const Plant& plant, const Sampling<detail::Undeduced<Scalar>>& sampling) {
  static_assert(!detail::HasController<Plant>::value,
                "motions of a plant with its own controller need event_motion()");
  constexpr int states = states_of<Plant>;
  detail::require_admissible(plant);
  const Matrix<Scalar, states> a = plant.state_matrix();
  const Vector<Scalar, states> b = plant.control_input();
  require_size("order of the state matrix", a.cols(), a.rows());
  require_size("size of the control input", b.size(), a.rows());
  require_size("size of the excitation input", plant.excitation_input().size(), a.rows());
  const Scalar entries = a.sum() + b.sum() + plant.excitation_input().sum();
  require_finite("entries of the plant's matrices", static_cast<double>(entries), "");
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
