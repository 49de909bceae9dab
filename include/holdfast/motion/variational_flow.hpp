#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "holdfast/contact/contact.hpp"
#include "holdfast/control/controller.hpp"
#include "holdfast/control/zero_order_hold.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/math/linalg/structural_rank.hpp"
#include "holdfast/motion/event_motion.hpp"
#include "holdfast/motion/saltation.hpp"
#include "holdfast/motion/taylor_step.hpp"
#include "holdfast/plant/port_readings.hpp"

namespace holdfast {

/// The tangent map of an EventMotion from one sample to the next, including contact changes,
///
///     δX_{j+1} = map · δX_j,   X_j = [x; u_{j−1}; g; y_{j−1}]
///
/// X_j has N + 3 entries. x is the state of the plant, for two masses [z₁, ż₁, z₂, ż₂]. y_{j−1} is
/// the displacement that the computer measured at sample j − 1. g is the relative displacement Δz =
/// z₂ − z₁ at the last reversal of the drive; its gap has the ends g and g ∓ r₀ (r₀: gap width).
///
/// Within a contact mode δx advances by e^{A t}, with the held command's deviation as input. At a
/// contact change on a surface h = 0 the deviation of [x; g] is multiplied by the saltation matrix
/// (saltation.hpp), with these surfaces, resets of g and jumps f⁺ − f⁻ of ẋ:
///
///     engaged → gap:          h = Δż,                  g ← Δz,   f⁺ − f⁻ = −b s_e
///     engaged → stick:        h = Δż,                  g ← Δz,   f⁺ − f⁻ = b (s − s_e)
///     gap → engaged:          h = Δz − g (or ± r₀),    g ← 0,    f⁺ − f⁻ = b s_e
///     stop reached or left:   h = Δz ∓ r₀/2,   f⁺ − f⁻ due to s_e and the damper of the stop
///
/// Here b is the input column of u, s the force transmitted in stick, s_e the force of an engaged
/// drive (u for an ideal drive). No saltation matrix is needed for a jump of u, which occurs at a
/// fixed time, or for the end of stick, at which u jumps or ẋ is continuous. If the drive sticks at
/// sample j, the map is valid only for δX_j with δΔż = 0, δg = δΔz. The row of g is zero while
/// engaged. The row of y is zero unless velocity is measured by differences of unrounded
/// displacements.
///
///     VariationalFlow<DriveContact<>> tangent(motion);
///     motion.sense();
///     tangent.begin_sample(motion);
///     motion.advance(tangent);
///     tangent.map();
///
/// At a tangential crossing no derivative exists and the entries are not finite. Work per sample of
/// two masses: 140 multiply-adds for each part of the period before and after t_j + δ, and 1500
/// more per change of contact. No memory is allocated if N is fixed at compile time.
/// @tparam Contact  contact of the motion
template <class Contact>
class VariationalFlow {
 public:
  /// The order N of the plant: the number of its states.
  static constexpr int states = EventMotion<Contact>::states;
  /// The number N + 3 of entries of X_j.
  static constexpr int size = larger_size(states, 3);
  /// The type of the matrix that maps deviations of X_j, (N + 3) × (N + 3).
  using Map = Matrix<double, size>;

  /// Constructs the tangent map of a motion at its present sample, initially the identity.
  explicit VariationalFlow(const EventMotion<Contact>& motion)
      : readings_(motion.readings()),
        map_(Map::Identity(motion.state().size() + 3, motion.state().size() + 3)),
        pending_(Row::Zero(motion.state().size() + 3)),
        sticking_(motion.contact().sticking_mode()),
        rank_(inputs(motion)) {
    const Sampling<double>& sampling = motion.loop().sampling;
    lengths_ = {sampling.processing_delay, sampling.period - sampling.processing_delay};
    for (int mode = 0; mode < Contact::modes; ++mode) {
      dynamics_[at(mode)] = motion.dynamics(mode);
      anchored_[at(mode)] = motion.contact().is_anchored(mode);
      for (std::size_t part = 0; part < 2; ++part)
        steps_[part][at(mode)] = exponential(mode, lengths_[part]);
    }
  }

  /// Resets the map for a new sampling period; call it after `sense()`, before `advance(tangent)`.
  void begin_sample(const EventMotion<Contact>& motion) {
    period_ = motion.period();
    open_length_ = 0.0;
    map_.setIdentity();
    const int mode = motion.contact().mode();
    enter(mode);
    const Reading reading = read(motion);
    if (!motion.contact().transmits_command()) pending_.setZero();
    if (!carries_anchor(mode)) rank_.end(Carried::anchor);
    rank_.pass(directions(mode));
    note_sample(reading);
    rank_.pass(directions(mode));
  }

  // The observer of EventMotion::advance.

