#pragma once

#include <Eigen/Core>
#include <vector>

#include "holdfast/cable/bar_chain.hpp"
#include "holdfast/core/errors.hpp"

namespace holdfast {

/// Model of the absorber on a node of a cable that consists of elastic bars.
enum class AbsorberReading {
  weight,      ///< the weight m₂ g without inertia
  rigid_mass,  ///< a mass m₂ fixed to the node: inertia in both directions, Rayleigh damping α m₂
  spring_mass,  ///< a mass m₂ below the node on a vertical spring and a vertical damper
};

/// The absorber on a node of a cable that consists of elastic bars.
struct HangingAbsorber {
  AbsorberReading reading;  ///< model of the absorber
  double mass;              ///< mass m₂ (kg), ≥ 0; > 0 for `spring_mass`
  double stiffness = 0.0;   ///< spring stiffness k₂ (N/m), > 0; used for `spring_mass` only
  double damping = 0.0;     ///< damper coefficient c₂ (N s/m), ≥ 0; used for `spring_mass` only
  /// Clamp mass M_c (kg), ≥ 0; used for `spring_mass` only. It adds inertia to the node, no weight
  double clamp_mass = 0.0;
  bool sideways = false;  ///< whether m₂ of a `spring_mass` has inertia along the span too
};

/// Rejects an absorber with a member outside its range.
/// @throws InvalidParameter for m₂ or M_c < 0; for `spring_mass` also m₂ or k₂ ≤ 0, or c₂ < 0
inline void validate(const HangingAbsorber& absorber) {
  require_non_negative("absorber mass m2", absorber.mass, "kg");
  require_non_negative("clamp mass", absorber.clamp_mass, "kg");
  if (absorber.reading != AbsorberReading::spring_mass) return;
  require_positive("absorber mass m2", absorber.mass, "kg");
  require_positive("absorber stiffness k2", absorber.stiffness, "N/m");
  require_non_negative("absorber damping c2", absorber.damping, "N s/m");
}

/// Rayleigh damping: the damping matrix C = α M + β K of mass matrix M and stiffness matrix K.
struct RayleighDamping {
  double mass_factor;       ///< factor α of the mass matrix (1/s), ≥ 0
  double stiffness_factor;  ///< factor β of the stiffness matrix (s), ≥ 0

  /// Damping ratio ζ = α/(2ω) + βω/2 of a mode of angular frequency ω (rad/s) > 0.
  double damping_ratio(double angular_frequency) const {
    return 0.5 * (mass_factor / angular_frequency + stiffness_factor * angular_frequency);
  }
};

/// Rayleigh damping that has the damping ratio ζ at two given frequencies, ω₁/2π and ω₂/2π (Hz):
/// α = 2 ζ ω₁ω₂/(ω₁ + ω₂), β = 2 ζ/(ω₁ + ω₂).
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

/// Equations of motion M v̇ + C v + f(q) = F of a cable with an absorber. The cable is a chain of
/// elastic bars, see BasicBarChain. q are positions, v velocities, M lumped masses, f internal
/// forces, F loads. The damping matrix is C = α M + β K with the stiffness K at the equilibrium
/// under gravity, absorber included. The class computes the time derivative of the state and the
/// Jacobian of this derivative; it has no solver.
///
/// The state is an array of states() numbers: [x, y, ẋ, ẏ] (m, m/s) of each free node in turn, x
/// along the span, y downward. For a `spring_mass`, [a, ȧ] is inserted after the states of its
/// node; a (m) is the absorber's downward displacement from the equilibrium.
/// @tparam Real  number type, always `double`; as a template the class is compiled only where used
template <class Real>
class BasicCableElements {
 public:
  /// Positions (m) of the free nodes, one column per node.
  using Nodes = typename BasicBarChain<Real>::Nodes;
  /// State vector with `states()` entries.
  using States = Vector<Real, Eigen::Dynamic>;

