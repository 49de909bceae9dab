#pragma once

#include <Eigen/Core>
#include <vector>

#include "holdfast/cable/bar_chain.hpp"
#include "holdfast/cable/chain_equilibrium.hpp"
#include "holdfast/core/errors.hpp"

namespace holdfast {

/// How the absorber loads the continuous cable.
enum class AbsorberReading {
  weight,       ///< by its weight alone, without inertia
  rigid_mass,   ///< as a mass fixed to its node, with inertia along the span too, damped by α
  spring_mass,  ///< as a mass on a spring and a damper below its node, moving up and down only
};

/// The absorber on the continuous cable.
struct HangingAbsorber {
  AbsorberReading reading;
  double mass;             ///< m₂ (kg), ≥ 0; > 0 for the spring–mass
  double stiffness = 0.0;  ///< k₂ (N/m), of the spring–mass only
  double damping = 0.0;    ///< c₂ (N s/m), of the spring–mass only
};

/// Rayleigh damping C = α M + β K.
struct RayleighDamping {
  double mass_factor;       ///< α (1/s), ≥ 0
  double stiffness_factor;  ///< β (s), ≥ 0
};

/// α = 2 ζ ω₁ω₂/(ω₁ + ω₂), β = 2 ζ/(ω₁ + ω₂): the damping ratio ζ at both frequencies (Hz).
/// @throws InvalidParameter for ζ outside 0 … 1 or a frequency that is not positive
inline RayleighDamping rayleigh_damping(double damping_ratio, double first_frequency,
                                        double second_frequency) {
  require_within("damping ratio zeta", damping_ratio, "", 0.0, 1.0);
  require_positive("first frequency", first_frequency, "Hz");
  require_positive("second frequency", second_frequency, "Hz");
  const double first = 2.0 * pi<double> * first_frequency;
  const double second = 2.0 * pi<double> * second_frequency;
  return {2.0 * damping_ratio * first * second / (first + second),
          2.0 * damping_ratio / (first + second)};
}

/// The continuous cable with its absorber, in finite elements: M v̇ + C v + f(q) = F for a chain of
/// elastic bars with lumped masses, and C = α M + β K of the equilibrium with the absorber's
/// weight, so that it damps no motion along the cable that the equilibrium itself does not know.
///
/// A right-hand side and its Jacobian for whoever integrates; no solver in here.
///
/// State: [x, y, ẋ, ẏ] (m, m/s) per free node, and behind the loaded node of the spring–mass
/// reading its two states [a, ȧ], a (m) counted like the node's drop from the equilibrium. The
/// Jacobian's entries lie within `half_bandwidth()` of the diagonal.
class CableElements {
 public:
  /// @param conductor  admissible in the sense of `validate`
  /// @param position   x_p (m) of the absorber, inside the span
  /// @param elements   N, ≥ 2
  /// @throws InvalidParameter otherwise, or for an absorber outside its ranges
  CableElements(const Conductor<double>& conductor, double position, int elements,
                const HangingAbsorber& absorber, const RayleighDamping& damping);

  const BarChain& chain() const { return chain_; }
  /// Number of states.
  int states() const { return 4 * chain_.free_nodes() + (sprung() ? 2 : 0); }
  /// 7; 9 with the two further states of the spring–mass.
  int half_bandwidth() const { return sprung() ? 9 : 7; }

  /// Equilibrium with the absorber's weight.
  const ChainEquilibrium& rest() const { return rest_; }

  /// The state at rest under a further force (N) at the absorber's place, and how it was found.
  struct Start {
    Eigen::VectorXd state;
    EquilibriumOutcome outcome;
  };
  Start held_by(double force) const;

  /// Drop (m) of the absorber's node from the equilibrium.
  template <class State>
  auto displacement(const State& state) const {
    return state[first_state(chain_.loaded_node()) + 1] - rest_.nodes(1, chain_.loaded_node());
  }

  /// d(state)/dt for any number type, state and rate of size states().
  template <class Scalar>
  void rate(const Scalar* state, Scalar* rate_of_state) const;

  /// Calls set(row, column, value) for every entry of ∂rate/∂state that can differ from zero.
  template <class Set>
  void jacobian(const double* state, Set&& set) const;

  /// Kinetic and elastic energy and that of the weights (J), up to a constant; constant along an
  /// undamped motion.
  double energy(const Eigen::VectorXd& state) const;

