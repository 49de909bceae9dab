#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <optional>
#include <vector>

#include "holdfast/cable/taut_string.hpp"
#include "holdfast/control/gains.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/plant/conductor_with_absorber.hpp"
#include "holdfast/plant/enclosed_poles.hpp"
#include "holdfast/plant/plant_poles.hpp"
#include "holdfast/stability/chart/circle_arcs.hpp"
#include "holdfast/stability/chart/proved_family.hpp"
#include "holdfast/stability/response/enclosed_response.hpp"

namespace holdfast {

/// The parameters of a sampled loop on a taut string.
enum class StringParameter {
  tension,             ///< T (N), > 0
  mass_per_length,     ///< μ (kg/m), > 0
  damping_ratio,       ///< ζ of every mode, > 0
  clamp_mass,          ///< M_c (kg), ≥ 0
  absorber_mass,       ///< m₂ (kg), > 0
  absorber_stiffness,  ///< k₂ (N/m), ≥ 0
  absorber_damping,    ///< c₂ (N s/m), ≥ 0
  sampling_period,     ///< τ (s), > 0
  processing_delay,    ///< δ (s), 0 … τ
  proportional_gain,   ///< P (N/m)
  differential_gain,   ///< D (N s/m)
};

/// The sampled loops of an absorber on a taut string, which has so many modes.
///
/// The string's receptance at the absorber is H(s) = Σ h_n/d_n with h_n = 2 sin²(nπa/L)/(μL) and
/// d_n = s² + 2ζω_n s + ω_n². Next to mode m, F is taken with the factor d_m, so that nothing is
/// large there: with S = H d_m, q = m₂ s² + c₂ s + k₂ and κ = c₂ s + k₂
///
///     F = q (d_m + M_c s² S) + m₂ s² S (κ − (P + sD) U₀) − (q (d_m + M_c s² S) + m₂ s² S κ) A.
class StringFamily {
 public:
  static constexpr std::size_t parameters = 11;      ///< those of StringParameter, in its order
  static constexpr std::size_t place_of_period = 7;  ///< place of τ
  static constexpr std::size_t place_of_p = 9;       ///< place of P
  static constexpr std::size_t place_of_d = 10;      ///< place of D
  /// A number for each parameter.
  template <class Number>
  using Parameters = std::array<Number, parameters>;
  using Box = ParameterBox<parameters>;  ///< closed box of such loops

  /// @param span               L (m), > 0
  /// @param place              a (m) of the absorber, inside the span
  /// @param bending_stiffness  EI (N m²), ≥ 0
  /// @param modes              number of modes, 1 … 1000
  /// @throws InvalidParameter naming what is out of range
  StringFamily(double span, double place, double bending_stiffness, int modes)
      : span_(span), place_(place), bending_stiffness_(bending_stiffness), modes_(modes) {
    require_positive("span L", span, "m");
    require_inside_span(place, span);
    require_non_negative("bending stiffness EI", bending_stiffness, "N m^2");
    require_within("number of modes", modes, "", 1, 1000);
    const Enclosure length = Enclosure::of_decimal(span);
    // The family holds its modes as they are rounded too, for the verdict on its middle.
    const Enclosure rounded(1.0 - 1e-12, 1.0 + 1e-12), error(-2e-12, 2e-12);
    for (int n = 1; n <= modes; ++n) {
      const Enclosure waves = Enclosure(static_cast<double>(n)) * pi<Enclosure> / length;
      const Enclosure shape = sin(waves * Enclosure::of_decimal(place)) + error;
      squared_waves_.push_back(square(waves) * rounded);
      shares_.push_back(Enclosure(2.0) * square(shape) / length * rounded);
    }
  }

  /// The mode next to a frequency (rad/s).
  int near(const Parameters<double>& x, double omega) const {
    const double first = std::sqrt(squared_waves_.front().middle() * x[0] / x[1]);
    return std::clamp(static_cast<int>(std::lround(omega / first)), 1, modes_) - 1;
  }