  /// @param conductor  conductor of the cable, one that `validate` accepts
  /// @param position   horizontal distance x_p (m) of the absorber from the left support in the
  ///                   cable under its own weight alone, 0 < x_p < span
  /// @param elements   number N of bars, 2 … 10⁶
  /// @param absorber   absorber on the node at x_p
  /// @param damping    damping of the cable; both factors ≥ 0
  /// @throws InvalidParameter outside these ranges, or for an absorber that `validate` rejects
  BasicCableElements(const Conductor<Real>& conductor, Real position, int elements,
                     const HangingAbsorber& absorber, const RayleighDamping& damping)
      : chain_(conductor, position, elements), absorber_(absorber), damping_(damping) {
    validate(absorber);
    require_non_negative("mass factor alpha", damping.mass_factor, "1/s");
    require_non_negative("stiffness factor beta", damping.stiffness_factor, "s");
    rest_ = chain_equilibrium(chain_, resting_load());
    for (int e = 0; e < chain_.elements(); ++e)
      bar_damping_.emplace_back(
          damping_.stiffness_factor *
          bar_stiffness(chain_.reach(rest_.nodes, e), chain_.length(e), chain_.axial_stiffness()));
  }

  /// The cable's bars and nodes, without absorber and damping.
  const BasicBarChain<Real>& chain() const { return chain_; }
  /// Whether the absorber is a `spring_mass`.
  bool is_sprung() const { return absorber_.reading == AbsorberReading::spring_mass; }
  /// Number of states of the differential equations.
  int states() const { return 4 * chain_.free_nodes() + (is_sprung() ? 2 : 0); }
  /// Half-bandwidth of the Jacobian, zero where |row − column| is larger: 7, or 9 if is_sprung().
  int half_bandwidth() const { return is_sprung() ? 9 : 7; }

  /// Equilibrium of the cable under its own weight and the absorber's weight.
  const ChainEquilibrium& rest() const { return rest_; }

  /// Result of held_by(): a state at rest under a static force.
  struct Start {
    States state;                ///< states() numbers with zero velocities; valid if converged
    EquilibriumOutcome outcome;  ///< converged: this equilibrium and rest() were both found
  };
  /// State at rest under a static force on the absorber's node, added to the absorber's weight.
  /// @param force  force (N), downward positive
  Start held_by(Real force) const {
    const ChainEquilibrium held = chain_equilibrium(chain_, resting_load() + force);
    const bool found = rest_.outcome == EquilibriumOutcome::converged;
    Start start{States::Zero(states()), found ? held.outcome : rest_.outcome};
    for (int node = 0; node < chain_.free_nodes(); ++node)
      start.state.template segment<2>(first_state(node)) = held.nodes.col(node);
    if (is_sprung()) {
      const int own = first_state(chain_.loaded_node()) + 4;
      start.state[own] = displacement(start.state);
    }
    return start;
  }

  /// Motion [z, ż, a, ȧ] (m, m/s, m, m/s) at the absorber; for a `spring_mass` only. z and a are
  /// the downward displacements of the absorber's node and of the absorber from the equilibrium.
  Vector<Real, 4> at_absorber(const Real* state) const {
    const int own = first_state(chain_.loaded_node());
    return {state[own + 1] - rest_.nodes(1, chain_.loaded_node()), state[own + 3], state[own + 4],
            state[own + 5]};
  }

  /// Adds `node_velocity` (m/s) to the velocity of the absorber's node. Adds `displacement` (m) and
  /// `velocity` (m/s) to those of the absorber. All are downward. For a `spring_mass` only.
  void strike(Real* state, Real node_velocity, Real displacement, Real velocity) const {
    const int own = first_state(chain_.loaded_node());
    state[own + 3] += node_velocity;
    state[own + 4] += displacement;
    state[own + 5] += velocity;
  }

  /// Adds to `rate_of_state`, d(state)/dt, the accelerations by two downward forces: `on_node` (N)
  /// on the absorber's node and, for a `spring_mass` only, `on_absorber` (N) on the absorber.
  void push(Real* rate_of_state, Real on_node, Real on_absorber) const {
    const int own = first_state(chain_.loaded_node());
    rate_of_state[own + 3] += on_node / inertia(chain_.loaded_node())[1];
    if (is_sprung()) rate_of_state[own + 5] += on_absorber / absorber_.mass;
  }

  /// Downward displacement (m) of the absorber's node from the equilibrium rest().
  template <class State>
  auto displacement(const State& state) const {
    return state[first_state(chain_.loaded_node()) + 1] - rest_.nodes(1, chain_.loaded_node());
  }

