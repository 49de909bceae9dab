#pragma once

#include <cmath>
#include <complex>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "holdfast/control/gains.hpp"
#include "holdfast/math/enclosure/complex_enclosure.hpp"
#include "holdfast/math/enclosure/enclosure.hpp"
#include "holdfast/stability/chart/proved_chart.hpp"
#include "holdfast/stability/response/enclosed_response.hpp"

namespace holdfast {

/// Encloses the characteristic function q of a loop on the upper half of the circle |λ| = r:
///
///     q(λ) = λᵏ − P F_z(λ) − D F_v(λ)   (k delayed commands; F_z and F_v of `EnclosedResponse`)
///
/// The half circle is divided into arcs. An enclosure on an arc is a linear function of the angle
/// plus an error bound. The class finds the arcs on which a loop with gains in a rectangle
/// (`GainBox`) may have a root. It also counts a loop's roots outside the circle. Arcs too long for
/// a proof are halved; the halves are stored for later calls.
class CircleArcs {
 public:
  /// List of arcs, each given by its index in this object.
  using Arcs = std::vector<std::size_t>;

  /// @param response  enclosed response of the loop
  /// @param radius    radius r > 0 of the circle, taken as exactly this double
  explicit CircleArcs(EnclosedResponse response, double radius = 1.0)
      : response_(std::move(response)), radius_(radius) {
    // The arc ends at π or just beyond; q beyond π is the conjugate of q before π.
    arcs_.push_back(arc(0.0, 0x1.921fb54442d19p1));
  }

  /// The list of a single arc, the undivided half circle.
  Arcs all() const { return {0}; }

  /// The arcs on which a loop with gains in a rectangle may have a root. The rest of `among` is
  /// proved to be without roots. Arcs are halved as long as this promises to exclude more of them.
  /// @param box    rectangle of gains P and D
  /// @param among  arcs to be searched: `all()`, or the result for a rectangle that contains `box`
  Arcs meeting(const GainBox& box, const Arcs& among) {
    const Gains gains(box);
    if (!gains.are_finite()) return among;
    Arcs met, open(among.rbegin(), among.rend());
    while (!open.empty()) {
      const std::size_t index = open.back();
      open.pop_back();
      const Reach reach(arcs_[index], gains);
      if (reach.avoids_zero()) continue;
      if (reach.is_short_enough() || !add_halves(index, open)) met.push_back(index);
    }
    return met;
  }

  /// The proved number of a loop's roots outside the circle; `nullopt` if the proof fails.
  ///
  /// Arcs are halved until Re q or Im q has a constant sign on each of them. This sign tells in
  /// which of four half-planes q lies. From arc to arc the half-plane is the same or turns by ±90°.
  /// The turns on the half circle add up to w · 180°; on the whole circle q winds w times about 0.
  /// With n_plant plant poles outside and k delayed commands, the number n_out sought is
  ///
  ///     n_out = n_plant + k − w
  ///
  /// @param gains       gains P (N/m) and D (N s/m), taken as exactly these doubles
  /// @param most_arcs   largest number of arcs examined; the result is `nullopt` if more are needed
  std::optional<int> roots_outside(const PdGains<double>& gains, std::size_t most_arcs = 20000) {
    const auto own = response_.poles_outside(radius_);
    const Gains box(
        {gains.proportional, gains.proportional, gains.differential, gains.differential});
    if (!own || !box.are_finite()) return std::nullopt;
    Arcs open = all();
    int quarters = 0, before = -1;
    for (std::size_t count = 0; !open.empty(); ++count) {
      const std::size_t index = open.back();
      open.pop_back();
      const int side = Reach(arcs_[index], box).half_plane();
      if (side < 0) {
        if (count > most_arcs || !add_halves(index, open)) return std::nullopt;
        continue;
      }
      const int turn = before < 0 ? 0 : (side - before + 4) % 4;
      if (turn == 2) return std::nullopt;
      quarters += turn == 3 ? -1 : turn;
      before = side;
    }
    if (quarters % 2 != 0) return std::nullopt;
    const int outside = *own + response_.held_commands() - quarters / 2;
    if (outside < 0) return std::nullopt;  // contradicts the argument principle
    return outside;
  }

 private:
  using Complex = std::complex<double>;

  /// Linear enclosure of a function of t, −1 ≤ t ≤ 1: value + slope t + r, |r| ≤ rest + haze.
  /// Halving an arc reduces the rest but not the haze, which is due to uncertain parameters.
  struct Line {
    Complex value, slope;
    double rest, haze;
  };
  struct Arc {
    double from, to;  // rad
    Line power, displacement, velocity;
    std::size_t first_half = 0;  // index of the first half, the second follows; 0: undivided
  };

  /// The gains P₀ ± ΔP, D₀ ± ΔD of a box: its centre and half-widths.
  struct Gains {
    double p, d, p_radius, d_radius;

    explicit Gains(const GainBox& box) {
      const Enclosure proportional(box.proportional_from, box.proportional_to);
      const Enclosure differential(box.differential_from, box.differential_to);
      p = proportional.middle(), d = differential.middle();
      p_radius = proportional.radius(), d_radius = differential.radius();
      if (p == box.proportional_from && p == box.proportional_to) p_radius = 0.0;
      if (d == box.differential_from && d == box.differential_to) d_radius = 0.0;
    }
    bool are_finite() const {
      return std::isfinite(std::abs(p) + std::abs(d) + p_radius + d_radius);
    }
  };

