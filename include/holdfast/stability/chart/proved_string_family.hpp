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

/// The parameters of the sampled loop of an absorber on a taut string.
enum class StringParameter {
  tension,             ///< string tension T (N), > 0
  mass_per_length,     ///< string mass per length μ (kg/m), > 0
  damping_ratio,       ///< damping ratio ζ of every mode, > 0
  clamp_mass,          ///< mass M_c of the absorber's clamp (kg), ≥ 0
  absorber_mass,       ///< absorber's mass m₂ (kg), > 0
  absorber_stiffness,  ///< absorber's stiffness k₂ (N/m), ≥ 0
  absorber_damping,    ///< absorber's damping c₂ (N s/m), ≥ 0
  sampling_period,     ///< sampling period τ (s), > 0
  processing_delay,    ///< processing delay δ (s), 0 … τ
  proportional_gain,   ///< proportional gain P (N/m)
  differential_gain,   ///< differential gain D (N s/m)
};

/// Family of sampled loops, for `prove_family`: an absorber on a taut string with N modes.
///
/// The string's receptance at the absorber is H(s) = Σ h_n/d_n with h_n = 2 sin²(nπa/L)/(μL) and
/// d_n = s² + 2ζω_n s + ω_n². As H is large near resonance, the characteristic function F is
/// multiplied by d_m of the nearest mode m. With s = iω, S = H d_m, q = m₂ s² + c₂ s + k₂, θ = ωτ,
/// κ = c₂ s + k₂, U₀ = sinc(θ/2) e^{−iθ(δ/τ + 1/2)}, sinc x = (sin x)/x, the sum A over aliased
/// frequencies (`detail::alias_sum`), and the symbols of StringParameter,
///
///     F = q (d_m + M_c s² S) + m₂ s² S (κ − (P + sD) U₀) − (q (d_m + M_c s² S) + m₂ s² S κ) A.
class StringFamily {
 public:
  static constexpr std::size_t parameters = 11;      ///< number of parameters, see StringParameter
  static constexpr std::size_t place_of_period = 7;  ///< index of the sampling period τ
  static constexpr std::size_t place_of_p = 9;       ///< index of the gain P
  static constexpr std::size_t place_of_d = 10;      ///< index of the gain D
  /// Array with one number for each parameter, in the order of StringParameter.
  template <class Number>
  using Parameters = std::array<Number, parameters>;
  using Box = ParameterBox<parameters>;  ///< closed box of loops of the family

  /// @param span               span L (m), > 0
  /// @param place              distance a (m) of the absorber from one end of the span, 0 < a < L
  /// @param bending_stiffness  bending stiffness EI (N m²), ≥ 0
  /// @param modes              number N of modes, 1 … 1000
  /// @throws InvalidParameter naming the argument that is out of range
  StringFamily(double span, double place, double bending_stiffness, int modes)
      : span_(span), place_(place), bending_stiffness_(bending_stiffness), modes_(modes) {
    require_positive("span L", span, "m");
    require_inside_span(place, span);
    require_non_negative("bending stiffness EI", bending_stiffness, "N m^2");
    require_within("number of modes", modes, "", 1, 1000);
    const Enclosure length = Enclosure::of_decimal(span);
    // Enclosures include the rounded modes as well, which `verdict_on` uses.
    const Enclosure rounded(1.0 - 1e-12, 1.0 + 1e-12), error(-2e-12, 2e-12);
    for (int n = 1; n <= modes; ++n) {
      const Enclosure waves = Enclosure(static_cast<double>(n)) * pi<Enclosure> / length;
      const Enclosure shape = sin(waves * Enclosure::of_decimal(place)) + error;
      squared_waves_.push_back(square(waves) * rounded);
      shares_.push_back(Enclosure(2.0) * square(shape) / length * rounded);
    }
  }

