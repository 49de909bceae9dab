#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/math/linalg/complex_exponential.hpp"
#include "holdfast/math/poly/polynomial.hpp"
#include "holdfast/math/roots/root_from_pole.hpp"
#include "holdfast/plant/modal_plant.hpp"
#include "holdfast/plant/plant_poles.hpp"
#include "holdfast/span/device/dynamic_stiffness.hpp"
#include "holdfast/span/device/lumped_device.hpp"
#include "holdfast/span/modes_at_places.hpp"

namespace holdfast {

/// The poles s_k of a conductor with devices, and the receptances between places, the points where
/// devices can be attached. With the complex mode shape φ_ik of pole s_k at place i, these are
///
///     H_il(s) = Σ_k φ_ik φ_lk/(s − s_k)  (m/N, force at l, displacement at i)
///
/// Devices are attached one after the other. A device of dynamic stiffness K at place j changes
/// H_il to H_il − H_ij K H_jl/(1 + K H_jj). The new poles are the roots of 1 + K H_jj. Each root is
/// continued from a pole of the conductor or of the device alone (`root_from_pole`).
class SpanPoles {
 public:
  using Complex = std::complex<double>;  ///< type of s and of receptances

  /// @param modes  1 … 10⁴ modes of the conductor without devices; none is critically damped, and
  ///               all have the same number of places (these two conditions are unchecked)
  /// @throws InvalidParameter where the number of modes or a mode is not admissible
  explicit SpanPoles(const std::vector<ModeAtPlaces>& modes) {
    require_within("number of modes", static_cast<double>(modes.size()), "", 1, 10000);
    const std::size_t places = modes.front().shapes.size();
    mobility_.assign(places, std::vector<double>(places, 0.0));
    for (const ModeAtPlaces& mode : modes) add(mode);
  }

  /// The receptance H_il (m/N) at the complex frequency s (1/s): displacement at place i over force
  /// at place l. The first place has the index 0. The indices are not checked.
  Complex receptance(std::size_t i, std::size_t l, const Complex& s) const {
    Complex sum(0.0);
    for (const Pole& pole : poles_) sum += part(pole, i, l, s);
    return sum;
  }

  /// Attaches a lumped device to the conductor and updates poles and receptances.
  /// @param device  device with its clamp
  /// @param place   index of the device's place, from 0 (unchecked)
  /// @throws InvalidParameter where the device is not admissible
  void attach(const LumpedDevice& device, std::size_t place) {
    validate(device);
    const auto stiffness = [&](const Complex& s) { return dynamic_stiffness(device, s); };
    attach(stiffness, own_motions(device), place);
    load(place, [&] {
      double mass = device.clamp_mass;
      for (const DeviceBranch& branch : device.branches)
        mass += std::isfinite(branch.mass)
                    ? branch.inertance * branch.mass / (branch.inertance + branch.mass)
                    : branch.inertance;
      return mass;
    }());
  }

  /// Attaches an absorber without control at the place of index `place`, from 0 (unchecked).
  /// @return all poles, both of each conjugate pair, with their residues in the transfer function
  ///         from the drive's force to the displacement at this place; empty if a pole is missing
  /// @throws InvalidParameter where the absorber is not admissible
  std::vector<PlantPole> attach(const Absorber<double>& absorber, std::size_t place) {
    validate({{1.0, 0.0, 1.0, 1.0}}, absorber);
    const LumpedDevice device{{{absorber.damping, absorber.stiffness, 0.0, absorber.mass}},
                              absorber.clamp_mass};
    attach(device, place);
    std::vector<PlantPole> found;
    for (const Pole& pole : poles_) {
      const Complex residue =
          detail::transmitted_share(absorber, pole.s) * pole.shapes[place] * pole.shapes[place];
      found.push_back({pole.s, residue});
      if (pole.is_pair) found.push_back({std::conj(pole.s), std::conj(residue)});
    }
    if (!detail::are_all_poles(found, mobility_[place][place])) return {};
    return found;
  }

  /// The poles (1/s): first those continued from the modes, then those of each device in the order
  /// of attachment. A conjugate pair is listed once, by its pole with Im s > 0.
  std::vector<Complex> roots() const {
    std::vector<Complex> found;
    for (const Pole& pole : poles_) found.push_back(pole.s);
    return found;
  }

