#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <vector>

#include "holdfast/math/enclosure/complex_enclosure.hpp"
#include "holdfast/math/enclosure/enclosure.hpp"
#include "holdfast/plant/conductor_with_absorber.hpp"
#include "holdfast/plant/loop_hardware.hpp"
#include "holdfast/plant/modal_plant.hpp"
#include "holdfast/plant/plant_poles.hpp"
#include "holdfast/plant/two_mass.hpp"

namespace holdfast {

/// Discs proved to contain a pole of a plant, and its residue in the transfer function from the
/// command to the measured displacement.
struct EnclosedPole {
  ComplexEnclosure s;        ///< pole s (1/s): real, or the pole with Im s > 0 of a pair
  ComplexEnclosure residue;  ///< residue r (m/(N s)); real for a single pole
  bool is_pair;              ///< whether the conjugate of s is a pole too
};

namespace detail {

/// The transfer function n(s)/p(s) from the command to the measured displacement of a conductor
/// with absorber and hardware (symbols of `PlaceMode`, `Absorber`); no coefficients are formed:
///
///     D = Π d_n,  S = Σ φ_n²/M_n Π_{j≠n} d_j,  d_n = s² + 2ζ_n ω_n s + ω_n²,
///     Q = m₂s² + c₂s + k₂,  p = (Q D + (M_c s² Q + m₂ s² (k₂ + c₂ s)) S) h(s),
///     n = m₂ s² S h(0)
///
/// where h is the product of the denominators of filter and drive. The modes' parameters are
/// exactly the given doubles, all others decimal numbers that round to the given doubles.
class EnclosedTransfer {
 public:
  /// The values of p and n at a point, both divided by a common product.
  struct Value {
    ComplexEnclosure denominator, numerator;
  };

  explicit EnclosedTransfer(const ConductorWithAbsorber& conductor)
      : EnclosedTransfer(conductor.absorber, conductor.hardware) {
    for (const PlaceMode<double>& mode : conductor.modes) {
      const Enclosure omega(mode.angular_frequency), shape(mode.shape);
      add({2.0 * Enclosure(mode.damping_ratio) * omega, square(omega),
           square(shape) / Enclosure(mode.mass)});
    }
  }
  /// The transfer function of two masses, for all decimals that round to the given parameters.
  EnclosedTransfer(const TwoMass<double>& masses, const LoopHardware& hardware)
      : EnclosedTransfer(Absorber<double>{masses.absorber_mass, masses.absorber_stiffness,
                                          masses.absorber_damping},
                         hardware) {
    const Enclosure mass = decimal(masses.conductor_mass);
    add({decimal(masses.conductor_damping) / mass, decimal(masses.conductor_stiffness) / mass,
         1.0 / mass});
  }

  /// The degree of p.
  std::size_t degree() const { return 2 * modes_.size() + 2 + lag_states_; }
  /// The leading coefficient of p.
  Enclosure leading() const { return mass_ * (1.0 + clamp_mass_ * mobility_); }

  /// The values of p and n at s, both divided by Π (s − z_j).
  /// @param others  points z_j, fewer than the degree
  Value at(const ComplexEnclosure& s, const std::vector<ComplexEnclosure>& others) const {
    ComplexEnclosure product(1.0), sum;
    auto next = others.begin();
    const auto divide = [&](std::ptrdiff_t most) {
      const auto end = next + std::min(most, others.end() - next);
      for (; next != end; ++next) {
        const ComplexEnclosure share = inverse(s - *next);
        product *= share;
        sum *= share;
      }
    };
    for (const Mode& mode : modes_) {
      const ComplexEnclosure divisor = s * (s + mode.damping) + mode.stiffness;
      sum = sum * divisor + product * mode.mobility;
      product *= divisor;
      divide(2);
    }
    divide(others.end() - next);
    const ComplexEnclosure squared = s * s, inertia = squared * mass_;
    const ComplexEnclosure absorber = inertia + s * damping_ + stiffness_;
    const ComplexEnclosure pressed =
        squared * clamp_mass_ * absorber + inertia * (s * damping_ + stiffness_);
    Value value{absorber * product + pressed * sum, inertia * sum};
    for (const Lag& lag : lags_) {
      value.denominator *= s * (s * lag.inertia + lag.damping) + lag.stiffness;
      value.numerator *= lag.stiffness;
    }
    return value;
  }

