#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <vector>

#include "holdfast/contact/contact.hpp"
#include "holdfast/contact/contact_guard.hpp"
#include "holdfast/contact/contact_mode.hpp"
#include "holdfast/core/lanes.hpp"
#include "holdfast/core/select.hpp"
#include "holdfast/motion/batch/event_table.hpp"
#include "holdfast/motion/batch/lane_excitation.hpp"
#include "holdfast/motion/batch/lane_numbers.hpp"
#include "holdfast/motion/batch/two_mass_series.hpp"
#include "holdfast/motion/implemented_loop.hpp"
#include "holdfast/motion/subinterval_step.hpp"
#include "holdfast/plant/affine_dynamics.hpp"
#include "holdfast/plant/two_mass.hpp"

namespace holdfast {

/// The data of one motion of an EventPack: its loop, EventTable and initial state.
struct EventStart {
  const ImplementedLoop* loop;  ///< loop for which has_event_pack() is true
  EventTable* table;            ///< table valid for the loop (serves()); it must outlive the pack
  Vector<double, 4> state;      ///< initial state z_0 (m, m/s, m, m/s), finite
};

/// A guard function (GuardOf) in every lane, g = state · z + command u + force F + constant.
template <class Scalar>
struct LaneGuard {
  std::array<LaneNumbers<Scalar>, 4> state;  ///< coefficients of z₁, ż₁, z₂, ż₂
  LaneNumbers<Scalar> command;               ///< coefficient of the command u, per newton
  LaneNumbers<Scalar> force;                 ///< coefficient of the excitation F, per newton
  LaneNumbers<Scalar> constant;              ///< constant, in the unit of g
  LaneNumbers<Scalar> zeros;  ///< number of leading zeros of g, ġ, g̈, … after a contact change

  /// The value of g without its force term, for the state z and the command u (N).
  Scalar at(const std::array<Scalar, 4>& z, const Scalar& u) const {
    return state[0].all() * z[0] + state[1].all() * z[1] + state[2].all() * z[2] +
           state[3].all() * z[3] + (command.all() * u + constant.all());
  }
};

/// The SubintervalStep of every lane: the map of the state over a part, h (s) long, of the sampling
/// period. Also contains the coefficients NoEventBoundOf::Drop for this part.
template <class Scalar>
struct LaneStep {
  using Numbers = LaneNumbers<Scalar>;               ///< one number for each lane
  std::array<std::array<Numbers, 4>, 4> transition;  ///< rows of the matrix e^{A h}
  std::array<Numbers, 4> command;                    ///< response to the command, per newton of u
  std::array<Numbers, 4> drift;                      ///< contribution of the constant part of ż
  std::vector<std::array<std::array<Numbers, 4>, 2>> lines;  ///< g_c, g_s of harmonics, per newton
  Numbers drop_by_norm;                                      ///< factor of ‖z‖ (Drop::by_norm)
  Numbers drop_by_command;                                   ///< factor of |u| (Drop::by_command)
  Numbers drop_constant;                                     ///< constant term (Drop::constant)

  /// The state at the end of the part, from the state z at its beginning, under the command u (N).
  std::array<Scalar, 4> state(const std::array<Scalar, 4>& z, const Scalar& u,
                              const LaneExcitation<Scalar>& excitation) const {
    std::array<Scalar, 4> after{drift[0].all(), drift[1].all(), drift[2].all(), drift[3].all()};
    for (std::size_t l = 0; l < lines.size(); ++l) {
      const ExcitationSample<Scalar>& phase = excitation.phase(l);
      const auto& [cosine, sine] = lines[l];
      for (std::size_t i = 0; i < 4; ++i)
        after[i] = sine[i].all() * phase.sine + (cosine[i].all() * phase.cosine + after[i]);
    }
    for (std::size_t i = 0; i < 4; ++i) {
      // The command is known last.
      for (std::size_t k = 0; k < 4; ++k) after[i] = transition[i][k].all() * z[k] + after[i];
      after[i] = command[i].all() * u + after[i];
    }
    return after;
  }
};

/// The contacts of a pack of motions, each with its mode and the equations of motion in this mode.
template <class Scalar>
class LaneModes {
  using Numbers = LaneNumbers<Scalar>;

