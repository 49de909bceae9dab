#pragma once

#include <cmath>
#include <complex>
#include <cstddef>
#include <optional>
#include <vector>

#include "holdfast/math/roots/root_from_pole.hpp"
#include "holdfast/plant/modal_plant.hpp"

namespace holdfast {

/// A natural motion e^{st} of a plant and its part in the transfer function from the drive to the
/// conductor: G_z = Σ r/(s − s_k), G_v = Σ s_k r/(s − s_k).
struct PlantPole {
  std::complex<double> s;        ///< 1/s
  std::complex<double> residue;  ///< r, m/(N s)
};

namespace detail {

/// dH/ds of `receptance`.
inline std::complex<double> receptance_slope(const std::vector<PlaceMode<double>>& modes,
                                             const std::complex<double>& s) {
  std::complex<double> sum(0);
  for (const PlaceMode<double>& mode : modes) {
    const double damping = 2.0 * mode.damping_ratio * mode.angular_frequency;
    const std::complex<double> part = mode.divisor(s);
    sum -= mode.shape * mode.shape * (2.0 * s + damping) / (mode.mass * part * part);
  }
  return sum;
}

/// dK/ds of `passive_stiffness`, with N = m₂ s² (k₂ + c₂ s), Q = m₂ s² + c₂ s + k₂.
inline std::complex<double> passive_slope(const Absorber<double>& absorber,
                                          const std::complex<double>& s) {
  const double m = absorber.mass, k = absorber.stiffness, c = absorber.damping;
  const std::complex<double> n = m * s * s * (k + c * s), q = s * (m * s + c) + k;
  const std::complex<double> dn = m * s * (2.0 * k + 3.0 * c * s), dq = 2.0 * m * s + c;
  return 2.0 * absorber.clamp_mass * s + (dn * q - n * dq) / (q * q);
}

/// The poles of a conductor with its absorber, one after the other.
class PoleFinder {
 public:
  using Complex = std::complex<double>;

  PoleFinder(const std::vector<PlaceMode<double>>& modes, const Absorber<double>& absorber)
      : modes_(modes), absorber_(absorber) {}

  /// A mode that the absorber hardly moves, as one with a node there: what is needed of it beside
  /// what the others do.
  struct Weak {
    Complex own;      ///< ρ of H = ρ/(s − s_n) + b
    Complex pressed;  ///< K
    Complex held;     ///< 1 + bK
  };

  /// The n-th mode, if it is weak: |ρK/(1 + bK)| < 10⁻⁸ |s_n|.
  std::optional<Weak> weak(std::size_t n) const {
    const PlaceMode<double>& mode = modes_[n];
    const Complex s = bare(mode);
    Weak found{mode.shape * mode.shape / (mode.mass * Complex(0.0, 2.0 * s.imag())),
               passive_stiffness(absorber_, s), 1.0};
    // A product that is not small has no need of b, unless b is large.
    if (!(std::abs(found.own * found.pressed) < 1e-6 * std::abs(s))) return std::nullopt;
    Complex others = -found.own / Complex(0.0, 2.0 * s.imag());
    for (const PlaceMode<double>& other : modes_)
      if (&other != &mode) others += receptance<double>({other}, s);
    found.held += others * found.pressed;
    if (!(std::abs(found.own * found.pressed) < 1e-8 * std::abs(found.held) * std::abs(s)))
      return std::nullopt;
    return found;
  }

  /// What the n-th mode becomes; a weak one by its own residue, s = s_n − ρK/(1 + bK).
  PlantPole of_mode(std::size_t n) const {
    const Complex s = bare(modes_[n]);
    const std::optional<Weak> mode = weak(n);
    if (!mode) return from(s);
    return {s - mode->own * mode->pressed / mode->held,
            transmitted_share(absorber_, s) * mode->own / (mode->held * mode->held)};
  }

  /// s of the bare mode, Im s > 0.
  static Complex bare(const PlaceMode<double>& mode) {
    const double omega = mode.angular_frequency, zeta = mode.damping_ratio;
    return {-zeta * omega, omega * std::sqrt(1.0 - zeta * zeta)};
  }