 private:
  struct Mode {
    Enclosure damping, stiffness, mobility;  // 2ζω, ω², φ²/M
  };
  /// The denominator a s² + b s + c of a lag, with a = 1, or a = 0 and b = 1.
  struct Lag {
    Enclosure inertia, damping, stiffness;
  };

  EnclosedTransfer(const Absorber<double>& absorber, const LoopHardware& hardware)
      : mass_(decimal(absorber.mass)),
        stiffness_(decimal(absorber.stiffness)),
        damping_(decimal(absorber.damping)),
        clamp_mass_(decimal(absorber.clamp_mass)) {
    take(hardware);
  }

  void add(const Mode& mode) {
    modes_.push_back(mode);
    mobility_ += mode.mobility;
  }

  static Enclosure decimal(double nearest) { return Enclosure::of_decimal(nearest); }

  /// The angular frequency 2π f (rad/s) of a frequency f (Hz).
  static Enclosure rate_of(double frequency) {
    const Enclosure turn(2.0 * 0x1.921fb54442d18p1, 2.0 * 0x1.921fb54442d19p1);
    return turn * decimal(frequency);
  }

  void take(const LoopHardware& hardware) {
    validate(hardware);
    const auto add_first_order = [&](double frequency) {
      lags_.push_back({0.0, 1.0, rate_of(frequency)});
      lag_states_ += 1;
    };
    if (hardware.measurement_filter != LoopHardware::ideal)
      add_first_order(hardware.measurement_filter);
    if (hardware.drive_bandwidth == LoopHardware::ideal) return;
    if (hardware.drive_damping == LoopHardware::ideal)
      return add_first_order(hardware.drive_bandwidth);
    const Enclosure rate = rate_of(hardware.drive_bandwidth);
    lags_.push_back({1.0, 2.0 * decimal(hardware.drive_damping) * rate, square(rate)});
    lag_states_ += 2;
  }

  Enclosure mass_, stiffness_, damping_, clamp_mass_, mobility_;
  std::vector<Mode> modes_;
  std::vector<Lag> lags_;
  std::size_t lag_states_ = 0;
};

/// Approximate poles, sorted: a pole with Im s > 0 for each conjugate pair, and the real poles.
struct PairedPoles {
  std::vector<std::complex<double>> upper, real;

  explicit PairedPoles(const std::vector<PlantPole>& poles) {
    for (const PlantPole& pole : poles) {
      if (std::abs(pole.s.imag()) < 1e-12 * std::abs(pole.s))
        real.emplace_back(pole.s.real());
      else if (pole.s.imag() > 0.0)
        upper.push_back(pole.s);
    }
  }
  std::size_t size() const { return 2 * upper.size() + real.size(); }

