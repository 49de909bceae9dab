#pragma once

#include "holdfast/contact/contact_mode.hpp"
#include "holdfast/motion/ideal_loop.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "support/testing.hpp"

namespace holdfast::test {

/// A change of contact that a motion with exact switching has made.
struct MadeSwitch {
  std::int64_t sample;  ///< j of the period
  double after;         ///< s after t_j
  ContactMode from, to;
  int guard;  ///< of the mode that ends, as DriveContact counts; −1: a jump of command or force
};

/// A motion with exact switching in extended precision, through changes of contact that are known
/// but for the digits of their instants: Taylor's series of Newton's laws between them, Newton's
/// method for each instant. It tells how far a motion in double precision is from the true one of
/// the same changes.
class ExtendedSwitching {
 public:
  using Real = long double;
  using State = std::array<Real, 4>;

  /// @param initial_state  with ż₂ ≠ ż₁, the sign of which is σ
  ExtendedSwitching(const IdealLoop<double>& loop, const Vector<double, 4>& initial_state)
      : loop_(loop), m1_(loop.plant.conductor_mass), m2_(loop.plant.absorber_mass) {
    for (std::size_t i = 0; i < 4; ++i) state_[i] = initial_state[static_cast<Eigen::Index>(i)];
    sign_ = velocity() > 0 ? 1 : -1;
  }

  Vector<double, 4> state() const {
    return {static_cast<double>(state_[0]), static_cast<double>(state_[1]),
            static_cast<double>(state_[2]), static_cast<double>(state_[3])};
  }

  /// Moves over the period of one sample after the other.
  /// @param made      of the whole motion, in their order; those of this period are taken
  /// @param switches  gets the same with their true instants
  /// @return false where a true instant is far from the given one: the motions have parted
  bool advance(const std::vector<MadeSwitch>& made, std::vector<ContactSwitch>& switches) {
    const Real delay = loop_.sampling.processing_delay, period = loop_.sampling.period;
    const Real next_command =
        Real(loop_.gains.proportional) * state_[0] + Real(loop_.gains.differential) * state_[1];
    after_ = 0;
    command_ = delay > 0 ? command_ : next_command;
    bool commanded = !(delay > 0);
    for (; taken_ < made.size() && made[taken_].sample == sample_; ++taken_) {
      const MadeSwitch& change = made[taken_];
      const bool by_command = change.guard < 0 && change.after > 0;
      if (!commanded && (change.after > loop_.sampling.processing_delay || by_command)) {
        flow_to(delay);
        command_ = next_command;
        commanded = true;
      }
      if (change.guard >= 0 && !flow_to_root(change)) return false;
      enter(change);
      switches.push_back({static_cast<double>(Real(sample_) * period + after_), change.to});
    }
    if (!commanded) flow_to(delay);
    command_ = next_command;
    flow_to(period);
    ++sample_;
    return true;
  }

 private:
  static constexpr int terms = 28;

  Real displacement() const { return state_[2] - state_[0]; }
  Real velocity() const { return state_[3] - state_[1]; }
  Real angular_frequency() const { return 2 * std::acos(Real(-1)) * loop_.excitation.frequency; }

  /// ω t without its whole cycles; at the sample where the force is held.
  Real phase() const {
    const Real after = loop_.hold == ForceHold::exact ? after_ : 0;
    const Real cycles =
        Real(loop_.excitation.frequency) * (Real(sample_) * loop_.sampling.period + after);
    return 2 * std::acos(Real(-1)) * (cycles - std::floor(cycles));
  }
  Real force() const { return Real(loop_.excitation.amplitude) * std::cos(phase()); }
  Real force_rate() const {
    if (loop_.hold == ForceHold::sampled) return 0;
    return -Real(loop_.excitation.amplitude) * angular_frequency() * std::sin(phase());
  }

  /// Newton's laws under a transmitted force, or of both masses as one.
  State rate_of(const State& z, Real transmitted, Real excitation, bool sticks) const {
    const TwoMass<double>& part = loop_.plant;
    const Real support =
        -Real(part.conductor_stiffness) * z[0] - Real(part.conductor_damping) * z[1] + excitation;
    if (sticks) return {z[1], support / (m1_ + m2_), z[3], support / (m1_ + m2_)};
    const Real between = Real(part.absorber_stiffness) * (z[2] - z[0]) +
                         Real(part.absorber_damping) * (z[3] - z[1]) + transmitted;
    return {z[1], (support + between) / m1_, z[3], -between / m2_};
  }
  bool sticks() const { return mode_ == ContactMode::stick; }
  Real transmitted() const { return mode_ == ContactMode::engaged ? command_ : 0; }
  Real acceleration(Real under) const {
    const State rate = rate_of(state_, under, force(), false);
    return rate[3] - rate[1];
  }

  void flow_to(Real after) {
    const Real longest = 0.005L;
    while (after_ != after) {
      const Real wanted = after - after_;
      const bool last = std::abs(wanted) <= longest;
      expand(last ? wanted : std::copysign(longest, wanted));
      after_ = last ? after : after_ + std::copysign(longest, wanted);
    }
  }

  /// z ← Σ z_k, z_{k+1} = h/(k+1) (rate of z_k under the k-th derivative of the force).
  void expand(Real length) {
    const Real turn = loop_.hold == ForceHold::exact ? angular_frequency() * length : Real(0);
    Real present = force(), next = force_rate() * length;
    State term = state_;
    for (int k = 0; k < terms; ++k) {
      term = rate_of(term, k == 0 ? transmitted() : 0, present, sticks());
      for (std::size_t i = 0; i < 4; ++i) state_[i] += (term[i] *= length / (k + 1));
      const Real after_next = -turn * turn * present / ((k + 1) * (k + 2));
      present = next;
      next = after_next;
    }
  }

  struct Guard {
    Real value, slope;
  };
  Guard guard(int which) const {
    const State rate = rate_of(state_, transmitted(), force(), sticks());
    if (mode_ == ContactMode::engaged) return {velocity(), rate[3] - rate[1]};
    if (mode_ == ContactMode::gap)
      return {displacement() - (which == 0 ? upper_ : lower_), velocity()};
    const State jerk = rate_of(rate, 0, force_rate(), false);
    return {acceleration(which == 0 ? 0 : command_), jerk[3] - jerk[1]};
  }

  bool flow_to_root(const MadeSwitch& change) {
    flow_to(change.after);
    for (int iteration = 0; iteration < 20; ++iteration) {
      const auto [value, slope] = guard(change.guard);
      const Real step = -value / slope;
      if (!(std::abs(step) < 1e-5L)) return false;
      flow_to(after_ + step);
      if (std::abs(step) < 1e-17L) break;
    }
    return true;
  }

  void enter(const MadeSwitch& change) {
    if (change.from == ContactMode::gap) sign_ = change.guard == 0 ? 1 : -1;
    if (change.from == ContactMode::engaged) {
      state_[3] = state_[1];
      lower_ = displacement() - (sign_ > 0 ? Real(loop_.backlash_width) : 0);
      upper_ = displacement() + (sign_ > 0 ? 0 : Real(loop_.backlash_width));
    }
    mode_ = change.to;
  }

  IdealLoop<double> loop_;
  Real m1_, m2_;
  State state_{};
  ContactMode mode_ = ContactMode::engaged;
  int sign_;
  Real lower_ = 0, upper_ = 0, command_ = 0, after_ = 0;
  std::int64_t sample_ = 0;
  std::size_t taken_ = 0;
};

}  // namespace holdfast::test
