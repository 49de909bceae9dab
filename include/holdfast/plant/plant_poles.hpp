#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "holdfast/math/roots/root_from_pole.hpp"
#include "holdfast/plant/modal_plant.hpp"

namespace holdfast {

/// A pole s_k of a plant with its residue r_k in the transfer functions from the drive's force to
/// the conductor's displacement and velocity, G_z = Σ r_k/(s − s_k), G_v = Σ s_k r_k/(s − s_k).
struct PlantPole {
  std::complex<double> s;        ///< pole s_k (1/s)
  std::complex<double> residue;  ///< residue r_k (m/(N s))
};

namespace detail {

/// The derivative dH/ds of `receptance`.
inline std::complex<double> receptance_slope(const std::vector<PlaceMode<double>>& modes,
                                             const std::complex<double>& s) {
  std::complex<double> sum(0);
  for (const PlaceMode<double>& mode : modes) {
    const double damping = 2.0 * mode.damping_ratio * mode.angular_frequency;
    const std::complex<double> response = mode.response(s);
    sum -= mode.shape * mode.shape / mode.mass * (2.0 * s + damping) * (response * response);
  }
  return sum;
}

/// The derivative dK/ds of `passive_stiffness`, K = M_c s² + m₂ s² (k₂ + c₂ s)/(m₂ s² + c₂ s + k₂).
inline std::complex<double> passive_slope(const Absorber<double>& absorber,
                                          const std::complex<double>& s) {
  const double m = absorber.mass, k = absorber.stiffness, c = absorber.damping;
  const std::complex<double> n = m * s * s * (k + c * s), q = s * (m * s + c) + k;
  const std::complex<double> dn = m * s * (2.0 * k + 3.0 * c * s), dq = 2.0 * m * s + c;
  return 2.0 * absorber.clamp_mass * s + (dn * q - n * dq) / (q * q);
}

/// The search for the poles of a conductor with its absorber, one after the other.
class PoleFinder {
 public:
  using Complex = std::complex<double>;

  PoleFinder(const std::vector<PlaceMode<double>>& modes, const Absorber<double>& absorber)
      : modes_(modes), absorber_(absorber) {}

  /// One eigenvalue s of a mode of the bare conductor, and the same mode's other eigenvalue.
  struct BarePair {
    Complex s, partner;
    /// The other eigenvalue, with this one as its partner.
    BarePair other() const { return {partner, s}; }
  };

  /// The data of a weakly coupled mode, one that the absorber hardly changes, for example a mode
  /// with a node there. Near the mode's eigenvalue s_n the receptance is H = ρ/(s − s_n) + b.
  struct Weak {
    std::size_t mode;   ///< number n of the mode
    Complex apart;      ///< s_n minus the mode's other eigenvalue
    Complex residue;    ///< residue ρ of H
    Complex stiffness;  ///< K, the passive stiffness at s_n
    Complex divisor;    ///< divisor 1 + bK of the pole's shift
  };

  /// The n-th mode, if it is weakly coupled: |ρK/(1 + bK)| < 10⁻⁸ |s_n|.
  /// @param begin  one of the two eigenvalues of `bare`
  std::optional<Weak> weak(std::size_t n, const BarePair& begin) const {
    const PlaceMode<double>& mode = modes_[n];
    const Complex s = begin.s, apart = s - begin.partner;
    Weak found{n, apart, mode.shape * mode.shape / (mode.mass * apart),
               passive_stiffness(absorber_, s), 1.0};
    // A product that is not small decides without b, unless b is large.
    if (!(std::abs(found.residue * found.stiffness) < 1e-6 * std::abs(s))) return std::nullopt;
    Complex others = -found.residue / apart;
    for (const PlaceMode<double>& other : modes_)
      if (&other != &mode) others += other.shape * other.shape / other.mass * other.response(s);
    found.divisor += others * found.stiffness;
    if (!(std::abs(found.residue * found.stiffness) < 1e-8 * std::abs(found.divisor) * std::abs(s)))
      return std::nullopt;
    return found;
  }

  /// The mode from which the k-th of `plant_poles` is continued, if it is weakly coupled.
  std::optional<Weak> weak_of_pole(std::size_t k) const {
    if (k < modes_.size()) return weak(k, bare(modes_[k]));
    const std::size_t n = k - modes_.size();
    if (n >= modes_.size() || modes_[n].damping_ratio < 1.0) return std::nullopt;
    return weak(n, bare(modes_[n]).other());
  }