  /// All poles; the two poles of a pair are adjacent.
  std::vector<std::complex<double>> all() const {
    std::vector<std::complex<double>> list;
    for (const auto& s : upper) list.insert(list.end(), {s, std::conj(s)});
    list.insert(list.end(), real.begin(), real.end());
    return list;
  }
};

/// All points except the point of index `but`.
inline std::vector<ComplexEnclosure> others_of(const std::vector<ComplexEnclosure>& all,
                                               std::size_t but) {
  std::vector<ComplexEnclosure> others = all;
  others.erase(others.begin() + static_cast<std::ptrdiff_t>(but));
  return others;
}

/// The radii of discs about the approximate poles that contain all poles; disjoint discs: one each.
inline std::vector<double> disc_radii(const EnclosedTransfer& transfer,
                                      const std::vector<ComplexEnclosure>& centres) {
  std::vector<double> radii;
  for (std::size_t k = 0; k < centres.size(); ++k) {
    const ComplexEnclosure correction =
        transfer.at(centres[k], others_of(centres, k)).denominator / transfer.leading();
    radii.push_back(
        (Enclosure(static_cast<double>(centres.size())) * correction.magnitude()).upper());
  }
  return radii;
}

/// Whether it is proved that all discs are disjoint.
inline bool are_apart(const std::vector<ComplexEnclosure>& centres,
                      const std::vector<double>& radii) {
  for (std::size_t k = 0; k < centres.size(); ++k)
    for (std::size_t j = 0; j < k; ++j) {
      const Enclosure apart = (centres[k] - centres[j]).least_modulus();
      if (!(apart - radii[k] - radii[j]).is_positive()) return false;
    }
  return true;
}

/// The enclosed poles of a transfer function, from their approximations.
inline std::vector<EnclosedPole> enclosed_poles(const EnclosedTransfer& transfer,
                                                const std::vector<PlantPole>& approximate) {
  const PairedPoles paired(approximate);
  if (approximate.empty() || paired.size() != transfer.degree()) return {};
  const auto points = paired.all();
  std::vector<ComplexEnclosure> centres;
  centres.reserve(points.size());
  for (const std::complex<double>& point : points) centres.emplace_back(point, 0.0);
  const std::vector<double> radii = disc_radii(transfer, centres);
  if (!are_apart(centres, radii)) return {};
  std::vector<ComplexEnclosure> enclosed;
  for (std::size_t k = 0; k < points.size(); ++k) {
    enclosed.emplace_back(points[k], radii[k]);
  }
  std::vector<EnclosedPole> poles;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const bool is_pair = k < 2 * paired.upper.size();
    if (is_pair && k % 2 == 1) continue;
    const ComplexEnclosure residue =
        transfer.at(enclosed[k], others_of(enclosed, k)).numerator / transfer.leading();
    poles.push_back({enclosed[k], residue, is_pair});
  }
  return poles;
}

}  // namespace detail

/// Discs proved to contain all poles s_k and residues of a conductor with absorber and hardware.
/// The transfer function from the command to the measured displacement is n(s)/p(s). Let p have the
/// degree m and the leading coefficient p_m. Discs about approximate poles z_k with the radii
///
///     m |p(z_k) / (p_m Π_{j≠k} (z_k − z_j))|
///
/// together contain all roots of p. Where no two discs touch, each contains one root, and for a
/// real z_k this root is real. The residue is n(s_k)/p′(s_k), with p′(s_k) = p_m Π_{j≠k} (s_k −
/// s_j). Work: 10 m² complex operations.
///
/// The discs are valid for modes with exactly the given doubles, and for all decimal parameters of
/// absorber and hardware that round to the given doubles. Source: B. T. Smith, Error bounds for
/// zeros of a polynomial based upon Gerschgorin's theorems, J. ACM 17 (1970), pp. 661–674.
/// @param conductor  conductor with its approximate poles
/// @return no poles where `conductor.poles` is incomplete, or two poles are too close to separate
/// @throws InvalidParameter where conductor, absorber or hardware are not admissible
inline std::vector<EnclosedPole> enclosed_poles(const ConductorWithAbsorber& conductor) {
  validate(conductor.modes, conductor.absorber);
  return detail::enclosed_poles(detail::EnclosedTransfer(conductor),
                                with_hardware(conductor.poles, conductor.hardware));
}

/// Discs proved to contain the poles and residues of two masses with hardware, for all decimal
/// parameters that round to the given doubles. @return no poles where two are too close to separate
/// @throws InvalidParameter where masses or hardware are not admissible
inline std::vector<EnclosedPole> enclosed_poles(const TwoMass<double>& masses,
                                                const LoopHardware& hardware = {}) {
  validate(masses);
  const double omega = std::sqrt(masses.conductor_stiffness / masses.conductor_mass);
  const double ratio = masses.conductor_damping / (2.0 * omega * masses.conductor_mass);
  const auto approximate =
      plant_poles({{omega, ratio, 1.0, masses.conductor_mass}},
                  {masses.absorber_mass, masses.absorber_stiffness, masses.absorber_damping});
  if (approximate.empty()) return {};
  return detail::enclosed_poles(detail::EnclosedTransfer(masses, hardware),
                                with_hardware(approximate, hardware));
}

}  // namespace holdfast
