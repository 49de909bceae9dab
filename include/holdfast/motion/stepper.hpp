#pragma once

#include <cstdint>

#include "holdfast/backlash/hysteresis.hpp"
#include "holdfast/control/gains.hpp"
#include "holdfast/control/harmonic_input.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/core/select.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/motion/excitation.hpp"

namespace holdfast {

/// What is known of the motion at one sample.
template <class Scalar>
struct MotionSample {
  std::int64_t index;       ///< j
  double time;              ///< t_j = j τ (s)
  Vector<Scalar, 4> state;  ///< z_j = [z₁, ż₁, z₂, ż₂] (m, m/s, m, m/s)
  Scalar control_force;     ///< u_j (N), applied from t_j + δ to t_{j+1} + δ; 0 in the backlash
  Mask<Scalar> engaged;     ///< true where the drive transmits, false in the backlash
};

/// The motion of the sampled loop with backlash, one sample at a time.
///
/// `sense()` decides the drive's contact and the force u_j from the present state; `advance()`
/// moves the state over one sampling period:
///
///     z_{j+1} = A_d z_j + Γ₁ u_{j−1} + Γ₀ u_j + F_m (g_c cos ω t_j + g_s sin ω t_j)
///
/// Work per sample: 32 multiply-adds, the hysteresis, one cosine and sine. Nothing is allocated.
/// Source: Kollár 2022, Eqs. (11)–(14).
/// @tparam Law  the backlash: `step(Δz, Δż)` returns a mask that is true where the force is
/// transmitted
template <class Scalar, class Law = Backlash<Scalar>>
class SampledMotion {
 public:
  SampledMotion(const SampledLoop<Scalar>& loop, const PdGains<Scalar>& gains,
                const HarmonicInput<Scalar>& input, const HarmonicExcitation<Scalar>& excitation,
                const Law& law, const Vector<Scalar, 4>& initial_state)
      : loop_(loop),
        gains_(gains),
        input_(input),
        excitation_(excitation),
        law_(law),
        state_(initial_state),
        previous_force_(0) {}

  /// Takes sample j: decides whether the force is transmitted, and how large it is. Call once per
  /// sample.
  MotionSample<Scalar> sense() {
    const Mask<Scalar> engaged = law_.step(state_[2] - state_[0], state_[3] - state_[1]);
    const Scalar command = gains_.proportional * state_[0] + gains_.differential * state_[1];
    present_force_ = select(engaged, command, Scalar(0));
    return {index_, time(), state_, present_force_, engaged};
  }

  /// Moves from t_j to t_{j+1} under the force that the last `sense()` decided.
  void advance() {
    const auto force = sample_excitation(excitation_, loop_.sampling.period, index_);
    const Vector<Scalar, 4> next = loop_.transition * state_ +
                                   loop_.previous_force * previous_force_ +
                                   loop_.present_force * present_force_ +
                                   input_.cosine * force.cosine + input_.sine * force.sine;
    state_ = next;
    previous_force_ = present_force_;
    ++index_;
  }

  /// Adds a displacement (m) to the conductor at the present instant; call before `sense()`.
  void displace_conductor(const Scalar& displacement) { state_[0] += displacement; }

  std::int64_t index() const { return index_; }
  /// t_j (s).
  double time() const {
    return static_cast<double>(index_) * static_cast<double>(loop_.sampling.period);
  }
  const Vector<Scalar, 4>& state() const { return state_; }
  const SampledLoop<Scalar>& loop() const { return loop_; }
  const Law& law() const { return law_; }

 private:
  SampledLoop<Scalar> loop_;
  PdGains<Scalar> gains_;
  HarmonicInput<Scalar> input_;
  HarmonicExcitation<Scalar> excitation_;
  Law law_;
  Vector<Scalar, 4> state_;
  Scalar previous_force_;
  Scalar present_force_{0};
  std::int64_t index_ = 0;
};

}  // namespace holdfast