  /// Data to evaluate F for all loops of a box near one frequency: the nearest mode m and the sum
  /// over all other modes at Ω = ω/c, with the loop's ratio c of wave speeds (`tuning`).
  struct Frame {
    int nearest;              ///< index of the nearest mode m, from 0
    Enclosure squared_speed;  ///< squared wave speed T₀/μ₀ at the midpoint (m²/s²)
    detail::Parts<Enclosure> others = {};      ///< sum Σ μh_n/d_n over all modes n ≠ m
    detail::Parts<Enclosure> by_tuned = {};    ///< derivative of `others` with respect to Ω
    detail::Parts<Enclosure> by_damping = {};  ///< derivative of `others` with respect to ζ
    detail::Parts<Enclosure> by_tension = {};  ///< derivative of `others` with respect to T

    /// The ratio c = √((T/μ)/(T₀/μ₀)) of wave speeds; T₀ and μ₀ are T and μ at the box's midpoint.
    EnclosedSlope tuning(const Parameters<EnclosedSlope>& x) const {
      return sqrt(x[0] / (x[1] * constant<EnclosedSlope>(squared_speed)));
    }
  };
  /// The frame near a frequency, with its modal sums still 0; `sum_modes` computes them.
  /// @param x      parameters at the midpoint of a box
  /// @param omega  frequency ω (rad/s)
  Frame frame_at(const Parameters<double>& x, double omega) const {
    const double first = std::sqrt(squared_waves_.front().middle() * x[0] / x[1]);
    return {std::clamp(static_cast<int>(std::lround(omega / first)), 1, modes_) - 1,
            Enclosure(x[0]) / Enclosure(x[1])};
  }
  /// Computes a frame's modal sum and its derivatives with respect to Ω, ζ and T.
  /// @param x      parameters of the loops, as enclosures
  /// @param tuned  frequency Ω (rad/s)
  /// @param frame  frame of `frame_at`, whose sums are overwritten
  void sum_modes(const Parameters<Enclosure>& x, const Enclosure& tuned, Frame& frame) const {
    using Complex = detail::Parts<Enclosure>;
    frame.others = frame.by_tuned = frame.by_damping = frame.by_tension = {};
    const Enclosure two(2.0), squared = square(tuned);
    for (int n = 0; n < modes_; ++n) {
      if (n == frame.nearest) continue;
      const auto k = static_cast<std::size_t>(n);
      const Enclosure own = squared_frequency(x[0], frame.squared_speed, n), root = sqrt(own);
      const Complex d{own - squared, two * x[2] * root * tuned};
      const Complex one_over = detail::reciprocal(d);
      frame.others = frame.others + shares_[k] * one_over;
      // −(μh/d²) ∂d
      const Complex rate = -shares_[k] * Complex{square(one_over.real) - square(one_over.imag),
                                                 two * one_over.real * one_over.imag};
      frame.by_tuned = frame.by_tuned + rate * Complex{-(two * tuned), two * x[2] * root};
      frame.by_damping = frame.by_damping + rate * Complex{0.0, two * root * tuned};
      if (bending_stiffness_ == 0.0) continue;
      const Enclosure stiff = squared_waves_[k] * Enclosure::of_decimal(bending_stiffness_);
      const Enclosure falls =
          -(squared_waves_[k] * frame.squared_speed * stiff / square(x[0]));  // ∂Ω_n²/∂T
      frame.by_tension = frame.by_tension + rate * Complex{falls, x[2] * tuned * falls / root};
    }
  }

  /// The characteristic function F without its last term, the one with the alias sum A.
  detail::Parts<EnclosedSlope> base(const Parameters<EnclosedSlope>& x,
                                    const detail::CircleAngle<EnclosedSlope>& angle,
                                    const Frame& frame) const {
    const auto& [theta, omega, tuned] = angle;
    const Near<EnclosedSlope> here = at(x, omega, tuned, frame);
    const EnclosedSlope phase = theta * (x[8] / x[7] + EnclosedSlope(0.5));
    const EnclosedSlope c = cos(phase), s = sin(phase), rate = omega * x[10];
    const EnclosedSlope size = sinc(theta * EnclosedSlope(0.5));
    // (P + iωD) U₀
    const detail::Parts<EnclosedSlope> command{x[9] * c + rate * s, rate * c - x[9] * s};
    return here.own - here.reach * (size * command);
  }