  /// The part of F that repeats at no other frequency.
  detail::Parts<EnclosedSlope> base(const Parameters<EnclosedSlope>& x,
                                    const detail::CircleAngle<EnclosedSlope>& angle,
                                    int near) const {
    const auto& [theta, omega] = angle;
    const Near<EnclosedSlope> here = at(x, omega, near);
    const EnclosedSlope phase = theta * (x[8] / x[7] + EnclosedSlope(0.5));
    const EnclosedSlope c = cos(phase), s = sin(phase), rate = omega * x[10];
    const EnclosedSlope size = sinc(theta * EnclosedSlope(0.5));
    // (P + iωD) U₀
    const detail::Parts<EnclosedSlope> command{size * (x[9] * c + rate * s),
                                               size * (rate * c - x[9] * s)};
    const detail::Parts<EnclosedSlope> drive = here.reach * command;
    return {here.own.real - drive.real, here.own.imag - drive.imag};
  }

  /// The factor q (d_m + M_c s² S) + m₂ s² S κ of the sum over the other frequencies.
  detail::Parts<Enclosure> factor(const Parameters<Enclosure>& x, const Enclosure& omega,
                                  int near) const {
    return at(x, omega, near).own;
  }

  /// That sum; G = m₂ s² H/(q (1 + M_c s² H) + m₂ s² H κ). Where ω is beyond all ω_n, s² H has a
  /// positive real part, so that the clamp makes |1 + M_c s² H| no smaller than 1. With η₀ = Σ h_n,
  /// |H| ≤ η/ω², |H + η₀/ω²| ≤ ε/ω³ and |κ| ≤ ω r, r = k₂/ω + c₂,
  ///
  ///     g = m₂ η/e,   e = m₂ − k₂/ω² − m₂ η r/ω,   μ = η₀/(1 + M_c η₀)
  ///     h = (m₂ ε (1 + μ M_c) + r η₀ (1 + μ m₂) + μ r (M_c + m₂) ε/ω)/e.
  detail::AliasSum aliases(const Parameters<Enclosure>& x, const Enclosure& theta) const {
    const auto response = [&](const Enclosure& there) -> detail::Parts<Enclosure> {
      const Near<Enclosure> here = at(x, there, modes_ - 1);
      const Enclosure norm = square(here.own.real) + square(here.own.imag);
      return detail::Parts<Enclosure>{here.own.real / norm, -(here.own.imag / norm)} * here.reach;
    };
    const auto bounds = [&](const Enclosure& slowest) -> detail::ResponseBounds {
      const Enclosure one(1.0), clamp = x[3], mass = x[4];
      const Enclosure gap = one - squared_frequency(x, modes_ - 1) / square(slowest);
      if (!gap.is_positive()) return {Enclosure(-1.0), Enclosure(), Enclosure()};
      Enclosure mobility, error;  // η₀, ε
      for (int n = 0; n < modes_; ++n) {
        const Enclosure share = shares_[static_cast<std::size_t>(n)] / x[1];
        const Enclosure own = squared_frequency(x, n);
        mobility += share;
        error += share * (own / slowest + Enclosure(2.0) * x[2] * sqrt(own)) / gap;
      }
      const Enclosure link = x[5] / slowest + x[6], eta = mobility / gap;
      const Enclosure least = mass - x[5] / square(slowest) - mass * eta * link / slowest;
      if (!least.is_positive()) return {Enclosure(-1.0), Enclosure(), Enclosure()};
      const Enclosure mu = mobility / (one + clamp * mobility);
      const Enclosure deviation = mass * error * (one + mu * clamp) +
                                  link * mobility * (one + mu * mass) +
                                  mu * link * (clamp + mass) * error / slowest;
      return {mass * eta / least, mu, deviation / least};
    };
    return detail::alias_sum(theta, x[7], x[8], response, bounds);
  }

