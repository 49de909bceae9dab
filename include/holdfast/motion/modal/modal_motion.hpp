#pragma once

#include <complex>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "holdfast/contact/hysteresis.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/excitation/forcing.hpp"
#include "holdfast/math/linalg/complex_exponential.hpp"
#include "holdfast/motion/modal/natural_motions.hpp"
#include "holdfast/motion/sampled_motion.hpp"
#include "holdfast/plant/plant_poles.hpp"
#include "holdfast/plant/port_readings.hpp"

namespace holdfast {

/// The motion of the sampled loop of a conductor given by its modes, one sample at a time.
///
/// The motion is stored as the amplitudes ξ of the natural motions of conductor and absorber (see
/// NaturalMotion), each of which advances independently. Displacements and velocities are weighted
/// sums of the amplitudes. Computer and backlash act as in `SampledMotion`. Work per sample: 20
/// multiply-adds per natural motion, in SIMD vectors. After construction no memory is allocated.
class ModalMotion {
 public:
  static constexpr int states = 4;  ///< number of entries of the observed state
  using State = Vector<double, 4>;  ///< observed [z, ż, z₂, ż₂] (m, m/s): z conductor, z₂ absorber
  using Readings = PortReadings<TwoMass<double>>;  ///< functions that read the observed state
  using Full = NaturalMotions::Full;  ///< state [q₁, q̇₁, …, q_N, q̇_N, z₂, ż₂] of `modal_plant`

  using Memory = MotionMemory<double, BacklashMemory<double>>;  ///< memory of the motion

  /// @param loop   an admissible loop (unchecked)
  /// @param poles  all `plant_poles` of the loop's modes and absorber
  /// @param state  the initial state of `modal_plant`
  ModalMotion(const ModalLoop& loop, const std::vector<PlantPole>& poles, const Full& state)
      : loop_(loop),
        law_(loop.backlash_width),
        phases_({Vector<double, 2>::Unit(0), Vector<double, 2>::Unit(1)}, loop.excitation,
                loop.sampling.period) {
    const NaturalMotions natural(loop, poles);
    Full unit = Full::Zero(state.size());
    unit.head(state.size() - 2)(Eigen::seq(0, Eigen::last, 2)) = bent_conductor(loop.modes);
    const bool at_rest = state.isZero(0.0);
    for (std::size_t k = 0; k < natural.size(); ++k) {
      const NaturalMotion& of = natural[k];
      motions_.push_back({at_rest ? 0.0 : natural.amplitude(k, state), of.decay, of.present,
                          of.past, of.cosine, of.sine, std::conj(of.z), std::conj(of.v),
                          std::conj(of.z2), std::conj(of.v2)});
      bent_.push_back(natural.amplitude(k, unit));
    }
    read();
  }

  /// Takes sample j: decides whether the drive transmits, and computes u_j; once per sample.
  MotionSample<double> sense() {
    const bool engaged = law_.step(seen_[2] - seen_[0], seen_[3] - seen_[1]);
    present_force_ =
        engaged ? loop_.gains.proportional * seen_[0] + loop_.gains.differential * seen_[1] : 0.0;
    return {index_, time(), seen_, present_force_, engaged};
  }

  /// Advances to t_{j+1}: under u_{j−1} until t_j + δ (δ: processing delay), then under u_j.
  void advance() {
    const double u = present_force_, before = previous_force_;
    const Vector<double, 2> force = phases_.next();
    Seen seen;
    for (Block& block : motions_.blocks()) {
      auto& [state, decay, present, past, cosine, sine, z, v, z2, v2] = block;
      const Lanes re = decay.re * state.re - decay.im * state.im + present.re * u +
                       past.re * before + cosine.re * force[0] + sine.re * force[1];
      const Lanes im = decay.re * state.im + decay.im * state.re + present.im * u +
                       past.im * before + cosine.im * force[0] + sine.im * force[1];
      state = {re, im};
      seen.add(block);
    }
    seen_ = seen.sums();
    previous_force_ = u;
    ++index_;
  }

  /// Displaces the conductor in the shape of its static deflection under a force at the absorber;
  /// `by` is the displacement (m) at the absorber. To be called before `sense()`.
  void displace_conductor(double by) {
    for (std::size_t k = 0; k < bent_.size(); ++k) {
      auto row = motions_[k];
      row.front() += by * bent_[k];
      motions_.set(k, row);
    }
    read();
  }