 private:
  struct Pole {
    Complex s;
    bool is_pair;
    std::vector<Complex> shapes;
  };

  static Complex part(const Pole& pole, std::size_t i, std::size_t l, const Complex& s) {
    using detail::plain_product;
    const Complex product = plain_product(pole.shapes[i], pole.shapes[l]);
    if (product == 0.0) return 0.0;  // where the bundle of another place is, too
    const Complex away = s - pole.s, other = s - std::conj(pole.s);
    if (!pole.is_pair) return plain_product(product, detail::inverse(away));
    return plain_product(detail::inverse(plain_product(away, other)),
                         plain_product(product, other) + plain_product(std::conj(product), away));
  }

  void add(const ModeAtPlaces& mode) {
    const PlaceMode<double> one{mode.angular_frequency, mode.damping_ratio, 1.0, mode.mass};
    validate({one}, {1.0, 0.0, 0.0});
    const auto [s, partner] = detail::PoleFinder::bare(one);
    const auto with = [&](const Complex& at, const Complex& other, bool is_pair) {
      Pole pole{at, is_pair, {}};
      const Complex scale = 1.0 / std::sqrt(mode.mass * (at - other));
      for (const double shape : mode.shapes) pole.shapes.push_back(scale * shape);
      poles_.push_back(std::move(pole));
    };
    with(s, partner, mode.damping_ratio < 1.0);
    if (mode.damping_ratio >= 1.0) with(partner, s, false);
    for (std::size_t i = 0; i < mode.shapes.size(); ++i)
      for (std::size_t l = 0; l < mode.shapes.size(); ++l)
        mobility_[i][l] += mode.shapes[i] * mode.shapes[l] / mode.mass;
  }

  /// Updates `mobility_`, the limit of s² H_il (1/kg) for s → ∞, for a mass (kg) at a place.
  void load(std::size_t place, double mass) {
    const std::vector<double> row = mobility_[place];
    const double share = mass / (1.0 + mass * row[place]);
    for (std::size_t i = 0; i < row.size(); ++i)
      for (std::size_t l = 0; l < row.size(); ++l) mobility_[i][l] -= share * row[i] * row[l];
  }

  /// A pole s with the new device, continued from the pole `begin` of conductor or device alone.
  struct Followed {
    Complex begin, s;
    bool is_pair;
    std::optional<Pole> weak;  // set if the device hardly changes the pole
  };

  template <class Stiffness>
  void attach(const Stiffness& stiffness, const std::vector<Complex>& own, std::size_t place) {
    std::vector<Followed> found;
    squares_ = detail::ComplexRows<double, 2>();
    for (const auto& [s, is_pair, shapes] : poles_)
      if (shapes[place] != 0.0)  // where the bundle of another place is, too
        squares_.push_back(
            {is_pair ? s : s.real(), shapes[place] * shapes[place] / (is_pair ? 1.0 : 2.0)});
    for (const Pole& pole : poles_) {
      const PoleShift shift = shift_alone(pole, stiffness, place);
      if (shift.is_weak)
        found.push_back({pole.s, pole.s - shift.change, pole.is_pair, weakly(pole, shift)});
      else if (const auto s = next_to(pole, shift, stiffness, place))
        found.push_back({pole.s, *s, pole.is_pair, std::nullopt});
      else
        follow(found, stiffness, pole.s, pole.is_pair);
    }
    for (const Complex& s : own) follow(found, stiffness, s, s.imag() != 0.0);
    separate(found, own, stiffness);
    std::vector<Pole> poles;
    poles.reserve(found.size());
    for (Followed& one : found)
      poles.push_back(one.weak ? std::move(*one.weak) : at(one.s, one.is_pair, stiffness, place));
    poles_ = std::move(poles);
  }

  /// The shift of one pole by a device, if the other poles' terms in H are taken as constant.
  struct PoleShift {
    Complex change;                              // old s_k minus new s_k
    bool is_weak;                                // whether first order suffices
    Complex stiffness_here, denominator, shape;  // K, 1 + bK, φ at the place
    std::vector<Complex> others;                 // H_ij to each place i without this pole
  };