  /// Computes `rate_of_state` = d(state)/dt; both arrays have states() numbers of any number type.
  template <class Scalar>
  void rate(const Scalar* state, Scalar* rate_of_state) const {
    // Each bar is computed once; its pull acts on its left node, and reversed on its right node.
    NodeMotion<Scalar> here = motion_of(state, 0);
    Vector<Scalar, 2> pull_before = pull_of(0, motion_of(state, -1), here);
    for (int node = 0; node < chain_.free_nodes(); ++node) {
      const NodeMotion<Scalar> next = motion_of(state, node + 1);
      const Vector<Scalar, 2> pull_behind = pull_of(node + 1, here, next);
      Vector<Scalar, 2> force = pull_behind - pull_before;
      force[1] += Scalar(chain_.mass(node) * chain_.conductor().gravity);
      if (node == chain_.loaded_node()) {
        force[1] += Scalar(resting_load());
        if (is_sprung()) force[1] += spring_rate(state, rate_of_state);
      }
      Scalar* own = rate_of_state + first_state(node);
      for (int i = 0; i < 2; ++i) {
        own[i] = here.velocity[i];
        own[2 + i] = force[i] / Scalar(inertia(node)[i]) - mass_drag(node)[i] * here.velocity[i];
      }
      here = next;
      pull_before = pull_behind;
    }
  }

  /// Calls set(row, column, value) for each entry of ∂(d(state)/dt)/∂(state) that can be nonzero.
  template <class Set>
  void jacobian(const Real* state, Set&& set) const {
    const Nodes nodes = positions(state);
    const auto stiffness = [&](int e) {
      return bar_stiffness(chain_.reach(nodes, e), chain_.length(e), chain_.axial_stiffness());
    };
    const auto damper = [&](int e) { return bar_damping_[static_cast<std::size_t>(e)]; };
    // Acceleration of a node by the places and velocities of a node.
    const auto blocks = [&](int of, int by, const Matrix<Real, 2>& place,
                            const Matrix<Real, 2>& velocity) {
      for (int i = 0; i < 2; ++i) {
        for (int j = 0; j < 2; ++j) {
          set(first_state(of) + 2 + i, first_state(by) + j, place(i, j));
          set(first_state(of) + 2 + i, first_state(by) + 2 + j, velocity(i, j));
        }
      }
    };
    Matrix<Real, 2> before = stiffness(0);
    for (int node = 0; node < chain_.free_nodes(); ++node) {
      const int own = first_state(node);
      const Matrix<Real, 2> inverse = inertia(node).cwiseInverse().asDiagonal();
      const Matrix<Real, 2> behind = stiffness(node + 1);
      Matrix<Real, 2> place = -inverse * (before + behind);
      Matrix<Real, 2> velocity = -inverse * (damper(node) + damper(node + 1)) -
                                 Matrix<Real, 2>(mass_drag(node).asDiagonal());
      if (is_sprung() && node == chain_.loaded_node()) {
        place(1, 1) -= inverse(1, 1) * absorber_.stiffness;
        velocity(1, 1) -= inverse(1, 1) * absorber_.damping;
        spring_jacobian(set);
      }
      for (int i = 0; i < 2; ++i) set(own + i, own + 2 + i, 1.0);
      blocks(node, node, place, velocity);
      if (node > 0) blocks(node, node - 1, inverse * before, inverse * damper(node));
      if (node + 1 < chain_.free_nodes()) {
        blocks(node, node + 1, inverse * behind, inverse * damper(node + 1));
      }
      before = behind;
    }
  }

  /// Smallest tension (N) of all bars; the model of the cable is valid while it is positive.
  Real margin(const Real* state) const { return chain_.smallest_tension(positions(state)); }

  /// Positions [x, y]ᵀ (m) of the free nodes in a state.
  Nodes positions(const Real* state) const {
    Nodes nodes(2, chain_.free_nodes());
    for (int node = 0; node < chain_.free_nodes(); ++node)
      nodes.col(node) << state[first_state(node)], state[first_state(node) + 1];
    return nodes;
  }