  /// Whether the k-th of `plant_poles` or its conjugate is continued from a weakly coupled mode.
  bool stays(std::size_t k) const {
    const std::size_t n = k < modes_.size() ? k : k - modes_.size();
    if (n >= modes_.size()) return false;
    return weak_of_pole(modes_[n].damping_ratio < 1.0 ? n : k).has_value();
  }

  /// The pole that is continued from one eigenvalue s_n of the n-th mode; for a weakly coupled mode
  /// to first order, s = s_n − ρK/(1 + bK).
  /// @param begin  one of the two eigenvalues of `bare`
  PlantPole of_mode(std::size_t n, const BarePair& begin) const {
    const Complex s = begin.s;
    const std::optional<Weak> mode = weak(n, begin);
    if (!mode) return from(s);
    return {s - mode->residue * mode->stiffness / mode->divisor,
            transmitted_share(absorber_, s) * mode->residue / (mode->divisor * mode->divisor)};
  }

  /// The eigenvalues of a bare conductor's mode: first the one with Im s > 0, or the slower real.
  static BarePair bare(const PlaceMode<double>& mode) {
    const double omega = mode.angular_frequency, zeta = mode.damping_ratio;
    const double apart = std::sqrt(std::abs(1.0 - zeta * zeta));
    if (zeta < 1.0) return {{-zeta * omega, apart * omega}, {-zeta * omega, -apart * omega}};
    return {-omega / (zeta + apart), -omega * (zeta + apart)};
  }

  /// The pole near s, by Newton's method on 1/H + K.
  PlantPole near(Complex s) const {
    Complex slope;
    bool settled = false;
    for (int turn = 0; turn < 20 && !settled; ++turn) {
      const Complex bare = receptance(modes_, s);
      slope = passive_slope(absorber_, s) - receptance_slope(modes_, s) / (bare * bare);
      const Complex step = (1.0 / bare + passive_stiffness(absorber_, s)) / slope;
      s -= step;
      // Near a nearly weak mode a step is small before the slope is accurate.
      settled = turn >= 2 && std::abs(step) <= 1e-15 * std::abs(s);
    }
    if (std::abs(s.imag()) < 1e-15 * std::abs(s)) s.imag(0.0);  // a real one, but for rounding
    return {s, transmitted_share(absorber_, s) / slope};
  }

  /// The quotient p′/p of the polynomial with the poles as roots, p = Π (s − b_k) (1 + HK), b_k
  /// being the eigenvalues of the bare modes and of the absorber on a fixed conductor.
  Complex logarithmic_derivative(const std::vector<Complex>& bare_motions, const Complex& s) const {
    const Complex h = receptance(modes_, s), k = passive_stiffness(absorber_, s);
    Complex sum =
        (receptance_slope(modes_, s) * k + h * passive_slope(absorber_, s)) / (1.0 + h * k);
    for (const Complex& b : bare_motions) sum += 1.0 / (s - b);
    return sum;
  }