  /// Records that the motion stayed in one mode for `length` (s) from `begin` (s) after the sample.
  /// The map is updated at the next change of contact or command, or at the end of the period.
  void flowed(int mode, double begin, double length) {
    if (!(length > 0.0)) return;
    if (open_length_ == 0.0) open_begin_ = begin;
    open_mode_ = mode;
    open_length_ = begin + length - open_begin_;
    if (begin + length >= period_ * (1.0 - same_length)) close_flow();
  }

  /// At the end of the processing delay, replaces the command deviation δu_{j−1} by δu_j.
  void commanded() {
    close_flow();
    map_.row(command_row()) = pending_;
    rank_.end(Carried::in_force);
    rank_.become(Carried::pending, Carried::in_force);
  }

  /// At a change of contact, multiplies the map by the saltation matrix. No multiplication at the
  /// end of stick, or after a jump of excitation or command (guard −1).
  void switched(int from, int to, int guard,
                const typename EventMotion<Contact>::Instant& instant) {
    close_flow();
    if (guard >= 0 && from != sticking_) cross(from, to, instant);
    enter(to);
    if (!carries_anchor(to)) rank_.end(Carried::anchor);
    rank_.pass(directions(to));
  }

  /// The tangent map of the last sampling period, (N + 3) × (N + 3); complete after `advance`.
  const Map& map() const { return map_; }

  /// Structural rank of the product of all maps since construction: the rank that the product has
  /// for almost all values of the entries that are not identically zero.
  int rank_of_product() const { return rank_.rank(); }

 private:
  using Motion = EventMotion<Contact>;
  using Dynamics = typename Motion::Dynamics;
  using Instant = typename Motion::Instant;
  using State = typename Motion::State;
  using Step = HeldStep<double, states, 1>;
  using Row = RowVector<double, size>;

  Eigen::Index order() const { return map_.rows() - 3; }
  Eigen::Index command_row() const { return order(); }
  Eigen::Index anchor_row() const { return order() + 1; }
  Eigen::Index read_row() const { return order() + 2; }
  auto states_of_map() { return map_.template topRows<states>(order()); }
  /// The tolerance, relative to the period, within which two lengths of time count as equal. It
  /// allows for round-off in lengths that are sums of several steps.
  static constexpr double same_length = 1e-13;

  static constexpr std::size_t at(int mode) { return static_cast<std::size_t>(mode); }
  int directions(int mode) const { return static_cast<int>(order()) - (mode == sticking_ ? 1 : 0); }

  static unsigned inputs(const EventMotion<Contact>& motion) {
    const unsigned always =
        static_cast<unsigned>(Carried::in_force) | static_cast<unsigned>(Carried::reading);
    return motion.contact().is_anchored(motion.contact().mode())
               ? always | static_cast<unsigned>(Carried::anchor)
               : always;
  }

  /// Whether the guard g of a mode does not depend on the state x; its deviation is then stored.
  bool carries_anchor(int mode) const { return anchored(mode) && mode != sticking_; }

  bool anchored(int mode) const { return anchored_[at(mode)]; }

  /// The gradient ∂h/∂x of a mode's surface: h is Δz − g where the surface depends on g, Δz ∓ r₀/2
  /// for stops, and Δż while a drive with a moving gap is engaged.
  State gradient(int from) const {
    return sticking_ < 0 || anchored(from) ? readings_.displacement_row()
                                           : readings_.velocity_row();
  }

  /// Whether the command depends on state and previous reading, and whether the reading is stored.
  struct Reading {
    bool state, previous, remembered;
  };

  /// Computes the deviation δu_j and updates the deviations that the controller stores.
  Reading read(const Motion& motion) {
    const Row displacement = readings_.measured_displacements(states_of_map());
    const Row velocity = readings_.measured_velocities(states_of_map());
    const bool takes_effect = motion.contact().transmits_command();
    if constexpr (detail::HasController<typename Motion::Plant>::value) {
      const OwnController::Derivative derivative = motion.controller().derivative();
      const Eigen::Index own = motion.controller().states();
      OwnController::Derivative inputs(own + 2, map_.cols());
      inputs << displacement, velocity, map_.middleRows(order() - own, own);
      pending_ = derivative.row(0) * inputs;
      map_.middleRows(order() - own, own) = derivative.bottomRows(own) * inputs;
      map_.row(read_row()).setZero();
      return {takes_effect && !derivative.row(0).isZero(0.0), false, false};
    } else {
      const ControllerSlope slope = takes_effect ? motion.controller().slope() : ControllerSlope{};
      const ControllerLimits& limits = motion.controller().limits();
      const bool reads =
          limits.velocity == VelocitySensing::difference && limits.displacement_quantum == 0.0;
      pending_ = slope.displacement * displacement + slope.velocity * velocity +
                 slope.previous_displacement * map_.row(read_row());
      map_.row(read_row()) = reads ? displacement : Row(Row::Zero(map_.cols()));
      return {slope.displacement != 0.0 || slope.velocity != 0.0,
              slope.previous_displacement != 0.0, reads};
    }
  }