 private:
  int first_state(int node) const {
    return 4 * node + (is_sprung() && node > chain_.loaded_node() ? 2 : 0);
  }
  /// Inertia (kg) of a node along the span and vertically.
  Vector<Real, 2> inertia(int node) const {
    Vector<Real, 2> masses = Vector<Real, 2>::Constant(chain_.mass(node));
    if (node != chain_.loaded_node()) return masses;
    if (absorber_.reading == AbsorberReading::rigid_mass) masses.array() += absorber_.mass;
    if (is_sprung()) masses.array() += absorber_.clamp_mass;
    if (is_sprung() && absorber_.sideways) masses[0] += absorber_.mass;
    return masses;
  }
  /// Damping rates (1/s) of a node by α M, along the span and vertically. Only the clamp's
  /// vertical motion is undamped.
  Vector<Real, 2> mass_drag(int node) const {
    Vector<Real, 2> drag = Vector<Real, 2>::Constant(damping_.mass_factor);
    if (is_sprung() && node == chain_.loaded_node())
      drag[1] *= chain_.mass(node) / inertia(node)[1];
    return drag;
  }
  template <class Scalar>
  struct NodeMotion {
    Vector<Scalar, 2> place, velocity;
  };
  /// Motion of a node; nodes −1 and free_nodes() are the supports.
  template <class Scalar>
  NodeMotion<Scalar> motion_of(const Scalar* state, int node) const {
    const Scalar zero(0);
    if (node < 0) return {{zero, zero}, {zero, zero}};
    if (node == chain_.free_nodes()) {
      return {{Scalar(chain_.conductor().span), zero}, {zero, zero}};
    }
    const Scalar* own = state + first_state(node);
    return {{own[0], own[1]}, {own[2], own[3]}};
  }
  /// Sum (N) of the elastic and the damping force of a bar on its left node.
  template <class Scalar>
  Vector<Scalar, 2> pull_of(int bar, const NodeMotion<Scalar>& left,
                            const NodeMotion<Scalar>& right) const {
    const Matrix<Real, 2>& damper = bar_damping_[static_cast<std::size_t>(bar)];
    const Vector<Scalar, 2> closing = right.velocity - left.velocity;
    const Vector<Scalar, 2> damping(damper(0, 0) * closing[0] + damper(0, 1) * closing[1],
                                    damper(1, 0) * closing[0] + damper(1, 1) * closing[1]);
    return bar_pull<Scalar>(right.place - left.place, chain_.length(bar),
                            chain_.axial_stiffness()) +
           damping;
  }
  /// Writes ȧ and ä of the mass on its spring; returns the spring's force (N) on the loaded node.
  template <class Scalar>
  Scalar spring_rate(const Scalar* state, Scalar* rate_of_state) const {
    const int own = first_state(chain_.loaded_node());
    const Scalar lag = state[own + 4] - displacement(state);
    const Scalar closing_speed = state[own + 5] - state[own + 3];
    const Scalar spring = absorber_.stiffness * lag + absorber_.damping * closing_speed;
    rate_of_state[own + 4] = state[own + 5];
    rate_of_state[own + 5] = -spring / Scalar(absorber_.mass);
    return spring;
  }
  template <class Set>
  void spring_jacobian(Set&& set) const {
    const int own = first_state(chain_.loaded_node());
    const Real node = inertia(chain_.loaded_node())[1], mass = absorber_.mass;
    const Real stiffness = absorber_.stiffness, damping = absorber_.damping;
    set(own + 3, own + 4, stiffness / node);
    set(own + 3, own + 5, damping / node);
    set(own + 4, own + 5, 1.0);
    set(own + 5, own + 1, stiffness / mass);
    set(own + 5, own + 3, damping / mass);
    set(own + 5, own + 4, -stiffness / mass);
    set(own + 5, own + 5, -damping / mass);
  }
  Real resting_load() const { return absorber_.mass * chain_.conductor().gravity; }

  BasicBarChain<Real> chain_;
  HangingAbsorber absorber_;
  RayleighDamping damping_;
  ChainEquilibrium rest_;
  std::vector<Matrix<Real, 2>> bar_damping_;  // β k_e at rest, per bar
};

/// The equations of motion BasicCableElements with numbers of type `double`.
using CableElements = BasicCableElements<double>;

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template class BasicCableElements<double>;
#endif

}  // namespace holdfast