  /// Enclosure of q on an arc, −1 ≤ t ≤ 1, for the gains P₀ + p, D₀ + d of a box:
  ///
  ///     q = c + a t − F_z p − F_v d + e,   |e| ≤ `rest_` + `haze_` (see `Line`)
  ///
  /// The computed c, a, F_z and F_v are in error by at most 10⁻¹⁴ of the sum of their terms'
  /// moduli, as each takes fewer than 30 roundings of 1.2·10⁻¹⁶.
  class Reach {
   public:
    Reach(const Arc& arc, const Gains& gains)
        : centre_(arc.power.value - gains.p * arc.displacement.value -
                  gains.d * arc.velocity.value),
          along_(arc.power.slope - gains.p * arc.displacement.slope - gains.d * arc.velocity.slope),
          by_p_(gains.p_radius * arc.displacement.value),
          by_d_(gains.d_radius * arc.velocity.value) {
      const double p = std::abs(gains.p), d = std::abs(gains.d);
      const double z = size(arc.displacement.value), z_slope = size(arc.displacement.slope);
      const double v = size(arc.velocity.value), v_slope = size(arc.velocity.slope);
      rest_ = arc.power.rest + (p + gains.p_radius) * arc.displacement.rest +
              (d + gains.d_radius) * arc.velocity.rest + gains.p_radius * z_slope +
              gains.d_radius * v_slope;
      haze_ = arc.power.haze + (p + gains.p_radius) * arc.displacement.haze +
              (d + gains.d_radius) * arc.velocity.haze;
      rounding_ = size(arc.power.value) + size(arc.power.slope) +
                  (p + gains.p_radius) * (z + z_slope) + (d + gains.d_radius) * (v + v_slope) +
                  rest_ + haze_;
    }

    /// Whether a line through 0, normal to c or parallel to a, F_z or F_v, proves that q ≠ 0.
    bool avoids_zero() const {
      if (!std::isfinite(rounding_)) return false;
      return is_ahead(centre_) || is_ahead(across(along_)) || is_ahead(across(by_p_)) ||
             is_ahead(across(by_d_));
    }

    /// Half-plane of q, if proved. 0: Re q > 0, 1: Im q > 0, 2: Re q < 0, 3: Im q < 0; −1: unknown.
    int half_plane() const {
      if (!std::isfinite(rounding_)) return -1;
      for (const bool imaginary : {false, true}) {
        const Complex normal = imaginary ? Complex(0.0, 1.0) : Complex(1.0, 0.0);
        if (!is_ahead(normal)) continue;
        const double part = imaginary ? centre_.imag() : centre_.real();
        return (imaginary ? 1 : 0) + (part > 0.0 ? 0 : 2);
      }
      return -1;
    }

    /// Whether halving the arc would reduce the set of values of q only slightly for this box.
    bool is_short_enough() const {
      constexpr double share = 0.1;
      return rest_ <= share * (size(by_p_) + size(by_d_) + haze_);
    }

   private:
    static double size(const Complex& z) { return std::abs(z.real()) + std::abs(z.imag()); }
    static Complex across(const Complex& z) { return {-z.imag(), z.real()}; }
    static double along(const Complex& normal, const Complex& z) {
      return normal.real() * z.real() + normal.imag() * z.imag();
    }

    /// Whether all values of q lie on one side of the line through 0 perpendicular to `normal`.
    bool is_ahead(const Complex& normal) const {
      const double distance = std::abs(along(normal, centre_));
      const double spread = std::abs(along(normal, along_)) + std::abs(along(normal, by_p_)) +
                            std::abs(along(normal, by_d_)) + size(normal) * (rest_ + haze_);
      constexpr double rounding = 1e-14, least = 1e-280;
      return distance > spread + (rounding * size(normal) * rounding_ + least);
    }

    Complex centre_, along_, by_p_, by_d_;
    double rest_, haze_, rounding_;
  };

  /// Linear enclosure of a function, expanded about λ₀ = r e^{iθ₀}, on the arc θ = θ₀ + h t. There
  /// λ = λ₀ (1 + i h t) plus an error of at most r h²/2.
  static Line line_of(const EnclosedExpansion& expansion, const ComplexEnclosure& centre,
                      const Enclosure& half_width) {
    const ComplexEnclosure slope = expansion.slope * centre.times_i() * half_width;
    const Enclosure bend =
        Enclosure(0.5 * centre.magnitude()) * square(half_width) * expansion.slope.magnitude();
    const Enclosure rest = Enclosure(expansion.rest) + bend + slope.radius();
    return {expansion.value.middle(), slope.middle(), rest.upper(), expansion.value.radius()};
  }

  Arc arc(double from, double to) const {
    const Enclosure angles(from, to);
    const Enclosure half_width(angles.radius());
    const ComplexEnclosure centre =
        exponential(ComplexEnclosure({0.0, angles.middle()}, 0.0)) * Enclosure(radius_);
    const double radius = (half_width * centre.magnitude()).upper();
    const EnclosedCommandResponse response = response_.about(centre, radius);
    return {from, to, line_of(response_.power_about(centre, radius), centre, half_width),
            line_of(response.displacement, centre, half_width),
            line_of(response.velocity, centre, half_width)};
  }

  /// Appends the two halves of an arc to a list, the second half before the first.
  /// @return false if the arc is too short to be halved
  bool add_halves(std::size_t index, Arcs& list) {
    if (arcs_[index].first_half == 0) {
      const double from = arcs_[index].from, to = arcs_[index].to;
      const double middle = 0.5 * (from + to);
      if (!(from < middle && middle < to) || to - from < 1e-14) return false;
      arcs_[index].first_half = arcs_.size();
      arcs_.push_back(arc(from, middle));
      arcs_.push_back(arc(middle, to));
    }
    list.push_back(arcs_[index].first_half + 1);
    list.push_back(arcs_[index].first_half);
    return true;
  }

  EnclosedResponse response_;
  double radius_;
  std::vector<Arc> arcs_;
};

}  // namespace holdfast
