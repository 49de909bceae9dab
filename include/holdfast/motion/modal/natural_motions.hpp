#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <optional>
#include <vector>

#include "holdfast/contact/hysteresis.hpp"
#include "holdfast/control/gains.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/excitation/harmonic_excitation.hpp"
#include "holdfast/excitation/harmonic_input.hpp"
#include "holdfast/math/linalg/complex_exponential.hpp"
#include "holdfast/plant/modal_plant.hpp"
#include "holdfast/plant/plant_poles.hpp"

namespace holdfast {

/// The sampled loop of a conductor given by its modes, with its excitation and backlash.
struct ModalLoop {
  std::vector<PlaceMode<double>> modes;   ///< conductor's modes, with mode shapes at the absorber
  Absorber<double> absorber;              ///< absorber with its clamp
  Sampling<double> sampling;              ///< sampling period τ and processing delay δ ≤ τ (s)
  PdGains<double> gains;                  ///< gains P (N/m) and D (N s/m)
  HarmonicExcitation<double> excitation;  ///< amplitude F_m (N), frequency f (Hz), at the absorber
  double backlash_width = 0.0;            ///< width r₀ of the backlash (m), ≥ 0
  ForceHold hold = ForceHold::sampled;    ///< force held over each sampling period, or exact
};

/// Validates a loop. @throws InvalidParameter where it is not admissible
inline void validate(const ModalLoop& loop) {
  validate(loop.modes, loop.absorber);
  validate(loop.sampling);
  validate(loop.gains);
  validate(loop.excitation);
  validate_backlash_width(loop.backlash_width);
}

/// A natural motion e^{st} of conductor and absorber for a pole s of the plant. In one sampling
/// period τ, under the commands u and the excitation (amplitude F_m, angular frequency ω), its
/// complex amplitude ξ becomes
///
///     ξ_{j+1} = e^{sτ} ξ_j + γ₁ u_{j−1} + γ₀ u_j + g_c F_m cos ωt_j + g_s F_m sin ωt_j .
///
/// The conductor's displacement at the absorber is z = Re Σ w_z ξ over all natural motions; ż, z₂
/// and ż₂ are sums with other weights. One object represents both members of a conjugate pair.
struct NaturalMotion {
  std::complex<double> decay;    ///< factor e^{sτ} of one sampling period
  std::complex<double> present;  ///< γ₀, response per newton of the present command u_j
  std::complex<double> past;     ///< γ₁, response per newton of the previous u_{j−1}
  std::complex<double> cosine;   ///< g_c, response per newton of F_m cos ωt_j
  std::complex<double> sine;     ///< g_s, response per newton of F_m sin ωt_j
  std::complex<double> z;        ///< weight w_z of ξ in the conductor's displacement z (m)
  std::complex<double> v;        ///< weight of ξ in the conductor's velocity ż (m/s)
  std::complex<double> z2;       ///< weight of ξ in the absorber's displacement z₂ (m)
  std::complex<double> v2;       ///< weight of ξ in the absorber's velocity ż₂ (m/s)
};

/// The natural motions of conductor and absorber, whose superposition is a ModalLoop's motion.
class NaturalMotions {
 public:
  /// The state of `modal_plant`: modal coordinates and absorber, [q₁, q̇₁, …, q_N, q̇_N, z₂, ż₂].
  using Full = Vector<double, Eigen::Dynamic>;

  /// @param loop   an admissible loop (unchecked)
  /// @param poles  all `plant_poles` of the loop's modes and absorber
  NaturalMotions(const ModalLoop& loop, const std::vector<PlantPole>& poles) : loop_(loop) {
    const detail::PoleFinder finder(loop.modes, loop.absorber);
    for (const bool real : {false, true}) {
      for (std::size_t k = 0; k < poles.size(); ++k) {
        const std::complex<double> s = poles[k].s;
        const bool is_real = !(std::abs(s.imag()) > 1e-9 * std::abs(s));
        // The pole with Im s > 0 represents its pair.
        if (is_real != real || (!real && s.imag() < 0.0)) continue;
        shapes_.push_back(shape_of(poles[k], finder.weak_of_pole(k)));
        motions_.push_back(numbers_of(shapes_.back(), real, loop.sampling));
      }
      if (!real) pairs_ = motions_.size();
    }
  }

  /// The number of natural motions; a conjugate pair counts as one.
  std::size_t size() const { return motions_.size(); }
  /// The number of natural motions that represent a conjugate pair; all others are real.
  std::size_t pairs() const { return pairs_; }
  /// The k-th natural motion, 0 ≤ k < size(); the conjugate pairs come first.
  const NaturalMotion& operator[](std::size_t k) const { return motions_[k]; }

  /// The k-th natural motion with factors for a step of `length` (s) from a sample, 0 ≤ length ≤ τ.
  NaturalMotion over(std::size_t k, double length) const {
    return numbers_of(shapes_[k], k >= pairs_,
                      {length, std::min(loop_.sampling.processing_delay, length)});
  }