  /// The verdict on one loop: its plant's poles are enclosed, and F's turns about 0 counted.
  ProvedStability verdict_on(const Parameters<double>& x) const {
    const TautString<double> string{x[0], x[1], span_, x[2], bending_stiffness_};
    ConductorWithAbsorber conductor{
        string_modes(string, place_, modes_), {x[4], x[5], x[6], x[3]}, {}, {}, false};
    conductor.poles = plant_poles(conductor.modes, conductor.absorber);
    const std::vector<EnclosedPole> poles = enclosed_poles(conductor);
    if (poles.empty()) return ProvedStability::undecided;
    const EnclosedResponse response(poles, {x[7], x[8]});
    CircleArcs circle(response, 1.0);
    const std::optional<int> outside = circle.roots_outside({x[9], x[10]});
    if (!outside) return ProvedStability::undecided;
    return *outside == 0 ? ProvedStability::stable : ProvedStability::unstable;
  }

  /// @throws InvalidParameter where a loop of the box is not admissible
  void validate(const Box& box) const {
    for (const Parameters<double>& x : {box.lowest, box.highest}) {
      holdfast::validate(TautString<double>{x[0], x[1], span_, x[2], bending_stiffness_});
      require_positive("damping ratio zeta", x[2], "");
      require_non_negative("clamp mass", x[3], "kg");
      require_positive("absorber mass m2", x[4], "kg");
      require_non_negative("absorber stiffness k2", x[5], "N/m");
      require_non_negative("absorber damping c2", x[6], "N s/m");
      holdfast::validate(PdGains<double>{x[9], x[10]});
    }
    holdfast::validate(Sampling<double>{box.lowest[7], box.highest[8]});
  }

 private:
  /// q (d_m + M_c s² S) + m₂ s² S κ, and m₂ s² S.
  template <class Number>
  struct Near {
    detail::Parts<Number> own, reach;
  };

  /// ω_n² = k_n² (T + k_n² EI)/μ.
  template <class Number>
  Number squared_frequency(const Parameters<Number>& x, int n) const {
    const auto k = static_cast<std::size_t>(n);
    const Enclosure stiff = squared_waves_[k] * Enclosure::of_decimal(bending_stiffness_);
    return constant<Number>(squared_waves_[k]) * (x[0] + constant<Number>(stiff)) / x[1];
  }

  template <class Number>
  static Number constant(const Enclosure& value) {
    if constexpr (std::is_same_v<Number, Enclosure>)
      return value;
    else
      return Number(value, Enclosure());
  }

  template <class Number>
  Near<Number> at(const Parameters<Number>& x, const Number& omega, int near) const {
    using Complex = detail::Parts<Number>;
    const Number squared = omega * omega;
    const auto divisor = [&](int n) -> Complex {
      const Number own = squared_frequency(x, n);
      return {own - squared, constant<Number>(2.0) * x[2] * sqrt(own) * omega};
    };
    Complex others{constant<Number>(0.0), constant<Number>(0.0)};
    for (int n = 0; n < modes_; ++n) {
      if (n == near) continue;
      const Complex d = divisor(n);
      const Number weight = constant<Number>(shares_[static_cast<std::size_t>(n)]) /
                            (d.real * d.real + d.imag * d.imag);
      others.real += weight * d.real;
      others.imag -= weight * d.imag;
    }
    const Complex nearest = divisor(near);
    Complex sum = nearest * others;  // S μ
    sum.real += constant<Number>(shares_[static_cast<std::size_t>(near)]);
    const Number inertia = -(x[4] * squared) / x[1];
    const Complex reach{inertia * sum.real, inertia * sum.imag};
    const Complex link{x[5], omega * x[6]};
    const Complex absorber{x[5] - x[4] * squared, omega * x[6]};
    const Number clamp = x[3] * squared / x[1];
    const Complex clamped{nearest.real - clamp * sum.real, nearest.imag - clamp * sum.imag};
    const Complex own = absorber * clamped, pressed = reach * link;
    return {{own.real + pressed.real, own.imag + pressed.imag}, reach};
  }

  double span_, place_, bending_stiffness_;
  int modes_;
  std::vector<Enclosure> squared_waves_, shares_;  // (nπ/L)², h_n μ
};

}  // namespace holdfast