 public:
  static constexpr std::size_t lanes = Lanes<Scalar>::count;  ///< number of lanes (motions)

  /// @param starts      loops, tables and initial states of the motions, one per lane
  /// @param excitation  excitation of these motions
  LaneModes(const std::array<EventStart, lanes>& starts, const LaneExcitation<Scalar>& excitation)
      : starts_(starts) {
    for (auto& step : steps_) step.lines.resize(excitation.lines());
    modes_.fill(none);
    stepped_modes_.fill(none);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      held_.set(lane, excitation.is_held(lane));
      contacts_.push_back(contact_of(lane, starts[lane].state));
      enter(lane);
    }
  }

  /// Restarts a lane from the state z = [z₁, ż₁, z₂, ż₂] (m, m/s, m, m/s) with its initial contact.
  void restart(std::size_t lane, const Vector<double, 4>& state) {
    contacts_[lane] = contact_of(lane, state);
    ignored_.reset(lane);
    enter(lane);
  }

  /// The contact of a lane, which may be changed: call `enter` or `refresh_guards` afterwards.
  DriveContact<>& contact(std::size_t lane) { return contacts_[lane]; }
  /// The contact of a lane, for reading only.
  const DriveContact<>& contact(std::size_t lane) const { return contacts_[lane]; }

  /// Updates a lane after a change of its contact mode; the next step() recomputes its LaneStep.
  void enter(std::size_t lane) {
    const DriveContact<>& contact = contacts_[lane];
    const int mode = contact.mode();
    const EventTable& table = *starts_[lane].table;
    const auto& dynamics = table.motion(mode).dynamics();
    for (std::size_t mass = 0; mass < 2; ++mass)
      by_command_[mass][lane] = dynamics.command[static_cast<Eigen::Index>(2 * mass + 1)];
    if (!table.move_alike(modes_[lane], mode)) enter_dynamics(lane, dynamics);
    modes_[lane] = mode;
    rate_[lane] = table.rate(mode);
    engaged_[lane] = contact.word() == ContactMode::engaged ? 1.0 : 0.0;
    sticks_[lane] = contact.word() == ContactMode::stick ? 1.0 : 0.0;
    sticking_.set(lane, contact.word() == ContactMode::stick);
    stale_.set(lane, true);
    refresh_guards(lane);
  }

  /// Updates the coefficients that `guard()` returns for a lane from the guards of its contact.
  void refresh_guards(std::size_t lane) {
    constexpr double far = 1e90;
    const Guards guards = ignored_[lane] ? Guards() : contacts_[lane].guards();
    bool fresh = false;
    for (std::size_t g = 0; g < 2; ++g) {
      const bool has = static_cast<int>(g) < guards.count;
      const Guard& guard = guards.guard[g];
      LaneGuard<Scalar>& to = guards_[g];
      for (std::size_t i = 0; i < 4; ++i)
        to.state[i][lane] = has ? guard.state[static_cast<Eigen::Index>(i)] : 0.0;
      to.command[lane] = has ? guard.command : 0.0;
      to.force[lane] = has ? guard.force : 0.0;
      to.constant[lane] = has ? guard.constant : far;
      to.zeros[lane] = has ? guard.zeros : 0;
      fresh = fresh || (has && (guard.zeros > 0 || guard.unsigned_yet));
    }
    unsigned_.set(lane, guards.count > 0 && guards.guard[0].unsigned_yet);
    set_fresh(lane, fresh);
    two_guards_.set(lane, guards.count > 1);
    has_guard_[lane] = guards.count > 0 ? 1.0 : 0.0;
  }