  /// Updates the rank at a sample, where the command uses the old reading before the new is stored.
  void note_sample(const Reading& reading) {
    if (reading.state) rank_.begin(Carried::pending);
    if (reading.previous) rank_.become(Carried::reading, Carried::pending);
    rank_.end(Carried::reading);
    if (reading.remembered) rank_.begin(Carried::reading);
  }

  Step exponential(int mode, double length) const;

  void close_flow() {
    if (open_length_ == 0.0) return;
    for (std::size_t part = 0; part < 2; ++part) {
      if (std::abs(open_length_ - lengths_[part]) > same_length * period_) continue;
      return close_flow(steps_[part][at(open_mode_)]);
    }
    close_flow(exponential(open_mode_, open_length_));
  }

  void close_flow(const Step& step) {
    const Matrix<double, states, size> state = states_of_map();
    states_of_map() = step.transition * state + step.input * map_.row(command_row());
    open_length_ = 0.0;
    enter(open_mode_);
    const bool transmits = !dynamics_[at(open_mode_)].command.isZero(0.0);
    if (transmits) rank_.act(Carried::in_force);
    rank_.pass(directions(open_mode_));
  }

  /// Imposes the constraints of a mode: δΔż = 0 and δg = δΔz in stick, δg = 0 if g is unused.
  void enter(int mode) {
    if (mode == sticking_) {
      readings_.stop_relative_motions(states_of_map());
      map_.row(anchor_row()) = readings_.relative_displacements(states_of_map());
    }
    if (!anchored(mode)) map_.row(anchor_row()).setZero();
  }

  void cross(int from, int to, const Instant& instant) {
    if (from == to && anchored(from)) return anchor_anew();
    constexpr int with_gap = larger_size(states, 1);
    const Eigen::Index n = order();
    SurfaceCrossing<with_gap> crossing;
    crossing.before = with_zero(rate(from, instant));
    crossing.after = with_zero(rate(to, instant));
    crossing.gradient = with_zero(gradient(from)).transpose();
    crossing.reset = Matrix<double, with_gap>::Identity(n + 1, n + 1);
    crossing.reset_rate = with_zero(State::Zero(n));
    if (anchored(from)) {
      crossing.gradient[n] = -1.0;
      rank_.act(Carried::anchor);
    } else if (anchored(to)) {
      crossing.reset.row(n) = with_zero(readings_.displacement_row()).transpose();
    }
    Matrix<double, with_gap, size> rows(n + 1, n + 3);
    rows << states_of_map(), map_.row(anchor_row());
    rows = saltation_matrix(crossing) * rows.eval();
    states_of_map() = rows.template topRows<states>(n);
    map_.row(anchor_row()) = rows.row(n);
  }

  static Vector<double, larger_size(states, 1)> with_zero(const State& x) {
    Vector<double, larger_size(states, 1)> longer(x.size() + 1);
    longer << x, 0.0;
    return longer;
  }

  /// Sets g to the present Δz at a change from one gap to another. ẋ does not jump.
  void anchor_anew() {
    map_.row(anchor_row()) = readings_.relative_displacements(states_of_map());
    rank_.end(Carried::anchor);
  }

  State rate(int mode, const Instant& instant) const {
    const Dynamics& dynamics = dynamics_[at(mode)];
    return dynamics.state * instant.state + dynamics.drift + dynamics.command * instant.command +
           dynamics.force * instant.force;
  }

  PortReadings<typename Motion::Plant> readings_;
  Map map_;
  Row pending_;                                // δu_j of δX_j
  int sticking_;                               // the mode in which Δż = 0; −1: none
  std::array<bool, Contact::modes> anchored_;  // whether the gap lies where the drive reversed
  std::array<Dynamics, Contact::modes> dynamics_;
  std::array<double, 2> lengths_;  // of the parts of the period before and after t_j + δ
  std::array<std::array<Step, Contact::modes>, 2> steps_;  // over these parts
  double period_ = 0.0;
  int open_mode_ = 0;
  double open_begin_ = 0.0, open_length_ = 0.0;  // stretch not yet in the map
  StructuralRank rank_;                          // of the product of the maps
};

template <class Contact>
typename VariationalFlow<Contact>::Step VariationalFlow<Contact>::exponential(int mode,
                                                                              double length) const {
  const Dynamics& dynamics = dynamics_[at(mode)];
  return zero_order_hold<double, states, 1>(dynamics.state, dynamics.command, length);
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template HeldStep<double, 4, 1> VariationalFlow<DriveContact<>>::exponential(int,
                                                                                    double) const;
#endif

}  // namespace holdfast
