#pragma once

#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "holdfast/contact/hysteresis.hpp"
#include "holdfast/control/gains.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/excitation/forcing.hpp"
#include "holdfast/excitation/harmonic_excitation.hpp"
#include "holdfast/excitation/harmonic_input.hpp"
#include "holdfast/math/linalg/complex_exponential.hpp"
#include "holdfast/motion/sampled_motion.hpp"
#include "holdfast/plant/modal_plant.hpp"
#include "holdfast/plant/plant_poles.hpp"
#include "holdfast/plant/port_readings.hpp"

namespace holdfast {

/// The sampled loop of a conductor by its modes, with its excitation and backlash.
struct ModalLoop {
  std::vector<PlaceMode<double>> modes;   ///< as the absorber's place sees them
  Absorber<double> absorber;              ///< with its clamp
  Sampling<double> sampling;              ///< τ and δ ≤ τ
  PdGains<double> gains;                  ///< P and D
  HarmonicExcitation<double> excitation;  ///< F_m and f, of the force at the absorber's place
  double backlash_width = 0.0;            ///< r₀ (m), ≥ 0
  ForceHold hold = ForceHold::sampled;    ///< how the harmonic force is taken over a sample
};

/// The motion of the sampled loop of a conductor by N of its modes, one sample at a time, in O(N).
///
/// Each natural motion e^{st} of conductor and absorber together goes by itself,
///
///     ξ_{j+1} = e^{sτ} ξ_j + γ₁ u_{j−1} + γ₀ u_j + g_c F_m cos ωt_j + g_s F_m sin ωt_j
///
/// and the conductor at the absorber and the absorber are sums over them: z = Σ r ξ with the
/// residues of `plant_poles`, ż = Σ s r ξ, z₂ = Σ θ r ξ, θ = (k₂ + c₂ s)/(m₂ s² + c₂ s + k₂). The
/// computer and the gap are those of `SampledMotion`. Work per sample: 20 multiply-adds a natural
/// motion, in whole vectors. Nothing is allocated.
class ModalMotion {
 public:
  static constexpr int states = 4;                 ///< what is read
  using State = Vector<double, 4>;                 ///< [z, ż, z₂, ż₂] (m, m/s, m, m/s)
  using Readings = PortReadings<TwoMass<double>>;  ///< how that is read
  using Full = Vector<double, Eigen::Dynamic>;     ///< [q₁, q̇₁, …, q_N, q̇_N, z₂, ż₂]