  /// Ignores all further changes of the contact in a lane, until restart().
  void ignore_guards(std::size_t lane) {
    ignored_.set(lane);
    refresh_guards(lane);
  }

  /// Records that time has passed in a lane since its contact changed. The lane is then no longer
  /// fresh(), unless the sign of a guard is still unknown.
  void flowed(std::size_t lane) {
    contacts_[lane].flowed();
    if (unsigned_[lane]) return refresh_guards(lane);
    for (LaneGuard<Scalar>& guard : guards_) guard.zeros[lane] = 0.0;
    set_fresh(lane, false);
  }

  /// The accelerations of conductor (index 0) and absorber (index 1) as functions of state and
  /// excitation, under the command u (N).
  std::array<LaneAcceleration<Scalar>, 2> accelerations(const Scalar& u) const {
    const auto row = [&](std::size_t mass) {
      const auto& of = acceleration_[mass];
      return LaneAcceleration<Scalar>{{of[0].all(), of[1].all(), of[2].all(), of[3].all()},
                                      by_command_[mass].all() * u + drift_[mass].all(),
                                      by_force_[mass].all()};
    };
    return {row(0), row(1)};
  }

  /// The LaneStep of all lanes in their present modes, over part 0 (before t_j + δ) or 1 (after).
  const LaneStep<Scalar>& step(std::size_t part) {
    if (stale_.any()) refresh_steps();
    return steps_[part];
  }

  /// The norm ‖z‖ (EnergyNorm) in the present mode of each lane; step() must be called before.
  Scalar norm(const std::array<Scalar, 4>& z) const {
    using std::sqrt;
    const Scalar relative = z[2] - z[0];
    return sqrt(Scalar(energy_[0].all() * z[0] * z[0] + energy_[2].all() * relative * relative +
                       energy_[1].all() * z[1] * z[1] + energy_[3].all() * z[3] * z[3]));
  }

  /// The first (0) or second (1) guard of all lanes; a missing guard has the constant 10⁹⁰.
  const LaneGuard<Scalar>& guard(std::size_t number) const { return guards_[number]; }
  /// The rate (1/s) of each lane in its present mode: one Taylor series covers a time ≤ 1/rate.
  Scalar rate() const { return rate_.all(); }
  /// The lanes in ContactMode::engaged, whose drive transmits the command.
  Mask<Scalar> engaged() const { return engaged_.all() > Scalar(0.5); }
  /// The lanes in ContactMode::stick, where Δż = 0.
  Mask<Scalar> sticks() const { return sticks_.all() > Scalar(0.5); }
  /// The fresh lanes: the contact has just changed, or the sign of a guard is unknown.
  Mask<Scalar> fresh() const { return fresh_.all() > Scalar(0.5); }
  /// The lanes that are not fresh().
  Mask<Scalar> settled() const { return fresh_.all() < Scalar(0.5); }
  /// The lanes without a guard: their contact cannot change between samples.
  Mask<Scalar> unguarded() const { return has_guard_.all() < Scalar(0.5); }
  /// The lanes with a guard: their contact may change between samples.
  Mask<Scalar> guarded() const { return has_guard_.all() > Scalar(0.5); }
  /// The lanes of sticks(), one bit per lane.
  const std::bitset<lanes>& sticking() const { return sticking_; }
  /// The lanes of fresh(), one bit per lane.
  const std::bitset<lanes>& freshly_changed() const { return fresh_lanes_; }
  /// The lanes whose contact has two guards, one bit per lane.
  const std::bitset<lanes>& with_two_guards() const { return two_guards_; }
  /// The lanes in which the sign of guard 0 is unknown (GuardOf::unsigned_yet), one bit per lane.
  const std::bitset<lanes>& without_sign() const { return unsigned_; }

 private:
  static constexpr int none = -1;

  DriveContact<> contact_of(std::size_t lane, const Vector<double, 4>& state) const {
    const ImplementedLoop& loop = *starts_[lane].loop;
    return {loop.plant, loop.backlash, loop.switching, state};
  }