  /// Positions of the free nodes.
  BarChain::Nodes positions(const double* state) const;

 private:
  bool sprung() const { return absorber_.reading == AbsorberReading::spring_mass; }
  int first_state(int node) const {
    return 4 * node + (sprung() && node > chain_.loaded_node() ? 2 : 0);
  }
  double inertia(int node) const {
    const bool carries =
        node == chain_.loaded_node() && absorber_.reading == AbsorberReading::rigid_mass;
    return chain_.mass(node) + (carries ? absorber_.mass : 0.0);
  }
  double resting_load() const { return absorber_.mass * chain_.conductor().gravity; }

  BarChain chain_;
  HangingAbsorber absorber_;
  RayleighDamping damping_;
  ChainEquilibrium rest_;
  std::vector<Matrix<double, 2>> bar_damping_;  // β k_e at rest, per bar
};

// ---------------------------------------------------------------------------------------------

inline void validate(const HangingAbsorber& absorber) {
  require_non_negative("absorber mass m2", absorber.mass, "kg");
  if (absorber.reading != AbsorberReading::spring_mass) return;
  require_positive("absorber mass m2", absorber.mass, "kg");
  require_positive("absorber stiffness k2", absorber.stiffness, "N/m");
  require_non_negative("absorber damping c2", absorber.damping, "N s/m");
}

inline CableElements::CableElements(const Conductor<double>& conductor, double position,
                                    int elements, const HangingAbsorber& absorber,
                                    const RayleighDamping& damping)
    : chain_(conductor, position, elements), absorber_(absorber), damping_(damping) {
  validate(absorber);
  require_non_negative("mass factor alpha", damping.mass_factor, "1/s");
  require_non_negative("stiffness factor beta", damping.stiffness_factor, "s");
  rest_ = chain_equilibrium(chain_, resting_load());
  for (int e = 0; e < chain_.elements(); ++e)
    bar_damping_.push_back(damping_.stiffness_factor * bar_stiffness(chain_.reach(rest_.nodes, e),
                                                                     chain_.length(e),
                                                                     chain_.axial_stiffness()));
}

inline CableElements::Start CableElements::held_by(double force) const {
  const ChainEquilibrium held = chain_equilibrium(chain_, resting_load() + force);
  Start start{Eigen::VectorXd::Zero(states()), held.outcome};
  for (int node = 0; node < chain_.free_nodes(); ++node)
    start.state.segment<2>(first_state(node)) = held.nodes.col(node);
  if (sprung()) {
    const int own = first_state(chain_.loaded_node()) + 4;
    start.state[own] = displacement(start.state);
  }
  return start;
}

template <class Scalar>
void CableElements::rate(const Scalar* state, Scalar* rate_of_state) const {
  using Pair = Vector<Scalar, 2>;
  const auto pair_at = [state](int index) { return Pair(state[index], state[index + 1]); };
  const Scalar zero(0);
  // Each bar is computed once: it pulls its left node forth and its right node back.
  Pair from(zero, zero), from_velocity(zero, zero), pull_before(zero, zero);
  for (int e = 0; e <= chain_.free_nodes(); ++e) {
    const bool at_support = e == chain_.free_nodes();
    const int index = at_support ? 0 : first_state(e);
    const Pair to = at_support ? Pair(Scalar(chain_.conductor().span), zero) : pair_at(index);
    const Pair to_velocity = at_support ? Pair(zero, zero) : pair_at(index + 2);
    const Matrix<double, 2>& damper = bar_damping_[static_cast<std::size_t>(e)];
    const Pair closing = to_velocity - from_velocity;
    const Pair pull = bar_pull<Scalar>(to - from, chain_.length(e), chain_.axial_stiffness()) +
                      Pair(damper(0, 0) * closing[0] + damper(0, 1) * closing[1],
                           damper(1, 0) * closing[0] + damper(1, 1) * closing[1]);
    if (e > 0) {
      const int node = e - 1, own = first_state(node);
      Pair force = pull - pull_before;
      force[1] += Scalar(chain_.mass(node) * chain_.conductor().gravity);
      if (node == chain_.loaded_node()) {
        force[1] += Scalar(resting_load());
        if (sprung()) {
          const Scalar lag = state[own + 4] - displacement(state);
          const Scalar closing_speed = state[own + 5] - state[own + 3];
          const Scalar spring = absorber_.stiffness * lag + absorber_.damping * closing_speed;
          force[1] += spring;
          rate_of_state[own + 4] = state[own + 5];
          rate_of_state[own + 5] = -spring / Scalar(absorber_.mass);
        }
      }
      for (int i = 0; i < 2; ++i) {
        rate_of_state[own + i] = state[own + 2 + i];
        rate_of_state[own + 2 + i] =
            force[i] / Scalar(inertia(node)) - damping_.mass_factor * state[own + 2 + i];
      }
    }
    from = to;
    from_velocity = to_velocity;
    pull_before = pull;
  }
}

template <class Set>
void CableElements::jacobian(const double* state, Set&& set) const {
  const BarChain::Nodes nodes = positions(state);
  const auto bar = [&](int e) {
    return bar_stiffness(chain_.reach(nodes, e), chain_.length(e), chain_.axial_stiffness());
  };
  const auto damper = [&](int e) { return bar_damping_[static_cast<std::size_t>(e)]; };
  const auto block = [&](int row, int column, const Matrix<double, 2>& values) {
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j) set(row + i, column + j, values(i, j));
  };
  Matrix<double, 2> before = bar(0);
  for (int node = 0; node < chain_.free_nodes(); ++node) {
    const int own = first_state(node);
    const double inverse = 1.0 / inertia(node);
    const Matrix<double, 2> behind = bar(node + 1);
    Matrix<double, 2> position = -inverse * (before + behind);
    Matrix<double, 2> velocity = -inverse * (damper(node) + damper(node + 1)) -
                                 damping_.mass_factor * Matrix<double, 2>::Identity();
    if (sprung() && node == chain_.loaded_node()) {
      position(1, 1) -= inverse * absorber_.stiffness;
      velocity(1, 1) -= inverse * absorber_.damping;
      set(own + 3, own + 4, inverse * absorber_.stiffness);
      set(own + 3, own + 5, inverse * absorber_.damping);
      set(own + 4, own + 5, 1.0);
      set(own + 5, own + 1, absorber_.stiffness / absorber_.mass);
      set(own + 5, own + 3, absorber_.damping / absorber_.mass);
      set(own + 5, own + 4, -absorber_.stiffness / absorber_.mass);
      set(own + 5, own + 5, -absorber_.damping / absorber_.mass);
    }
    for (int i = 0; i < 2; ++i) set(own + i, own + 2 + i, 1.0);
    block(own + 2, own, position);
    block(own + 2, own + 2, velocity);
    if (node > 0) {
      block(own + 2, first_state(node - 1), inverse * before);
      block(own + 2, first_state(node - 1) + 2, inverse * damper(node));
    }
    if (node + 1 < chain_.free_nodes()) {
      block(own + 2, first_state(node + 1), inverse * behind);
      block(own + 2, first_state(node + 1) + 2, inverse * damper(node + 1));
    }
    before = behind;
  }
}