  /// The pole continued from a pole of the bare conductor or of the absorber on a fixed conductor.
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

/// Whether the poles are complete. As |s| → ∞, G_z ~ a/s² with the acceleration a per newton of the
/// drive, so that Σ r = 0 and Σ s r = a over all poles.
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

/// Separates poles that coincide or were not found: a pole not distinct from an earlier pole is
/// sought again near its starting value. Then all poles are improved together, each by Newton's
/// step for the polynomial divided by the other roots (Ehrlich 1967, Aberth 1973). Poles of weakly
/// coupled modes are not changed.
/// @param begins  starting value of each pole
inline void separate(std::vector<PlantPole>& poles, const std::vector<std::complex<double>>& begins,
                     const PoleFinder& finder) {
  using Complex = std::complex<double>;
  std::vector<std::size_t> moving;
  moving.reserve(poles.size());
  for (std::size_t k = 0; k < poles.size(); ++k) {
    if (finder.stays(k)) continue;
    moving.push_back(k);
    bool apart = std::isfinite(std::abs(poles[k].s));
    for (std::size_t j = 0; j < k; ++j)
      apart = apart && std::abs(poles[k].s - poles[j].s) > 1e-6 * std::abs(poles[k].s);
    if (!apart) poles[k].s = 1.001 * begins[k];
  }
  constexpr int most_sweeps = 60;
  double largest = 1.0;
  for (int sweep = 0; sweep < most_sweeps && largest > 1e-10; ++sweep) {
    largest = 0.0;
    for (const std::size_t k : moving) {
      Complex& s = poles[k].s;
      Complex slope = finder.logarithmic_derivative(begins, s);
      for (std::size_t j = 0; j < poles.size(); ++j)
        if (j != k) slope -= 1.0 / (s - poles[j].s);
      const double share = 1.0 / (std::abs(slope) * std::abs(s));
      if (!std::isfinite(share)) continue;
      s -= std::min(1.0, 0.3 / share) / slope;
      largest = std::max(largest, std::min(share, 0.3));
    }
  }
  for (const std::size_t k : moving) poles[k] = finder.near(poles[k].s);
  const std::size_t modes = poles.size() / 2 - 1;
  for (std::size_t n = 0; n < modes; ++n)
    if (poles[n].s.imag() < 0.0 && poles[n + modes].s.imag() > 0.0)
      std::swap(poles[n], poles[n + modes]);
}

}  // namespace detail

/// All 2N + 2 poles of a conductor, given by N modes, with the absorber. Each pole is traced from
/// its value without coupling of conductor and absorber (`root_from_pole`). The first N poles
/// belong to the modes in turn: the pole with Im s > 0, or the slower pole of an overdamped mode.
/// The modes' other poles and the absorber's two follow. Where two traces end at one pole, all
/// poles are refined together, and their assignment to modes is arbitrary. Two sums over the poles
/// test that none is missing. Work: order N²; the eigenvalues of `modal_plant` take order N³.
/// @return no poles where not all were found, for example with critical damping or equal poles
/// @throws InvalidParameter where modes or absorber are not admissible
inline std::vector<PlantPole> plant_poles(const std::vector<PlaceMode<double>>& modes,
                                          const Absorber<double>& absorber) {
  using Complex = std::complex<double>;
  validate(modes, absorber);
  const detail::PoleFinder finder(modes, absorber);
  // A pair's second pole: the conjugate or, if the first became real, that continued from `begin`.
  const auto partner = [&](const PlantPole& first, const Complex& begin) {
    const bool met = !(std::abs(first.s.imag()) > 1e-9 * std::abs(first.s));
    return met ? finder.from(begin) : PlantPole{std::conj(first.s), std::conj(first.residue)};
  };
  std::vector<PlantPole> poles(2 * modes.size());
  std::vector<Complex> begins(poles.size());
  double mobility = 0.0;
  for (std::size_t n = 0, other = modes.size(); n < modes.size(); ++n, ++other) {
    mobility += modes[n].shape * modes[n].shape / modes[n].mass;
    const auto begin = detail::PoleFinder::bare(modes[n]);
    begins[n] = begin.s;
    begins[other] = begin.partner;
    poles[n] = finder.of_mode(n, begin);
    poles[other] = modes[n].damping_ratio < 1.0 ? partner(poles[n], begin.partner)
                                                : finder.of_mode(n, begin.other());
  }
  const double decay = absorber.damping / (2.0 * absorber.mass);
  const Complex turn = std::sqrt(Complex(decay * decay - absorber.stiffness / absorber.mass));
  begins.push_back(-decay + turn);
  begins.push_back(-decay - turn);
  poles.push_back(finder.from(-decay + turn));
  poles.push_back(turn.imag() != 0.0 ? partner(poles.back(), -decay - turn)
                                     : finder.from(-decay - turn));
  const double acceleration = mobility / (1.0 + absorber.clamp_mass * mobility);
  if (detail::are_all_poles(poles, acceleration)) return poles;
  detail::separate(poles, begins, finder);
  if (!detail::are_all_poles(poles, acceleration)) return {};
  return poles;
}

/// The longest sampling period (s) that resolves all poles: π / max |s|; infinite without poles.
inline double nyquist_period(const std::vector<PlantPole>& poles) {
  double fastest = 0.0;
  for (const PlantPole& pole : poles) fastest = std::max(fastest, std::abs(pole.s));
  return pi<double> / fastest;
}

}  // namespace holdfast