  void enter_dynamics(std::size_t lane, const AffineDynamics& dynamics) {
    for (std::size_t mass = 0; mass < 2; ++mass) {
      const auto row = static_cast<Eigen::Index>(2 * mass + 1);
      for (std::size_t i = 0; i < 4; ++i)
        acceleration_[mass][i][lane] = dynamics.state(row, static_cast<Eigen::Index>(i));
      drift_[mass][lane] = dynamics.drift[row];
      by_force_[mass][lane] = dynamics.force[row];
    }
  }

  void refresh_steps() {
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      if (!stale_[lane]) continue;
      const int mode = modes_[lane];
      const EventTable& table = *starts_[lane].table;
      const bool alike = table.move_alike(stepped_modes_[lane], mode);
      stepped_modes_[lane] = mode;
      const auto& sampling = starts_[lane].loop->digital.sampling;
      for (std::size_t part = sampling.processing_delay > 0.0 ? 0 : 1; part < 2; ++part) {
        const SubintervalStep<4>& step = table.motion(mode).step(part);
        for (std::size_t i = 0; i < 4; ++i)
          steps_[part].command[i][lane] = step.command[static_cast<Eigen::Index>(i)];
        if (!alike) enter_step(lane, part, step);
        if (contacts_[lane].changes_between_samples()) enter_drop(lane, part);
      }
      if (alike) continue;
      const TwoMass<double> plant = contacts_[lane].plant(mode);
      energy_[0][lane] = plant.conductor_stiffness;
      energy_[1][lane] = plant.conductor_mass;
      energy_[2][lane] = plant.absorber_stiffness;
      energy_[3][lane] = plant.absorber_mass;
    }
    stale_.reset();
  }

  void enter_step(std::size_t lane, std::size_t part, const SubintervalStep<4>& from) {
    LaneStep<Scalar>& to = steps_[part];
    const bool held = held_[lane];
    for (std::size_t i = 0; i < 4; ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      for (std::size_t k = 0; k < 4; ++k)
        to.transition[i][k][lane] = from.transition(row, static_cast<Eigen::Index>(k));
      to.drift[i][lane] = from.drift[row];
      for (std::size_t l = 0; l < to.lines.size(); ++l) {
        const bool has = !held && l < from.lines.size();
        to.lines[l][0][i][lane] = has              ? from.lines[l].cosine[row]
                                  : held && l == 0 ? from.held[row]
                                                   : 0.0;
        to.lines[l][1][i][lane] = has ? from.lines[l].sine[row] : 0.0;
      }
    }
  }

  void enter_drop(std::size_t lane, std::size_t part) {
    const EventTable::Drop drop = starts_[lane].table->drop(contacts_[lane], part);
    steps_[part].drop_by_norm[lane] = drop.by_norm;
    steps_[part].drop_by_command[lane] = drop.by_command;
    steps_[part].drop_constant[lane] = drop.constant;
  }

  void set_fresh(std::size_t lane, bool fresh) {
    fresh_[lane] = fresh ? 1.0 : 0.0;
    fresh_lanes_.set(lane, fresh);
  }

  std::array<EventStart, lanes> starts_;
  std::vector<DriveContact<>> contacts_;
  std::array<int, lanes> modes_{}, stepped_modes_{};
  std::array<LaneStep<Scalar>, 2> steps_;
  std::array<std::array<Numbers, 4>, 2> acceleration_;
  std::array<Numbers, 2> by_command_, drift_, by_force_;
  std::array<Numbers, 4> energy_;
  std::array<LaneGuard<Scalar>, 2> guards_;
  Numbers rate_, engaged_, sticks_, fresh_, has_guard_;
  std::bitset<lanes> fresh_lanes_, sticking_, unsigned_, two_guards_, stale_, ignored_, held_;
};

}  // namespace holdfast