  /// The factor q (d_m + M_c s² S) + m₂ s² S κ of the alias sum A in the characteristic function F.
  detail::Parts<Enclosure> factor(const Parameters<Enclosure>& x,
                                  const detail::CircleAngle<Enclosure>& angle,
                                  const Frame& frame) const {
    return at(x, angle.omega, angle.tuned, frame).own;
  }

  /// The function θ → AliasSum that encloses the alias sum A of all loops of a box. The receptance
  /// is G = m₂ s² H/(q (1 + M_c s² H) + m₂ s² H κ). If ω exceeds all ω_n, then Re(s² H) > 0 and
  /// |1 + M_c s² H| ≥ 1. Let η₀ = Σ h_n, r = k₂/ω + c₂ ≥ |κ|/ω, |H| ≤ η/ω² and |H + η₀/ω²| ≤ ε/ω³.
  /// Then the bounds of G (`ResponseBounds`) above the frequency ω are
  ///
  ///     g = m₂ η/e,   e = m₂ − k₂/ω² − m₂ η r/ω,   μ = η₀/(1 + M_c η₀)
  ///     h = (m₂ ε (1 + μ M_c) + r η₀ (1 + μ m₂) + μ r (M_c + m₂) ε/ω)/e.
  auto aliases(const Parameters<Enclosure>& x) const {
    return [this, x, moments = Moments(*this, x)](const Enclosure& theta) {
      const auto response = [&](const Enclosure& there) {
        return this->response(x, moments, there);
      };
      const auto bounds = [&](const Enclosure& slowest) -> detail::ResponseBounds {
        const Enclosure one(1.0), clamp = x[3], mass = x[4];
        const Enclosure gap = one - square(moments.fastest / slowest);
        if (!gap.is_positive()) return {Enclosure(-1.0), Enclosure(), Enclosure()};
        const Enclosure& mobility = moments.all[0];  // η₀
        const Enclosure error = (moments.of_squares / slowest + moments.all[1]) / gap;
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
    };
  }

  /// The proved stability of one loop, from its number of roots outside the circle (`CircleArcs`).
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

  /// Validates a box. @throws InvalidParameter where a loop of the box is not admissible
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
  /// The terms `own` = q (d_m + M_c s² S) + m₂ s² S κ and `reach` = m₂ s² S of F near mode m.
  template <class Number>
  struct Near {
    detail::Parts<Number> own, reach;
  };

  /// The moments M_k = U_k(ζ) Σ h_n ω_n^k of a box's strings, with Chebyshev polynomials U_k:
  ///
  ///     s² H = Σ_k M_k (−1/s)^k,   |s| > ω_N,
  ///
  /// since 1/(1 + 2ζt + t²) = Σ U_k(ζ) (−t)^k. For ζ ≤ 1, |U_k| ≤ k + 1. The terms with k ≥ K sum
  /// to at most (K + 1) M_0 r^K/(1 − r)², r = ω_N/|s|.
  struct Moments {
    static constexpr std::size_t count = 24;
    std::array<Enclosure, count> all;
    Enclosure fastest, of_squares;  // ω_N, Σ h_n ω_n²

    Moments(const StringFamily& family, const Parameters<Enclosure>& x) {
      for (int n = 0; n < family.modes_; ++n) {
        Enclosure part = family.shares_[static_cast<std::size_t>(n)] / x[1];
        fastest = sqrt(family.squared_frequency(x[0], x[0] / x[1], n));
        for (Enclosure& moment : all) {
          moment += part;
          part *= fastest;
        }
      }
      of_squares = all[2];
      Enclosure before, here(1.0);  // U_{k−1}, U_k
      for (Enclosure& moment : all) {
        moment *= here;
        const Enclosure next = Enclosure(2.0) * x[2] * here - before;
        before = here;
        here = next;
      }
    }
  };

  /// The response G(iω) of a box's loops: from `moments` if ω > 2 ω_N and ζ ≤ 1, else as modal sum.
  detail::Parts<Enclosure> response(const Parameters<Enclosure>& x, const Moments& moments,
                                    const Enclosure& omega) const {
    using Complex = detail::Parts<Enclosure>;
    const Enclosure one(1.0), ratio = moments.fastest / abs(omega);
    if (!(ratio.upper() < 0.5 && x[2].upper() <= 1.0)) {
      Frame frame{modes_ - 1, x[0] / x[1]};
      sum_modes(x, omega, frame);
      const Near<Enclosure> here = at(x, omega, omega, frame);
      return here.reach * detail::reciprocal(here.own);
    }
    std::size_t terms = 0;
    Enclosure power(1.0);
    for (; terms < Moments::count && power.upper() > 1e-12; terms += 2) power *= square(ratio);
    const Enclosure rest =
        Enclosure(static_cast<double>(terms + 1)) * moments.all[0] * power / square(one - ratio);
    const Enclosure either(-rest.upper(), rest.upper()), falls = -(one / square(omega));
    Complex sum;
    for (std::size_t k = terms; k > 0; k -= 2)
      sum = Complex{moments.all[k - 2], moments.all[k - 1]} + falls * sum;
    const Complex reach{sum.real + either, sum.imag / omega + either};  // s² H
    const Complex link{x[5], omega * x[6]}, absorber{x[5] - x[4] * square(omega), omega * x[6]};
    const Complex moved = x[4] * reach;
    return moved * detail::reciprocal(absorber * (Complex{one, {}} + x[3] * reach) + moved * link);
  }

  /// The squared frequency k_n² (1 + k_n² EI/T) v² of mode n + 1, k_n = (n + 1)π/L, v² = T/μ.
  template <class Number>
  Number squared_frequency(const Number& tension, const Number& squared_speed, int n) const {
    const auto k = static_cast<std::size_t>(n);
    const Number taut = constant<Number>(squared_waves_[k]) * squared_speed;
    if (bending_stiffness_ == 0.0) return taut;
    const Enclosure stiff = squared_waves_[k] * Enclosure::of_decimal(bending_stiffness_);
    return taut * (constant<Number>(1.0) + constant<Number>(stiff) / tension);
  }

  template <class Number>
  static Number constant(const Enclosure& value) {
    if constexpr (std::is_same_v<Number, Enclosure>)
      return value;
    else
      return Number(value, Enclosure());
  }

  template <class Number>
  Near<Number> at(const Parameters<Number>& x, const Number& omega, const Number& tuned,
                  const Frame& frame) const {
    using Complex = detail::Parts<Number>;
    const int near = frame.nearest;
    const Number squared = tuned * tuned, speed = constant<Number>(frame.squared_speed);
    const Number damping = constant<Number>(2.0) * x[2] * tuned;
    const Number own_squared = squared_frequency(x[0], speed, near);
    const Complex nearest{own_squared - squared, damping * sqrt(own_squared)};
    Complex others{constant<Number>(frame.others.real), constant<Number>(frame.others.imag)};
    if constexpr (std::is_same_v<Number, EnclosedSlope>) {
      for (const auto& [part, rate] : {std::pair{tuned.slope, &frame.by_tuned},
                                       {x[2].slope, &frame.by_damping},
                                       {x[0].slope, &frame.by_tension}}) {
        others.real.slope += part * rate->real;
        others.imag.slope += part * rate->imag;
      }
    }
    Complex sum = nearest * others;  // S μ
    sum.real += constant<Number>(shares_[static_cast<std::size_t>(near)]);
    const Number inertia = -(x[4] * squared) / x[1];
    const Complex reach = inertia * sum;
    const Complex link{x[5], omega * x[6]};
    const Complex absorber{x[5] - x[4] * (omega * omega), omega * x[6]};
    const Number clamp = x[3] * squared / x[1];
    return {absorber * (nearest - clamp * sum) + reach * link, reach};
  }

  double span_, place_, bending_stiffness_;
  int modes_;
  std::vector<Enclosure> squared_waves_, shares_;  // (nπ/L)², h_n μ
};

}  // namespace holdfast