inline BarChain::Nodes CableElements::positions(const double* state) const {
  BarChain::Nodes nodes(2, chain_.free_nodes());
  for (int node = 0; node < chain_.free_nodes(); ++node)
    nodes.col(node) << state[first_state(node)], state[first_state(node) + 1];
  return nodes;
}

inline double CableElements::energy(const Eigen::VectorXd& state) const {
  const BarChain::Nodes nodes = positions(state.data());
  double sum = -resting_load() * nodes(1, chain_.loaded_node());
  for (int node = 0; node < chain_.free_nodes(); ++node) {
    sum += 0.5 * inertia(node) * state.segment<2>(first_state(node) + 2).squaredNorm();
    sum -= chain_.mass(node) * chain_.conductor().gravity * nodes(1, node);
  }
  for (int e = 0; e < chain_.elements(); ++e) {
    const double stretch = chain_.reach(nodes, e).norm() - chain_.length(e);
    sum += 0.5 * chain_.axial_stiffness() / chain_.length(e) * stretch * stretch;
  }
  if (!sprung()) return sum;
  const int own = first_state(chain_.loaded_node());
  const double lag = state[own + 4] - displacement(state);
  return sum + 0.5 * absorber_.stiffness * lag * lag +
         0.5 * absorber_.mass * state[own + 5] * state[own + 5];
}

}  // namespace holdfast