  template <class Stiffness>
  PoleShift shift_alone(const Pole& pole, const Stiffness& stiffness, std::size_t place) const {
    const Complex s = pole.s, shape = pole.shapes[place], stiffness_here = stiffness(s).value;
    std::vector<Complex> others(pole.shapes.size());
    // A pole with a node at the place is not changed, even if another pole equals it.
    if (shape == 0.0) return {0.0, true, stiffness_here, 1.0, shape, std::move(others)};
    for (const Pole& other : poles_)
      for (std::size_t i = 0; i < others.size(); ++i) {
        if (&other != &pole) others[i] += part(other, i, place, s);
        if (&other == &pole && pole.is_pair)
          others[i] += std::conj(pole.shapes[i] * shape) / (s - std::conj(s));
      }
    const Complex denominator = 1.0 + others[place] * stiffness_here;
    const Complex change = shape * shape * stiffness_here / denominator;
    const bool is_weak = std::abs(change) < 1e-8 * std::abs(s);
    return {change, is_weak, stiffness_here, denominator, shape, std::move(others)};
  }

  /// A pole and its shape with the device, to first order, where the device hardly moves the pole.
  static Pole weakly(const Pole& pole, const PoleShift& shift) {
    Pole result{pole.s - shift.change, pole.is_pair, pole.shapes};
    for (std::size_t i = 0; i < result.shapes.size(); ++i)
      result.shapes[i] -= shift.others[i] * shift.stiffness_here * shift.shape / shift.denominator;
    return result;
  }

  /// The new value (1/s) of a pole by Newton's method from pole.s − shift.change; nullopt where the
  /// pole moves too far for this, compared with its distance from the other poles.
  template <class Stiffness>
  std::optional<Complex> next_to(const Pole& pole, const PoleShift& shift,
                                 const Stiffness& stiffness, std::size_t place) const {
    const double change = std::abs(shift.change);
    double nearest = pole.is_pair ? 2.0 * std::abs(pole.s.imag()) : std::abs(pole.s);
    for (const Pole& other : poles_)
      if (&other != &pole && other.shapes[place] != 0.0)
        nearest = std::min(nearest, std::abs(other.s - pole.s));
    if (!(change < 0.02 * nearest)) return std::nullopt;
    const Complex expected = pole.s - shift.change;
    const Complex s = polished(expected, stiffness);
    if (!(std::abs(s - expected) < 0.1 * change)) return std::nullopt;
    return s;
  }

  /// The receptance H_jj at the place j of the new device; `slope_here` is its derivative dH_jj/ds.
  Complex receptance_here(const Complex& s) const {
    detail::ComplexLanes<double> sum;
    for (const auto& [pole, square] : squares_.blocks()) {
      const auto away = s - pole, other = s - pole.conjugate();
      sum += (away * other).inverse() * (square * other + square.conjugate() * away);
    }
    return sum.sum();
  }

  Complex slope_here(const Complex& s) const {
    detail::ComplexLanes<double> sum;
    for (const auto& [pole, square] : squares_.blocks()) {
      const auto away = (s - pole).inverse(), other = (s - pole.conjugate()).inverse();
      sum += square * (away * away) + square.conjugate() * (other * other);
    }
    return -sum.sum();
  }

  /// Adds the pole continued from `begin`. If a conjugate pair becomes two real poles, the second
  /// is added as NaN, and `separate` finds it.
  template <class Stiffness>
  void follow(std::vector<Followed>& found, const Stiffness& stiffness, const Complex& begin,
              bool is_pair) const {
    const auto loop_gain = [&](const Complex& s) {
      return detail::plain_product(-receptance_here(s), stiffness(s).value);
    };
    const Complex s = polished(root_from_pole(loop_gain, begin), stiffness);
    const bool stays = std::abs(s.imag()) > 1e-9 * std::abs(s);
    found.push_back({begin, stays ? upper(s) : s, stays, std::nullopt});
    if (is_pair && !stays) found.push_back({std::conj(begin), std::nan(""), false, std::nullopt});
  }

  /// The pole with Im s ≥ 0 of the conjugate pair of s; it represents the pair.
  static Complex upper(const Complex& s) { return s.imag() < 0.0 ? std::conj(s) : s; }

