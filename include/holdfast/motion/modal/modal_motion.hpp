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
#include "holdfast/motion/modal/natural_motions.hpp"
#include "holdfast/motion/sampled_motion.hpp"
#include "holdfast/plant/plant_poles.hpp"
#include "holdfast/plant/port_readings.hpp"

namespace holdfast {

/// The motion of the sampled loop of a conductor by N of its modes, one sample at a time, in O(N).
///
/// Each natural motion e^{st} of conductor and absorber together goes by itself (NaturalMotion),
/// and the conductor at the absorber and the absorber are sums over them: z = Σ r ξ with the
/// residues of `plant_poles`, ż = Σ s r ξ, z₂ = Σ θ r ξ, θ = (k₂ + c₂ s)/(m₂ s² + c₂ s + k₂). The
/// computer and the gap are those of `SampledMotion`. Work per sample: 20 multiply-adds a natural
/// motion, in whole vectors. Nothing is allocated.
class ModalMotion {
 public:
  static constexpr int states = 4;                 ///< what is read
  using State = Vector<double, 4>;                 ///< [z, ż, z₂, ż₂] (m, m/s, m, m/s)
  using Readings = PortReadings<TwoMass<double>>;  ///< how that is read
  using Full = NaturalMotions::Full;               ///< [q₁, q̇₁, …, q_N, q̇_N, z₂, ż₂]

  using Memory = MotionMemory<double, BacklashMemory<double>>;  ///< before a sample

  /// @param loop   of which nothing is checked
  /// @param poles  all of `plant_poles` of its modes and absorber
  /// @param state  the initial one, of `modal_plant`
  ModalMotion(const ModalLoop& loop, const std::vector<PlantPole>& poles, const Full& state)
      : loop_(loop),
        law_(loop.backlash_width),
        phases_({Vector<double, 2>::Unit(0), Vector<double, 2>::Unit(1)}, loop.excitation,
                loop.sampling.period) {
    const NaturalMotions natural(loop, poles);
    Full unit = Full::Zero(state.size());
    unit.head(state.size() - 2)(Eigen::seq(0, Eigen::last, 2)) = bent_conductor(loop.modes);
    for (std::size_t k = 0; k < natural.size(); ++k) {
      if (k % lanes == 0) blocks_.emplace_back();
      blocks_.back().fill(static_cast<Eigen::Index>(k % lanes), natural[k],
                          natural.amplitude(k, state), natural.amplitude(k, unit));
    }
    motions_ = natural.size();
    read();
  }

  /// Takes sample j: whether the force is transmitted, and how large it is. Once per sample.
  MotionSample<double> sense() {
    const bool engaged = law_.step(seen_[2] - seen_[0], seen_[3] - seen_[1]);
    present_force_ =
        engaged ? loop_.gains.proportional * seen_[0] + loop_.gains.differential * seen_[1] : 0.0;
    return {index_, time(), seen_, present_force_, engaged};
  }

  /// Moves from t_j to t_{j+1} under the force that the last `sense()` decided.
  void advance() {
    const double u = present_force_, before = previous_force_;
    const Vector<double, 2> force = phases_.next();
    Seen seen;
    for (Block& b : blocks_) {
      const Lanes re = b.decay.re * b.state.re - b.decay.im * b.state.im + b.present.re * u +
                       b.past.re * before + b.cosine.re * force[0] + b.sine.re * force[1];
      const Lanes im = b.decay.re * b.state.im + b.decay.im * b.state.re + b.present.im * u +
                       b.past.im * before + b.cosine.im * force[0] + b.sine.im * force[1];
      b.state = {re, im};
      seen.add(b);
    }
    seen_ = seen.sums();
    previous_force_ = u;
    ++index_;
  }

  /// Bends the conductor by that much (m) at the absorber, as a force there would; call before
  /// `sense()`.
  void displace_conductor(double by) {
    for (Block& b : blocks_) {
      b.state.re += by * b.bent.re;
      b.state.im += by * b.bent.im;
    }
    read();
  }