  /// The pole near s, by Newton on 1/H + K.
  PlantPole near(Complex s) const {
    Complex slope;
    for (int turn = 0; turn < 20; ++turn) {
      const Complex bare = receptance(modes_, s);
      slope = passive_slope(absorber_, s) - receptance_slope(modes_, s) / (bare * bare);
      s -= (1.0 / bare + passive_stiffness(absorber_, s)) / slope;
    }
    return {s, transmitted_share(absorber_, s) / slope};
  }

  /// What begins at s, where the conductor alone or the absorber on a fixed one moves by itself.
  PlantPole from(const Complex& begin) const {
    const Complex s = root_from_pole(
        [&](const Complex& at) {
          return -receptance(modes_, at) * passive_stiffness(absorber_, at);
        },
        begin);
    return near(s);
  }

 private:
  const std::vector<PlaceMode<double>>& modes_;
  const Absorber<double>& absorber_;
};

/// Whether these are all poles: as |s| → ∞ G_z goes as a/s², a the acceleration per newton of the
/// drive, so that Σ r = 0 and Σ s r = a.
inline bool are_all_poles(const std::vector<PlantPole>& poles, double acceleration) {
  std::complex<double> sum(0), moment(0);
  double size = 0.0, moment_size = 0.0;
  for (const PlantPole& pole : poles) {
    sum += pole.residue;
    moment += pole.s * pole.residue;
    size += std::abs(pole.residue);
    moment_size += std::abs(pole.s * pole.residue);
  }
  return std::abs(sum) < 1e-7 * size && std::abs(moment - acceleration) < 1e-8 * moment_size;
}

/// s of the one pole that is missing, by the same sums.
inline std::complex<double> missing_pole(const std::vector<PlantPole>& poles, double acceleration) {
  std::complex<double> residue(0), moment(acceleration);
  for (const PlantPole& pole : poles) {
    residue -= pole.residue;
    moment -= pole.s * pole.residue;
  }
  return moment / residue;
}

}  // namespace detail

/// The poles of a conductor by its modes with the absorber, all 2N + 2 of them, by following each
/// from where it is without the other (`root_from_pole`): first the one of each mode with Im s > 0,
/// in order, then their conjugates and the absorber's two. N² operations where the eigenvalues of
/// `modal_plant` take N³; that all were found is tested by two sums over them.
/// @return nothing where they were not all found, as where a damper is critical or two coincide
/// @throws InvalidParameter where modes or absorber are not admissible, or a mode has ζ ≥ 1
inline std::vector<PlantPole> plant_poles(const std::vector<PlaceMode<double>>& modes,
                                          const Absorber<double>& absorber) {
  using Complex = std::complex<double>;
  validate(modes, absorber);
  const detail::PoleFinder finder(modes, absorber);
  // Of what begins as a pair, the second: the conjugate, or where the pair has met on the real axis
  // what the conjugate has become.
  const auto partner = [&](const PlantPole& first, const Complex& begin) {
    const bool met = !(std::abs(first.s.imag()) > 1e-9 * std::abs(first.s));
    return met ? finder.from(begin) : PlantPole{std::conj(first.s), std::conj(first.residue)};
  };
  std::vector<PlantPole> poles;
  poles.reserve(2 * modes.size() + 2);
  double mobility = 0.0;
  for (std::size_t n = 0; n < modes.size(); ++n) {
    require_within("damping ratio of a mode", modes[n].damping_ratio, "", 0.0, 1.0 - 1e-9);
    mobility += modes[n].shape * modes[n].shape / modes[n].mass;
    poles.push_back(finder.of_mode(n));
  }
  for (std::size_t n = 0; n < modes.size(); ++n)
    poles.push_back(partner(poles[n], std::conj(detail::PoleFinder::bare(modes[n]))));
  const double decay = absorber.damping / (2.0 * absorber.mass);
  const Complex turn = std::sqrt(Complex(decay * decay - absorber.stiffness / absorber.mass));
  poles.push_back(finder.from(-decay + turn));
  poles.push_back(turn.imag() != 0.0 ? partner(poles.back(), -decay - turn)
                                     : finder.from(-decay - turn));
  const double acceleration = mobility / (1.0 + absorber.clamp_mass * mobility);
  if (!detail::are_all_poles(poles, acceleration)) {
    // Two of a real pair may have come to one of it: then the sums tell where the other is.
    poles.pop_back();
    poles.push_back(finder.near(detail::missing_pole(poles, acceleration)));
  }
  if (!detail::are_all_poles(poles, acceleration)) return {};
  return poles;
}

}  // namespace holdfast
