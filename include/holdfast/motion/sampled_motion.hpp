#pragma once

#include <cstdint>
#include <type_traits>

#include "holdfast/contact/hysteresis.hpp"
#include "holdfast/control/gains.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/core/select.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/excitation/forcing.hpp"
#include "holdfast/excitation/harmonic_excitation.hpp"
#include "holdfast/excitation/harmonic_input.hpp"
#include "holdfast/plant/port_readings.hpp"
#include "holdfast/plant/ports.hpp"
#include "holdfast/plant/two_mass.hpp"

namespace holdfast {

/// A sample of a motion: state, control force and contact at t_j.
/// @tparam States  N, the order of the plant
template <class Scalar, int States = 4>
struct MotionSample {
  std::int64_t index;            ///< number j of the sample
  Scalar time;                   ///< instant t_j = j τ (s)
  Vector<Scalar, States> state;  ///< state x_j, N × 1; of two masses z_j = [z₁, ż₁, z₂, ż₂]
  Scalar control_force;  ///< control force u_j (N), applied from t_j + δ to t_{j+1} + δ with the
                         ///< processing delay δ; 0 in the backlash
  Mask<Scalar> engaged;  ///< true where the drive transmits, false in the backlash
};

/// The memory of a motion: all data, besides the forcing, that determine its later samples.
/// @tparam LawMemory  memory of the backlash
/// @tparam States     N, the order of the plant
template <class Scalar, class LawMemory, int States = 4>
struct MotionMemory {
  Vector<Scalar, States> state;  ///< state x_j, N × 1; for two masses z_j = [z₁, ż₁, z₂, ż₂]
  Scalar previous_force;  ///< control force u_{j−1} (N), acting until t_j + processing delay
  LawMemory backlash;     ///< memory of the backlash before sample j
};

/// The motion of the sampled loop with backlash, one sample at a time.
///
/// `sense()` decides the drive's contact and the force u_j from the present state. `advance()`
/// moves the state over one sampling period; u_{j−1} acts until t_j + δ (δ: processing delay):
///
///     z_{j+1} = A_d z_j + Γ₁ u_{j−1} + Γ₀ u_j + F_m (g_c cos ω t_j + g_s sin ω t_j)
///
/// The matrices are those of SampledLoop and HarmonicInput. Work per sample for N states: N² + 2 N
/// multiply-adds, 2 N more if harmonic; no allocation. Source: Kollár 2022, Eqs. (11)–(14).
/// @tparam Scalar   number type: double, or a pack with one motion in each of its lanes
/// @tparam Law      backlash; `step(Δz, Δż)` returns a mask, true where the force is transmitted
/// @tparam Forcing  the excitation; `next()` returns its contribution to the next state, a vector
///                  of scalars (not packs) if all lanes of a pack have the same forcing
/// @tparam Plant    plant, from whose state PortReadings reads displacements and velocities
template <class Scalar, class Law = Backlash<Scalar>, class Forcing = HarmonicForcing<Scalar>,
          class Plant = TwoMass<Scalar>>
class SampledMotion {
 public:
  /// The order N of the plant.
  static constexpr int states = states_of<Plant>;
  using State = Vector<Scalar, states>;      ///< state x, N × 1
  using Loop = SampledLoop<Scalar, states>;  ///< matrices of one sampling period
  using Readings = PortReadings<Plant>;      ///< functions that read the state

  /// Constructs the motion under a harmonic excitation that begins at phase 0. No force is
  /// transmitted before the first sample: u_{−1} = 0.
  SampledMotion(const Loop& loop, const PdGains<Scalar>& gains,
                const HarmonicInput<Scalar, states>& input,
                const HarmonicExcitation<Scalar>& excitation, const Law& law,
                const State& initial_state, const Readings& readings = Readings())
      : SampledMotion(loop, gains, Forcing(input, excitation, loop.sampling.period), law,
                      initial_state, readings) {}

  /// Constructs the motion under any forcing, which continues from its present phase. u_{−1} = 0.
  /// @throws InvalidParameter where the size of the state is not N
  SampledMotion(const Loop& loop, const PdGains<Scalar>& gains, const Forcing& forcing,
                const Law& law, const State& initial_state, const Readings& readings = Readings())
      : loop_(loop),
        readings_(readings),
        gains_(gains),
        forcing_(forcing),
        law_(law),
        state_(initial_state),
        previous_force_(0) {
    require_size("size of the initial state", state_.size(), loop_.transition.rows());
  }

  /// Takes sample j: decides whether the drive transmits, and computes u_j; once per sample.
  MotionSample<Scalar, states> sense() {
    const Mask<Scalar> engaged =
        law_.step(readings_.relative_displacement(state_), readings_.relative_velocity(state_));
    const Scalar command = gains_.proportional * readings_.measured_displacement(state_) +
                           gains_.differential * readings_.measured_velocity(state_);
    present_force_ = select(engaged, command, Scalar(0));
    return {index_, time(), state_, present_force_, engaged};
  }