  /// The observed state [z, ż, z₂, ż₂] (m, m/s, m, m/s) for amplitudes ξ of all natural motions.
  Vector<double, 4> seen(const Eigen::VectorXcd& amplitudes) const {
    Vector<double, 4> sum = Vector<double, 4>::Zero();
    for (std::size_t k = 0; k < size(); ++k) {
      const NaturalMotion& of = motions_[k];
      const Complex amplitude = amplitudes[static_cast<Eigen::Index>(k)];
      sum += Vector<double, 4>((of.z * amplitude).real(), (of.v * amplitude).real(),
                               (of.z2 * amplitude).real(), (of.v2 * amplitude).real());
    }
    return sum;
  }

  /// The state of `modal_plant` for given amplitudes ξ of all natural motions.
  Full state_of(const Eigen::VectorXcd& amplitudes) const {
    Full state = Full::Zero(2 * static_cast<Eigen::Index>(loop_.modes.size()) + 2);
    for (std::size_t k = 0; k < size(); ++k) {
      const Shape& natural = shapes_[k];
      const Complex amplitude = amplitudes[static_cast<Eigen::Index>(k)];
      const Complex moving = (k < pairs_ ? 2.0 : 1.0) * natural.scale * amplitude;
      for (std::size_t n = 0; n < loop_.modes.size(); ++n)
        add(state, 2 * static_cast<Eigen::Index>(n), natural.s, moving * shape_in_mode(natural, n));
      add(state, state.size() - 2, natural.s, motions_[k].z2 * amplitude);
    }
    return state;
  }

  /// The amplitude ξ = ψᵀ((sM + C) q + M q̇) of the k-th natural motion in a given state. s is the
  /// pole, ψ the shape of this motion; q are the coordinates with mass and damping matrices M, C.
  std::complex<double> amplitude(std::size_t k, const Full& state) const {
    const Shape& natural = shapes_[k];
    const Absorber<double>& absorber = loop_.absorber;
    const Complex s = natural.s, place = natural.place;
    const Complex theta = 1.0 - detail::transmitted_share(absorber, s);
    Complex sum(0.0);
    double z = 0.0, v = 0.0;
    Eigen::Index q = 0;
    for (std::size_t n = 0; n < loop_.modes.size(); ++n, q += 2) {
      const PlaceMode<double>& mode = loop_.modes[n];
      const double damping = 2.0 * mode.damping_ratio * mode.angular_frequency;
      z += mode.shape * state[q];
      v += mode.shape * state[q + 1];
      sum += shape_in_mode(natural, n) * mode.mass * ((s + damping) * state[q] + state[q + 1]);
    }
    return sum + absorber.clamp_mass * place * (s * z + v) +
           absorber.damping * (theta - 1.0) * place * (state[q] - z) +
           absorber.mass * theta * place * (s * state[q] + state[q + 1]);
  }

 private:
  using Complex = std::complex<double>;

  /// The shape ψ of a natural motion: response of the bare conductor to a force f at the absorber.
  struct Shape {
    Complex s;
    Complex force;         // f
    Complex place;         // ψ at the absorber
    Complex read;          // factor of ξ in z
    Complex scale;         // factor of ψ ξ in the state
    std::size_t mode = 0;  // the mode nearly equal to ψ, where `weak`
    Complex own = 0.0;     // ψ of that mode, where `weak`
    bool weak = false;
  };

  /// The shape ψ for f = 1. Where a mode n is weakly coupled to the absorber (`weak`), its
  /// component in ψ would be almost unbounded. ψ is then multiplied by (s − s_n)/φ_n, with the bare
  /// mode's eigenvalue s_n and its shape φ_n at the absorber.
  Shape shape_of(const PlantPole& pole, const std::optional<detail::PoleFinder::Weak>& weak) const {
    Shape shape{pole.s, 1.0, receptance(loop_.modes, pole.s), 0.0, 0.0};
    if (weak) {
      const PlaceMode<double>& mode = loop_.modes[weak->mode];
      shape.weak = true;
      shape.mode = weak->mode;
      shape.own = 1.0 / (mode.mass * weak->apart);
      shape.place = mode.shape * shape.own / weak->divisor;
      shape.force = -weak->stiffness * shape.place;
      shape.scale = 1.0 / shape.own;
      shape.read = mode.shape / weak->divisor;
    } else {
      shape.read = pole.residue / (shape.place * detail::transmitted_share(loop_.absorber, pole.s));
      shape.scale = shape.read / shape.place;
    }
    return shape;
  }

  /// The component of the natural motion's shape ψ in mode n, counted from 0.
  Complex shape_in_mode(const Shape& natural, std::size_t n) const {
    const PlaceMode<double>& mode = loop_.modes[n];
    if (natural.weak && n == natural.mode) return natural.own;
    return natural.force * mode.shape / mode.mass * mode.response(natural.s);
  }

  static void add(Full& state, Eigen::Index at, const Complex& s, const Complex& part) {
    state[at] += part.real();
    state[at + 1] += (s * part).real();
  }

  NaturalMotion numbers_of(const Shape& shape, bool real, const Sampling<double>& sampling) const {
    const double period = sampling.period, late = sampling.processing_delay;
    const Complex s = shape.s, transmitted = detail::transmitted_share(loop_.absorber, s);
    const Complex driven = shape.place * transmitted, forced = shape.place;
    const Complex whole = std::exp(s * period);
    NaturalMotion of;
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

  ModalLoop loop_;
  std::vector<Shape> shapes_;
  std::vector<NaturalMotion> motions_;
  std::size_t pairs_ = 0;
};

}  // namespace holdfast