  /// j, the sample that `sense()` will take or has taken.
  std::int64_t index() const { return index_; }
  /// t_j (s).
  double time() const { return static_cast<double>(index_) * loop_.sampling.period; }
  /// [z, ż, z₂, ż₂] at t_j.
  const State& state() const { return seen_; }
  /// How that is read.
  const Readings& readings() const { return readings_; }
  /// All that the coming samples depend on, but for what of the natural motions is not read.
  Memory memory() const { return {seen_, previous_force_, law_.memory()}; }
  /// ξ of every natural motion, in the order of NaturalMotions.
  Eigen::VectorXcd amplitudes() const {
    Eigen::VectorXcd all(static_cast<Eigen::Index>(motions_));
    for (std::size_t k = 0; k < motions_; ++k) {
      const Part& state = blocks_[k / lanes].state;
      const auto lane = static_cast<Eigen::Index>(k % lanes);
      all[static_cast<Eigen::Index>(k)] = {state.re[lane], state.im[lane]};
    }
    return all;
  }

 private:
  // Natural motions that one turn of the loop takes care of: a vector of the processor's.
  static constexpr std::size_t lanes = EIGEN_MAX_STATIC_ALIGN_BYTES > 16
                                           ? EIGEN_MAX_STATIC_ALIGN_BYTES / sizeof(double)
                                           : 2;
  using Lanes = Eigen::Array<double, static_cast<int>(lanes), 1>;
  using Complex = std::complex<double>;

  /// A complex number of each of some natural motions.
  struct Part {
    Lanes re = Lanes::Zero(), im = Lanes::Zero();
    void set(Eigen::Index k, const Complex& value) {
      re[k] = value.real();
      im[k] = value.imag();
    }
  };

  /// Some natural motions.
  struct Block {
    Part state, decay, present, past, cosine, sine;
    Part z, v, z2, v2;  // conjugates: Re(w ξ) = Re w̄ Re ξ + Im w̄ Im ξ
    Part bent;

    void fill(Eigen::Index k, const NaturalMotion& of, const Complex& amplitude,
              const Complex& bend) {
      state.set(k, amplitude);
      bent.set(k, bend);
      decay.set(k, of.decay);
      present.set(k, of.present);
      past.set(k, of.past);
      cosine.set(k, of.cosine);
      sine.set(k, of.sine);
      z.set(k, std::conj(of.z));
      v.set(k, std::conj(of.v));
      z2.set(k, std::conj(of.z2));
      v2.set(k, std::conj(of.v2));
    }
  };

  /// [z, ż, z₂, ż₂] of the blocks that were added, lane by lane.
  struct Seen {
    Lanes z = Lanes::Zero(), v = z, z2 = z, v2 = z;

    void add(const Block& of) {
      const Lanes &re = of.state.re, &im = of.state.im;
      z += of.z.re * re + of.z.im * im;
      v += of.v.re * re + of.v.im * im;
      z2 += of.z2.re * re + of.z2.im * im;
      v2 += of.v2.re * re + of.v2.im * im;
    }
    State sums() const { return {z.sum(), v.sum(), z2.sum(), v2.sum()}; }
  };

  void read() {
    Seen seen;
    for (const Block& block : blocks_) seen.add(block);
    seen_ = seen.sums();
  }

  ModalLoop loop_;
  Readings readings_;
  Backlash<double> law_;
  HarmonicForcing<double, 2> phases_;
  std::vector<Block> blocks_;  // of natural motions, the last filled up with nothing
  std::size_t motions_ = 0;
  State seen_;
  double previous_force_ = 0.0, present_force_ = 0.0;
  std::int64_t index_ = 0;
};

/// The motion from a state of `modal_plant`, [q₁, q̇₁, …, z₂, ż₂].
/// @param loop   with its excitation and backlash
/// @param poles  `plant_poles` of the loop's modes and absorber
/// @param state  the initial one
/// @return nothing where these are not all found: `harmonically_forced_motion` of the plant is then
///         the way, at N² operations a sample
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

/// The same, whose poles are found here.
/// @param loop   with its excitation and backlash
/// @param state  the initial one
/// @return as above
/// @throws InvalidParameter as above
inline std::optional<ModalMotion> modal_motion(const ModalLoop& loop,
                                               const ModalMotion::Full& state) {
  validate(loop);
  return modal_motion(loop, plant_poles(loop.modes, loop.absorber), state);
}

}  // namespace holdfast