  /// The sum Σ 1/(s − s_k) over all poles s_k except number `but`, and over the conjugates of all
  /// poles of pairs, including the conjugate of number `but`. Poles that are NaN are left out.
  template <class Motions>
  static Complex pull(const Motions& motions, const Complex& s, std::size_t but) {
    Complex sum(0.0);
    for (std::size_t j = 0; j < motions.size(); ++j) {
      if (std::isnan(motions[j].s.real())) continue;
      if (j != but) sum += detail::inverse(s - motions[j].s);
      if (motions[j].is_pair) sum += detail::inverse(s - std::conj(motions[j].s));
    }
    return sum;
  }

  /// Finds anew each pole that is NaN or coincides with an earlier pole. Newton's method starts
  /// near `begin` and is applied to the polynomial with all poles as roots, divided by the factors
  /// of the poles already known (Ehrlich 1967, Aberth 1973).
  template <class Stiffness>
  void separate(std::vector<Followed>& found, const std::vector<Complex>& own,
                const Stiffness& stiffness) const {
    struct Own {
      Complex s;
      bool is_pair;
    };
    std::vector<Own> device;
    device.reserve(own.size());
    for (const Complex& s : own) device.push_back({s, s.imag() != 0.0});
    const auto all = [&](const Complex& s) {
      const DynamicStiffness k = stiffness(s);
      const Complex h = receptance_here(s);
      return (slope_here(s) * k.value + h * k.slope) / (1.0 + h * k.value) +
             pull(poles_, s, poles_.size()) + pull(device, s, device.size());
    };
    for (std::size_t k = 0; k < found.size(); ++k) {
      if (found[k].weak || is_apart(found, k)) continue;
      Complex s = 1.001 * found[k].begin;
      for (int turn = 0; turn < 300; ++turn) {
        const Complex step = 1.0 / (all(s) - pull(found, s, k));
        const double share = std::abs(step) / std::abs(s);
        if (!std::isfinite(share)) break;
        s -= step * std::min(1.0, 0.1 / share);
        if (share < 1e-9) break;
      }
      s = polished(s, stiffness);
      found[k].is_pair = std::abs(s.imag()) > 1e-9 * std::abs(s);
      found[k].s = found[k].is_pair ? upper(s) : s;
    }
  }

  /// Whether the k-th pole is finite and distinct from all earlier poles.
  static bool is_apart(const std::vector<Followed>& found, std::size_t k) {
    constexpr double same = 1e-7;
    if (!std::isfinite(std::abs(found[k].s))) return false;
    // A weakly coupled pole close to it belongs to another place.
    for (std::size_t j = 0; j < k; ++j) {
      if (found[j].weak) continue;
      const double apart =
          std::min(std::abs(found[k].s - found[j].s), std::abs(found[k].s - std::conj(found[j].s)));
      if (apart < same * std::abs(found[k].s)) return false;
    }
    return true;
  }

  /// The approximate pole s refined by Newton's method on 1/H_jj + K.
  template <class Stiffness>
  Complex polished(Complex s, const Stiffness& stiffness) const {
    for (int turn = 0; turn < 12; ++turn) {
      const Complex h = receptance_here(s);
      const DynamicStiffness k = stiffness(s);
      const Complex step = (1.0 / h + k.value) / (k.slope - slope_here(s) / (h * h));
      s -= step;
      if (turn >= 2 && std::abs(step) <= 1e-15 * std::abs(s)) break;
    }
    return s;
  }

  template <class Stiffness>
  Pole at(const Complex& s, bool is_pair, const Stiffness& stiffness, std::size_t place) const {
    const DynamicStiffness k = stiffness(s);
    const Complex h = receptance_here(s);
    const Complex scale = std::sqrt(-k.value / (k.slope * h + k.value * slope_here(s)));
    Pole pole{s, is_pair, {}};
    for (std::size_t i = 0; i < mobility_.size(); ++i)
      pole.shapes.push_back(scale * receptance(i, place, s));
    if (!is_pair || s.imag() > 0.0) return pole;
    pole.s = std::conj(pole.s);
    for (Complex& shape : pole.shapes) shape = std::conj(shape);
    return pole;
  }

  std::vector<Pole> poles_;
  detail::ComplexRows<double, 2> squares_;     // s_k and φ_jk², halved for a real pole
  std::vector<std::vector<double>> mobility_;  // Σ φ_i φ_l/M, clamped masses included
};

}  // namespace holdfast