  /// @param loop   of which nothing is checked
  /// @param poles  all of `plant_poles` of its modes and absorber
  /// @param state  the initial one, of `modal_plant`
  ModalMotion(const ModalLoop& loop, const std::vector<PlantPole>& poles, const Full& state)
      : loop_(loop),
        law_(loop.backlash_width),
        phases_({Vector<double, 2>::Unit(0), Vector<double, 2>::Unit(1)}, loop.excitation,
                loop.sampling.period) {
    const detail::PoleFinder finder(loop.modes, loop.absorber);
    Full unit = Full::Zero(state.size());
    unit.head(state.size() - 2)(Eigen::seq(0, Eigen::last, 2)) = bent_conductor(loop.modes);
    std::size_t count = 0;
    for (std::size_t k = 0; k < poles.size(); ++k) {
      const std::complex<double> s = poles[k].s;
      const bool real = !(std::abs(s.imag()) > 1e-9 * std::abs(s));
      if (!real && s.imag() < 0.0) continue;  // its conjugate stands for it
      const Shape shape = shape_of(poles[k], finder.weak_of_pole(k));
      if (count % lanes == 0) blocks_.emplace_back();
      blocks_.back().fill(static_cast<Eigen::Index>(count++ % lanes), numbers_of(shape, real),
                          amplitude(shape, state), amplitude(shape, unit));
    }
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

  /// What a natural motion does over a sampling period, and what is read of it.
  struct Numbers {
    Complex decay, present, past, cosine, sine;  // e^{sτ}, γ₀, γ₁, g_c, g_s
    Complex z, v, z2, v2;
  };

  /// Some natural motions.
  struct Block {
    Part state, decay, present, past, cosine, sine;
    Part z, v, z2, v2;  // conjugates: Re(w ξ) = Re w̄ Re ξ + Im w̄ Im ξ
    Part bent;

    void fill(Eigen::Index k, const Numbers& of, const Complex& amplitude, const Complex& bend) {
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

  /// The shape ψ of a natural motion under a force f on the bare conductor.
  struct Shape {
    Complex s;
    Complex force;         // f
    Complex place;         // ψ at the absorber
    Complex read;          // what z takes of ξ
    std::size_t mode = 0;  // the one that it is nearly, where `weak`
    Complex own = 0.0;     // ψ of that mode, where `weak`
    bool weak = false;
  };

  /// f = 1, but of a weak mode, whose own part would be endless: there its own part is what f = 1
  /// gives times (s − s_n)/φ_n.
  Shape shape_of(const PlantPole& pole, const std::optional<detail::PoleFinder::Weak>& weak) const {
    Shape shape{pole.s, 1.0, receptance(loop_.modes, pole.s), 0.0};
    if (weak) {
      const PlaceMode<double>& mode = loop_.modes[weak->mode];
      shape.weak = true;
      shape.mode = weak->mode;
      shape.own = 1.0 / (mode.mass * weak->apart);
      shape.place = mode.shape * shape.own / weak->held;
      shape.force = -weak->pressed * shape.place;
      shape.read = mode.shape / weak->held;
    } else {
      shape.read = pole.residue / (shape.place * detail::transmitted_share(loop_.absorber, pole.s));
    }
    return shape;
  }

  Numbers numbers_of(const Shape& shape, bool real) const {
    const double period = loop_.sampling.period, late = loop_.sampling.processing_delay;
    const Complex s = shape.s, transmitted = detail::transmitted_share(loop_.absorber, s);
    const Complex driven = shape.place * transmitted, forced = shape.place;
    const Complex whole = std::exp(s * period);
    Numbers of;
    of.decay = whole;
    of.present = driven * exponential_integral(s, period - late);
    of.past = driven * std::exp(s * (period - late)) * exponential_integral(s, late);
    of.cosine = forced * exponential_integral(s, period);
    of.sine = 0.0;
    if (loop_.hold == ForceHold::exact) {
      const Complex i(0.0, 1.0), turn = i * loop_.excitation.angular_frequency();
      const Complex ahead =
          forced * std::exp(turn * period) * exponential_integral(s - turn, period);
      const Complex behind =
          forced * std::exp(-turn * period) * exponential_integral(s + turn, period);
      of.cosine = 0.5 * (ahead + behind);
      of.sine = 0.5 * i * (ahead - behind);
    }
    of.z = (real ? 1.0 : 2.0) * shape.read;  // one of a pair stands for both
    of.v = s * of.z;
    of.z2 = (1.0 - transmitted) * of.z;
    of.v2 = s * of.z2;
    return of;
  }

  /// ξ of a natural motion in a state, ψᵀ((sM + C) q + M q̇), M and C being those of the equations
  /// of motion; b enters by ψᵀb.
  Complex amplitude(const Shape& natural, const Full& state) const {
    const Absorber<double>& absorber = loop_.absorber;
    const Complex s = natural.s, place = natural.place;
    const Complex theta = 1.0 - detail::transmitted_share(absorber, s);
    Complex sum(0.0);
    double z = 0.0, v = 0.0;
    Eigen::Index q = 0;
    for (std::size_t n = 0; n < loop_.modes.size(); ++n, q += 2) {
      const PlaceMode<double>& mode = loop_.modes[n];
      const double damping = 2.0 * mode.damping_ratio * mode.angular_frequency;
      const bool own = natural.weak && n == natural.mode;
      const Complex shape =
          own ? natural.own : natural.force * mode.shape / (mode.mass * mode.divisor(s));
      z += mode.shape * state[q];
      v += mode.shape * state[q + 1];
      sum += shape * mode.mass * ((s + damping) * state[q] + state[q + 1]);
    }
    return sum + absorber.clamp_mass * place * (s * z + v) +
           absorber.damping * (theta - 1.0) * place * (state[q] - z) +
           absorber.mass * theta * place * (s * state[q] + state[q + 1]);
  }

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
  State seen_;
  double previous_force_ = 0.0, present_force_ = 0.0;
  std::int64_t index_ = 0;
};

/// The motion from a state of `modal_plant`, [q₁, q̇₁, …, z₂, ż₂].
/// @return nothing where `plant_poles` are not all found: `harmonically_forced_motion` of the plant
///         is then the way, at N² operations a sample
/// @throws InvalidParameter where the loop is not admissible, or the state is not finite or of
///         another size
inline std::optional<ModalMotion> modal_motion(const ModalLoop& loop,
                                               const ModalMotion::Full& state) {
  validate(loop.sampling);
  validate(loop.gains);
  validate(loop.excitation);
  validate_backlash_width(loop.backlash_width);
  const auto poles = plant_poles(loop.modes, loop.absorber);
  require_finite("initial state", state.sum(), "");
  const double size = static_cast<double>(2 * loop.modes.size() + 2);
  require_within("size of the initial state", static_cast<double>(state.size()), "", size, size);
  if (poles.empty()) return std::nullopt;
  return ModalMotion(loop, poles, state);
}

}  // namespace holdfast
