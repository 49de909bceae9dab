#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "holdfast/math/roots/pole_sum_roots.hpp"
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

  /// The pole of a weakly coupled mode to first order, s = s_n − ρK/(1 + bK).
  PlantPole of_weak(const Weak& mode, const Complex& s) const {
    return {s - mode.residue * mode.stiffness / mode.divisor,
            transmitted_share(absorber_, s) * mode.residue / (mode.divisor * mode.divisor)};
  }

  /// The pole that is continued from one eigenvalue s_n of the n-th mode.
  /// @param begin  one of the two eigenvalues of `bare`
  PlantPole of_mode(std::size_t n, const BarePair& begin) const {
    const std::optional<Weak> mode = weak(n, begin);
    return mode ? of_weak(*mode, begin.s) : from(begin.s);
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

/// The number of the other pole of a pair, in the order of `plant_poles` for a number of modes.
inline std::size_t partner_of(std::size_t k, std::size_t modes) {
  return k < 2 * modes ? (k + modes) % (2 * modes) : 4 * modes + 1 - k;
}

/// The roots s_k (1/s) of 1 + HK = 0 by `pole_sum_roots`, each belonging to one of the points b_k.
/// With D(s) = s² + (c₂ s + k₂)/m₂, H = Σ ρ_k/(s − b_k) and the absorber's points b, b′,
///
///     (1 + HK) D/((s − b)(s − b′)) = C + Σ R_k/(s − b_k),   C the limit as |s| → ∞
///     R_k = ρ_k (KD)(b_k)/((b_k − b)(b_k − b′)) of a mode,   (D + HKD)(b)/(b − b′) of the absorber
///
/// @param begins  b_k: one eigenvalue of each mode, the other ones, then b and b′, which are the
///                roots of D unless one of these is also another b_k
inline std::vector<std::complex<double>> coupled_roots(
    const std::vector<PlaceMode<double>>& modes, const Absorber<double>& absorber,
    const std::vector<std::complex<double>>& begins, double limit) {
  using Complex = std::complex<double>;
  double scale = std::abs(begins.front());
  for (const Complex& begin : begins) scale = std::min(scale, std::abs(begin));
  PoleSum<double> sum;
  for (std::size_t k = 0; k < begins.size(); ++k) {
    const Complex b = begins[k], apart = b - begins[partner_of(k, modes.size())];
    const Complex spring = absorber.stiffness + absorber.damping * b;
    const Complex own = b * b + spring / absorber.mass;                    // D
    const Complex coupled = b * b * (absorber.clamp_mass * own + spring);  // KD
    const PlaceMode<double>& mode = modes[k % modes.size()];
    const Complex residue =
        k < 2 * modes.size()
            ? mode.shape * mode.shape / mode.mass * coupled /
                  ((b - begins[2 * modes.size()]) * (b - begins[2 * modes.size() + 1]))
            : own + receptance(modes, b) * coupled;
    sum.parts.push_back({b / scale - 1.0, -residue / (apart * limit * scale), 0.0});
    if (!std::isfinite(std::abs(sum.parts.back().present))) return {};
  }
  std::vector<Complex> roots = pole_sum_roots(std::move(sum), false);
  for (Complex& root : roots) root *= scale;
  return roots;
}

}  // namespace detail

/// Computes all 2N + 2 poles of a conductor of N modes with the absorber, by `pole_sum_roots`.
/// First comes one pole of each mode: the one with Im s > 0, or one of two real poles. Then come
/// the modes' other poles, and last the two of the absorber. The assignment of poles to modes is
/// arbitrary where modes and absorber are strongly coupled. Two sums over the poles test that none
/// is missing. Work: order N²; the eigenvalues of `modal_plant` take order N³.
/// @return no poles where not all were found, for example with a critically damped mode or equal
///         poles
/// @throws InvalidParameter where modes or absorber are not admissible
inline std::vector<PlantPole> plant_poles(const std::vector<PlaceMode<double>>& modes,
                                          const Absorber<double>& absorber) {
  using Complex = std::complex<double>;
  validate(modes, absorber);
  const detail::PoleFinder finder(modes, absorber);
  std::vector<Complex> begins(2 * modes.size());
  double mobility = 0.0;
  for (std::size_t n = 0; n < modes.size(); ++n) {
    mobility += modes[n].shape * modes[n].shape / modes[n].mass;
    const auto begin = detail::PoleFinder::bare(modes[n]);
    begins[n] = begin.s;
    begins[n + modes.size()] = begin.partner;
  }
  const double decay = absorber.damping / (2.0 * absorber.mass);
  const Complex turn = std::sqrt(Complex(decay * decay - absorber.stiffness / absorber.mass));
  Complex own = -decay + turn, other = -decay - turn;
  const auto meets = [&](const Complex& b) {
    return std::abs(b - own) < 1e-3 * std::abs(own) || std::abs(b - other) < 1e-3 * std::abs(other);
  };
  if (std::abs(own - other) < 1e-3 * std::abs(own) ||
      std::any_of(begins.begin(), begins.end(), meets)) {
    own *= std::polar(1.0, 0.5);
    other = std::conj(own);
  }
  begins.push_back(own);
  begins.push_back(other);
  const double limit = 1.0 + absorber.clamp_mass * mobility;
  const auto roots = detail::coupled_roots(modes, absorber, begins, limit);
  std::vector<PlantPole> poles;
  poles.reserve(begins.size());
  for (std::size_t k = 0; k < roots.size(); ++k) {
    const std::size_t partner = detail::partner_of(k, modes.size());
    if (partner < k && roots[k] == std::conj(roots[partner]) && poles[partner].s.imag() != 0.0) {
      poles.push_back({std::conj(poles[partner].s), std::conj(poles[partner].residue)});
      if (poles[k].s.imag() > 0.0) std::swap(poles[k], poles[partner]);
      continue;
    }
    const auto mode = finder.weak_of_pole(k);
    poles.push_back(mode ? finder.of_weak(*mode, begins[k]) : finder.near(roots[k]));
  }
  return detail::are_all_poles(poles, mobility / limit) ? poles : std::vector<PlantPole>{};
}

/// The longest sampling period π / max |s| (s) that resolves all poles s; infinite without poles.
inline double nyquist_period(const std::vector<PlantPole>& poles) {
  double fastest = 0.0;
  for (const PlantPole& pole : poles) fastest = std::max(fastest, std::abs(pole.s));
  return pi<double> / fastest;
}

}  // namespace holdfast
