#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cmath>

#include "holdfast/cable/conductor.hpp"
#include "holdfast/cable/elements.hpp"
#include "holdfast/core/types.hpp"

namespace holdfast {

/// The shallow cable condensed to a few coordinates: the cheap second opinion to the elements.
///
/// w(x) = Σ q_i φ_i(x) with `Sines` sines sin(iπx/L) and the tent function with its top at x_p
/// (without it the kink under the load converges slowly: the statics miss by 14 % with 8 sines):
///
///     M q̈ + C q̇ + (H + h) K q + h (μg/H) b = F φ(x_p),
///     h = (EA/L_e) [(μg/H) b·q + ½ qᵀ K q],
///     M = μ ∫ φ φᵀ dx,  K = ∫ φ' φ'ᵀ dx,  b = ∫ φ dx,
///
/// H the parabola's tension, h quasi-static (the cable stretches at once all along). F is the
/// absorber's weight and what is added; C = α M + β K_t with the tangent K_t at the equilibrium
/// with the weight. Source: Irvine 1981, Sect. 3.2, for h; Galerkin's method for the rest.
///
/// State: [q, q̇]. Not stiff.
template <int Sines = 8>
class CondensedCable {
 public:
  /// Number of coordinates: the sines and the tent.
  static constexpr int coordinates = Sines + 1;
  /// q (m): the sines, the longest wave first, and then the tent; or what belongs to them.
  using Coordinates = Vector<double, coordinates>;
  /// A matrix over the coordinates.
  using Square = Matrix<double, coordinates>;

  /// @param position  x_p (m); mass in kg
  CondensedCable(const Conductor<double>& conductor, double position, double absorber_mass,
                 const RayleighDamping& damping);

  /// Size of a state: q and q̇.
  static constexpr int states() { return 2 * coordinates; }

  /// The state at rest under a further force (N), and whether that and the equilibrium with the
  /// weight alone were found.
  struct Start {
    Eigen::VectorXd state;       ///< [q, 0], of states() numbers; of use where it converged
    EquilibriumOutcome outcome;  ///< converged where both were found
  };
  /// @param force  N, downward positive, beside the weight of the absorber
  Start held_by(double force) const {
    const auto [held, outcome] = equilibrium(resting_load_ + force);
    const bool found = rest_outcome_ == EquilibriumOutcome::converged;
    Start start{Eigen::VectorXd::Zero(states()), found ? outcome : rest_outcome_};
    start.state.template head<coordinates>() = held;
    return start;
  }

  /// Drop (m) of the absorber's place from the equilibrium.
  template <class State>
  double displacement(const State& state) const {
    double sum = -place_.dot(rest_);
    for (int i = 0; i < coordinates; ++i) sum += place_[i] * state[i];
    return sum;
  }

  /// H + h (N).
  double tension(const double* state) const {
    return tension_ + additional_tension(Eigen::Map<const Coordinates>(state));
  }

  /// The tension (N): the cable is one while it is positive.
  double margin(const double* state) const { return tension(state); }

  /// d(state)/dt.
  void rate(const double* state, double* rate_of_state) const {
    const Eigen::Map<const Coordinates> q(state), speed(state + coordinates);
    Eigen::Map<Coordinates> q_rate(rate_of_state), speed_rate(rate_of_state + coordinates);
    q_rate = speed;
    speed_rate = inverse_mass_ * (resting_load_ * place_ - damping_ * speed - internal_force(q));
  }

 private:
  struct Equilibrium {
    Coordinates coordinates;
    EquilibriumOutcome outcome;
  };

  /// h (N).
  double additional_tension(const Coordinates& q) const {
    return stretch_ * (slope_ * load_shape_.dot(q) + 0.5 * q.dot(stiffness_ * q));
  }
  /// ∂h/∂q, over EA/L_e.
  Coordinates tension_gradient(const Coordinates& q) const {
    return slope_ * load_shape_ + stiffness_ * q;
  }
  Coordinates internal_force(const Coordinates& q) const {
    const double added = additional_tension(q);
    return (tension_ + added) * (stiffness_ * q) + added * slope_ * load_shape_;
  }
  Square tangent(const Coordinates& q) const {
    const Coordinates gradient = tension_gradient(q);
    return (tension_ + additional_tension(q)) * stiffness_ +
           stretch_ * gradient * gradient.transpose();
  }
  Equilibrium equilibrium(double load) const;

  double tension_, stretch_, slope_, resting_load_;
  Square mass_ = Square::Zero(), stiffness_ = Square::Zero(), inverse_mass_, damping_;
  Coordinates load_shape_, place_, rest_;
  EquilibriumOutcome rest_outcome_;
};

template <int Sines>
CondensedCable<Sines>::CondensedCable(const Conductor<double>& conductor, double position,
                                      double absorber_mass, const RayleighDamping& damping) {
  const double span = conductor.span;
  tension_ = conductor.parabolic_tension();
  stretch_ = conductor.axial_stiffness() / conductor.effective_length();
  slope_ = conductor.weight_per_length() / tension_;
  resting_load_ = absorber_mass * conductor.gravity;
  // The tent's second derivative is −kink at x_p: its products with a sine need no integral.
  const double kink = span / (position * (span - position));
  for (int i = 0; i < Sines; ++i) {
    const double wave = (i + 1) * pi<double> / span, at_place = std::sin(wave * position);
    mass_(i, i) = span / 2;
    stiffness_(i, i) = wave * wave * span / 2;
    mass_(i, Sines) = mass_(Sines, i) = kink * at_place / (wave * wave);
    stiffness_(i, Sines) = stiffness_(Sines, i) = kink * at_place;
    load_shape_[i] = i % 2 == 0 ? 2.0 / wave : 0.0;
    place_[i] = at_place;
  }
  mass_(Sines, Sines) = span / 3;
  stiffness_(Sines, Sines) = kink;
  load_shape_[Sines] = span / 2;
  place_[Sines] = 1.0;
  mass_ *= conductor.mass_per_length;
  inverse_mass_ = mass_.llt().solve(Square::Identity());
  const Equilibrium rest = equilibrium(resting_load_);
  rest_ = rest.coordinates;
  rest_outcome_ = rest.outcome;
  damping_ = damping.mass_factor * mass_ + damping.stiffness_factor * tangent(rest_);
}

/// Newton's method, each step halved while it does not lessen the unbalanced force.
template <int Sines>
typename CondensedCable<Sines>::Equilibrium CondensedCable<Sines>::equilibrium(double load) const {
  Equilibrium result{Coordinates::Zero(), EquilibriumOutcome::not_converged};
  Coordinates left = load * place_;
  const double resolution = 1e-13 * (left.norm() + tension_);
  for (int step = 0; step < 100 && left.norm() > resolution; ++step) {
    Coordinates change = tangent(result.coordinates).ldlt().solve(left);
    bool closer = false;
    for (int halving = 0; halving < 40 && !closer; ++halving, change *= 0.5) {
      const Coordinates trial = result.coordinates + change;
      const Coordinates trial_left = load * place_ - internal_force(trial);
      closer = trial_left.norm() < left.norm();
      if (!closer) continue;
      result.coordinates = trial;
      left = trial_left;
    }
    if (!closer) break;
  }
  if (left.norm() <= 1e4 * resolution) result.outcome = EquilibriumOutcome::converged;
  return result;
}

}  // namespace holdfast