  /// The number j of the sample that `sense()` will take or has taken.
  std::int64_t index() const { return index_; }
  /// The instant t_j (s) of sample j = index().
  double time() const { return static_cast<double>(index_) * loop_.sampling.period; }
  /// The observed state [z, ż, z₂, ż₂] at t_j.
  const State& state() const { return seen_; }
  /// The functions that read displacements and velocities from the observed state.
  const Readings& readings() const { return readings_; }
  /// The observed state at t_j, u_{j−1} and the backlash's memory; to be called before `sense()`.
  Memory memory() const { return {seen_, previous_force_, law_.memory()}; }
  /// The amplitudes ξ of all natural motions at t_j, in the order of NaturalMotions.
  Eigen::VectorXcd amplitudes() const {
    Eigen::VectorXcd all(static_cast<Eigen::Index>(motions_.size()));
    for (std::size_t k = 0; k < motions_.size(); ++k)
      all[static_cast<Eigen::Index>(k)] = motions_[k].front();
    return all;
  }

 private:
  /// The rows over all natural motions: ξ, e^{sτ}, the factors γ₀, γ₁, g_c, g_s, and the conjugate
  /// weights w̄ of the readings, Re(w ξ) = Re w̄ Re ξ + Im w̄ Im ξ.
  using Motions = detail::ComplexRows<double, 10>;
  using Block = Motions::Block;
  using Lanes = detail::ComplexLanes<double>::Reals;

  /// The sums for [z, ż, z₂, ż₂] over the blocks added so far, lane by lane.
  struct Seen {
    Lanes z = Lanes::Zero(), v = z, z2 = z, v2 = z;

    void add(const Block& of) {
      const auto& [state, decay, present, past, cosine, sine, of_z, of_v, of_z2, of_v2] = of;
      z += of_z.re * state.re + of_z.im * state.im;
      v += of_v.re * state.re + of_v.im * state.im;
      z2 += of_z2.re * state.re + of_z2.im * state.im;
      v2 += of_v2.re * state.re + of_v2.im * state.im;
    }
    State sums() const { return {z.sum(), v.sum(), z2.sum(), v2.sum()}; }
  };

  void read() {
    Seen seen;
    for (const Block& block : motions_.blocks()) seen.add(block);
    seen_ = seen.sums();
  }

  ModalLoop loop_;
  Readings readings_;
  Backlash<double> law_;
  HarmonicForcing<double, 2> phases_;
  Motions motions_;
  std::vector<std::complex<double>> bent_;  // ξ of a displacement by 1 m
  State seen_;
  double previous_force_ = 0.0, present_force_ = 0.0;
  std::int64_t index_ = 0;
};

/// The motion of a modal loop from an initial state of `modal_plant`, [q₁, q̇₁, …, z₂, ż₂].
/// @param loop   the loop with its excitation and backlash
/// @param poles  `plant_poles` of the loop's modes and absorber
/// @param state  the initial state
/// @return nullopt where `poles` is empty, because plant_poles() did not find all poles. Use then
///         harmonically_forced_motion() of `modal_plant`: N² operations per sample for N states
/// @throws InvalidParameter where the loop is not admissible, or the state is not finite or of
///         another size
inline std::optional<ModalMotion> modal_motion(const ModalLoop& loop,
                                               const std::vector<PlantPole>& poles,
                                               const ModalMotion::Full& state) {
  validate(loop);
  require_finite("initial state", state.sum(), "");
  require_size("size of the initial state", state.size(),
               static_cast<Eigen::Index>(2 * loop.modes.size() + 2));
  if (poles.empty()) return std::nullopt;
  return ModalMotion(loop, poles, state);
}

/// The motion of a modal loop from an initial state of `modal_plant`; computes the poles itself.
/// @param loop   the loop with its excitation and backlash
/// @param state  the initial state
/// @return nullopt where not all poles were found
/// @throws InvalidParameter where the loop is not admissible, or the state is not finite or of
///         another size
inline std::optional<ModalMotion> modal_motion(const ModalLoop& loop,
                                               const ModalMotion::Full& state) {
  validate(loop);
  return modal_motion(loop, plant_poles(loop.modes, loop.absorber), state);
}

}  // namespace holdfast