  /// Advances to t_{j+1}: under u_{j−1} until t_j + δ, then under u_j of `sense()`.
  void advance() {
    move(forcing_.next());
    previous_force_ = present_force_;
    ++index_;
  }

  /// Shifts the conductor suddenly by a displacement (m); to be called before `sense()`.
  void displace_conductor(const Scalar& displacement) {
    readings_.displace_conductor(state_, displacement);
  }

  /// The number j of the sample that `sense()` will take or has taken.
  std::int64_t index() const { return index_; }
  /// The instant t_j (s) of sample j = index().
  Scalar time() const { return Scalar(static_cast<double>(index_)) * loop_.sampling.period; }
  /// The state x_j, N × 1; for two masses z_j = [z₁, ż₁, z₂, ż₂] at t_j (m, m/s, m, m/s).
  const State& state() const { return state_; }
  /// The matrices that advance the state over one sampling period.
  const Loop& loop() const { return loop_; }
  /// The functions that read displacements and velocities from the plant's state.
  const Readings& readings() const { return readings_; }
  /// The gains P (N/m) and D (N s/m).
  const PdGains<Scalar>& gains() const { return gains_; }
  /// The backlash with its memory.
  const Law& law() const { return law_; }
  /// The excitation, at the phase for the next `advance()`.
  const Forcing& forcing() const { return forcing_; }
  /// The memory of the motion at t_j; to be read before `sense()`.
  auto memory() const {
    return MotionMemory<Scalar, std::decay_t<decltype(law_.memory())>, states>{
        state_, previous_force_, law_.memory()};
  }
  /// Sets state, u_{j−1} and backlash from a memory; keeps the sample number and the forcing phase.
  /// @throws InvalidParameter where the size of the state is not N
  template <class LawMemory>
  void restore(const MotionMemory<Scalar, LawMemory, states>& memory) {
    require_size("size of the state", memory.state.size(), state_.size());
    state_ = memory.state;
    previous_force_ = memory.previous_force;
    law_ = Law(law_.width(), memory.backlash);
  }

 private:
  /// Advances to the next sample; the order of summation is the same for all number types.
  /// @param addition  contribution of the forcing, N × 1
  template <class Addition>
  void move(const Addition& addition) {
    const Matrix<Scalar, states>& a = loop_.transition;
    const State& b = loop_.previous_force;
    const State& c = loop_.present_force;
    if constexpr (states == 4 && !std::is_arithmetic_v<Scalar>) {
      // Packs entry by entry: their expressions are too long for compilers to take apart.
      State next;
      for (int i = 0; i < 4; ++i)
        next[i] = ((a(i, 0) * state_[0] + a(i, 1) * state_[1]) +
                   (a(i, 2) * state_[2] + a(i, 3) * state_[3])) +
                  b[i] * previous_force_ + c[i] * present_force_ + Scalar(addition[i]);
      state_ = next;
    } else if constexpr (states == 4) {
      const State next = ((a.col(0) * state_[0] + a.col(1) * state_[1]) +
                          (a.col(2) * state_[2] + a.col(3) * state_[3])) +
                         b * previous_force_ + c * present_force_ +
                         addition.template cast<Scalar>();
      state_ = next;
    } else {
      const State next =
          a * state_ + b * previous_force_ + c * present_force_ + addition.template cast<Scalar>();
      state_ = next;
    }
  }

  Loop loop_;
  Readings readings_;
  PdGains<Scalar> gains_;
  Forcing forcing_;
  Law law_;
  State state_;
  Scalar previous_force_;
  Scalar present_force_ = Scalar(0);
  std::int64_t index_ = 0;
};

/// Constructs a pack of motions of two masses, one per lane, each from sample 0 with u_{−1} = 0.
/// The forcing is the same in all lanes and continues from the present phase of `motion`.
/// @param motion          motion that provides loop, gains, forcing and backlash width of all lanes
/// @param initial_states  z₀ of every lane, [z₁, ż₁, z₂, ż₂] (m, m/s, m, m/s)
template <class Pack, class Forcing>
SampledMotion<Pack, Backlash<Pack>, Forcing> in_every_lane(
    const SampledMotion<double, Backlash<double>, Forcing>& motion,
    const Vector<Pack, 4>& initial_states) {
  const PdGains<double>& gains = motion.gains();
  return {converted<Pack>(motion.loop()),
          {Pack(gains.proportional), Pack(gains.differential)},
          motion.forcing(),
          Backlash<Pack>(Pack(motion.law().width())),
          initial_states};
}

}  // namespace holdfast
