#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/math/enclosure/enclosed_angle.hpp"
#include "holdfast/math/enclosure/enclosed_slope.hpp"
#include "holdfast/stability/chart/loop_chart.hpp"
#include "holdfast/stability/chart/proved_chart.hpp"

namespace holdfast {

/// Closed box of loops: each of N parameters lies between a lower and an upper end, maybe equal.
template <std::size_t N>
struct ParameterBox {
  std::array<double, N> lowest;   ///< lower end of each parameter
  std::array<double, N> highest;  ///< upper end of each parameter, ≥ the lower end

  /// The parameters of the loop in the middle of the box.
  std::array<double, N> middle() const {
    std::array<double, N> middle;
    for (std::size_t k = 0; k < N; ++k)
      middle[k] = std::clamp(0.5 * lowest[k] + 0.5 * highest[k], lowest[k], highest[k]);
    return middle;
  }
};

/// Result of a stability proof for all loops in a box.
template <std::size_t N>
struct ProvedFamily {
  double stable_share = 0.0;     ///< fraction of the box's volume proved stable, 0 … 1
  double undecided_share = 0.0;  ///< fraction of the box's volume left undecided, 0 … 1
  std::optional<std::array<double, N>> unstable_loop;  ///< a loop proved unstable, if one was found
  std::size_t parts = 0;  ///< number of boxes examined, plus that of boxes skipped at the limit

  /// The verdict: `unstable` if one loop is proved unstable, `stable` if all are proved stable.
  ProvedStability verdict() const {
    if (unstable_loop) return ProvedStability::unstable;
    return undecided_share > 0.0 ? ProvedStability::undecided : ProvedStability::stable;
  }
};

/// Limits on the work of `prove_family`.
struct FamilyLimits {
  std::size_t parts = 4000;  ///< largest number of boxes examined; the rest stay undecided
};

namespace detail {

template <class Number>
struct Parts {
  Number real, imag;
};

template <class Number>
Parts<Number> operator+(const Parts<Number>& a, const Parts<Number>& b) {
  return {a.real + b.real, a.imag + b.imag};
}
template <class Number>
Parts<Number> operator-(const Parts<Number>& a, const Parts<Number>& b) {
  return {a.real - b.real, a.imag - b.imag};
}
template <class Number>
Parts<Number> operator*(const Parts<Number>& a, const Parts<Number>& b) {
  return {a.real * b.real - a.imag * b.imag, a.real * b.imag + a.imag * b.real};
}
template <class Number>
Parts<Number> operator*(const Number& a, const Parts<Number>& b) {
  return {a * b.real, a * b.imag};
}
inline Parts<Enclosure> reciprocal(const Parts<Enclosure>& a) {
  const Enclosure inverse = Enclosure(1.0) / (square(a.real) + square(a.imag));
  return {a.real * inverse, -(a.imag * inverse)};
}

/// Sum over aliased frequencies, linear in the gains: P · proportional + D · differential.
struct AliasSum {
  Parts<Enclosure> proportional, differential;

  /// Adds the term U G of the alias angle θ + 2πn; U = 2 sin(θ/2)/(ωτ) e^{−i(θ/2 + ωδ)}.
  /// @param hold      factor U of the zero-order hold and the delay
  /// @param omega     ω (rad/s)
  /// @param response  G(iω) (m/N)
  void add(const Parts<Enclosure>& hold, const Enclosure& omega, const Parts<Enclosure>& response) {
    const Parts<Enclosure> part = hold * response;
    proportional = proportional + part;
    differential = differential + omega * Parts<Enclosure>{-part.imag, part.real};
  }
  /// Widens both numbers by the given errors, per N s/m of D and per N/m of P.
  void widen(const Enclosure& of_differential, const Enclosure& of_proportional) {
    const auto widened = [](const Parts<Enclosure>& z, double error) {
      return z + Parts<Enclosure>{{-error, error}, {-error, error}};
    };
    differential = widened(differential, of_differential.magnitude());
    proportional = widened(proportional, of_proportional.magnitude());
  }
};

/// Bounds of a receptance G above a frequency: |G(iω)| ≤ g/ω² and |G(iω) + μ/ω²| ≤ h/ω³.
struct ResponseBounds {
  Enclosure g;   ///< bound g (1/kg); if not positive, no bound is known
  Enclosure mu;  ///< limit μ (1/kg) of −ω² G(iω) for ω → ∞, an inverse mass
  Enclosure h;   ///< bound h (m rad³/(N s³))
};

/// Alias sum P A_P + D A_D = Σ U_n (P + iω_n D) G(iω_n) over all n ≠ 0. Samples cannot distinguish
/// the frequencies ω_n = (θ + 2πn)/τ from ω = θ/τ. U_n is the U of `AliasSum::add`.
///
/// Terms with |n| ≤ N are summed. The sum of the others is bounded by means of the inequalities
/// |ω_n|τ ≥ 2π(|n| − t), t = θ/2π < 1, and Σ_{n > N} (n − t)^{−k} ≤ (N + 1/2 − t)^{1 − k}/(k − 1).
/// At large θ the leading part −μ/ω² of G is summed in closed form, with x = δ/τ:
///
///     Σ e^{−i(θ + 2πn)x}/(θ + 2πn)² = (1 − x + x e^{−iθ})/(4 sin²(θ/2)),   0 ≤ x ≤ 1.
///
/// @param response  map ω (rad/s) → G(iω) (m/N)
/// @param bounds    map from the least ω (rad/s) of the other terms to their ResponseBounds
template <class Response, class Bounds>
AliasSum alias_sum(const Enclosure& theta, const Enclosure& period, const Enclosure& delay,
                   const Response& response, const Bounds& bounds) {
  const bool is_fast = theta.lower() > 0.5;  // at slow angles all of it is small
  const int terms = theta.upper() > 0.5 ? 40 : 6;
  const Enclosure turn = Enclosure(2.0) * pi<Enclosure>, half = theta * Enclosure(0.5);
  const Enclosure twice = Enclosure(2.0) * sin(half), share = delay / period;
  const Parts<Enclosure> held{twice * cos(half), -(twice * sin(half))};
  const bool is_prompt = delay == Enclosure();
  AliasSum sum;
  // Σ e^{−i(θ + 2πn)x}/(θ + 2πn)² of what is not added below.
  const Enclosure all = Enclosure(1.0) / square(twice);
  Parts<Enclosure> left{all * (Enclosure(1.0) - share + share * cos(theta)),
                        -(all * share * sin(theta))};
  for (int n = -terms; n <= terms; ++n) {
    const Enclosure angle = theta + turn * Enclosure(static_cast<double>(n));
    const Enclosure lag = angle * share, each = Enclosure(1.0) / angle, weight = square(each);
    const Parts<Enclosure> late =
        is_prompt ? Parts<Enclosure>{1.0, 0.0} : Parts<Enclosure>{cos(lag), -sin(lag)};
    left = left - weight * late;
    const Parts<Enclosure> hold = held * late;
    const Enclosure omega = angle / period;
    if (n != 0) sum.add(each * hold, omega, response(omega));
  }
  const Enclosure turns = Enclosure(theta.magnitude()) / turn;
  const Enclosure gap = Enclosure(terms + 0.5) - turns;
  const Enclosure slowest = turn * (Enclosure(terms + 1.0) - turns) / Enclosure(period.upper());
  const ResponseBounds known = bounds(slowest);
  const Enclosure size = Enclosure(2.0) * Enclosure(twice.magnitude()) * period / square(turn);
  const bool is_known = known.g.is_positive() && (Enclosure(1.0) - turns).is_positive();
  Enclosure rest = is_known ? size * known.g / gap : Enclosure::unknown();
  if (is_known && is_fast) {
    const Parts<Enclosure> lead =
        -(twice * period * known.mu) * Parts<Enclosure>{sin(half), cos(half)};
    sum.differential = sum.differential + lead * left;
    sum.widen(size * known.h * period / (turn * Enclosure(2.0) * square(gap)), rest / slowest);
    return sum;
  }
  sum.widen(rest, rest / slowest);
  return sum;
}

struct MovingParameter {
  std::size_t number;  ///< index of the parameter
  double reach;        ///< upper bound of |value − value at the box's middle| over the box
};

inline Parts<Enclosure> values_of(const Parts<EnclosedSlope>& z) {
  return {z.real.value, z.imag.value};
}
inline Parts<Enclosure> slopes_of(const Parts<EnclosedSlope>& z) {
  return {z.real.slope, z.imag.slope};
}

/// A point e^{iθ} of the unit circle with its frequency in one loop.
template <class Number>
struct CircleAngle {
  Number theta;  ///< angle θ = ωτ (rad)
  Number omega;  ///< frequency ω (rad/s)
  Number tuned;  ///< frequency Ω = ω/c (rad/s), with c as for `angle_at`
};

/// Angle and frequency of a box's loops as functions of a common coordinate v, 0 ≤ v ≤ π. At small
/// v, natural frequencies, proportional to c, have equal v in all loops; at v = π all have θ = π:
///
///     Ω = (1 − w) v/τ₀ + w v/(τ c),   w = v²/π²
/// @param c  natural frequencies relative to those of the box's middle, whose period is τ₀
inline CircleAngle<EnclosedSlope> angle_at(const EnclosedSlope& v, const EnclosedSlope& period,
                                           const EnclosedSlope& c, double middle_period) {
  const EnclosedSlope rate(Enclosure(1.0) / Enclosure(middle_period), Enclosure());
  const EnclosedSlope w = v * v * EnclosedSlope(Enclosure(1.0) / square(pi<Enclosure>), 0.0);
  const EnclosedSlope slow = v * (EnclosedSlope(1.0) - w), fast = v * w;
  const EnclosedSlope lag = period * c * rate;
  return {slow * lag + fast, slow * c * rate + fast / period, slow * rate + fast / (period * c)};
}

/// Proof that no loop of a box has a root e^{iθ} on an arc |v − v₀| ≤ h of the unit circle.
///
/// Such a root is a zero of F = Δ(iω) (1 − P G_z − D G_v), equal to the base function `Loop::base`
/// minus Δ A with the alias sum A. For all loops x of a box with the middle x⁰, F lies within
///
///     F(x⁰, v₀) + Σ_k ∂F/∂x_k (x_k − x⁰_k) + ∂F/∂v (v − v₀) − Δ A
///
/// with the base function's derivatives enclosed over box and arc. F is not 0 if, for a direction
/// u, Re(ū F(x⁰, v₀)) exceeds the sum of the bounds of all other terms' components along u. The
/// component of the term in v is small for a direction u at a right angle to ∂F/∂v.
template <class Loop>
class ArcExclusion {
 public:
  static constexpr std::size_t parameters = Loop::parameters;
  template <class Number>
  using Parameters = std::array<Number, parameters>;

  ArcExclusion(const Loop& loop, const ParameterBox<parameters>& box)
      : loop_(loop), middle_loop_(box.middle()), all_(all_of(box)), aliases_(loop.aliases(all_)) {
    for (std::size_t k = 0; k < parameters; ++k) {
      over_box_[k].value = all_[k];
      const bool is_fixed = box.lowest[k] == box.highest[k];
      at_middle_[k].value = is_fixed ? over_box_[k].value : Enclosure(middle_loop_[k]);
      middle_values_[k] = at_middle_[k].value;
      if (!is_fixed)
        moving_.push_back({k, (over_box_[k].value - Enclosure(middle_loop_[k])).magnitude()});
    }
  }

  bool holds(const Enclosure& arc) {
    const double half = arc.radius();
    place(arc);
    if (holds_along(middle_, half) || holds_along(turn_ * middle_of(rate_), half)) return true;
    return std::any_of(slopes_.begin(), slopes_.end(), [&](const Parts<Enclosure>& slope) {
      return holds_along(turn_ * middle_of(slope), half);
    });
  }

  /// The index of the parameter whose range contributes most to the spread of F on the last arc.
  std::size_t heaviest() const {
    std::size_t heaviest = 0;
    double most = -1.0;
    for (std::size_t k = 0; k < slopes_.size(); ++k) {
      const double taken = weight(slopes_[k]) * moving_[k].reach;
      if (!(taken > most)) continue;
      most = taken;
      heaviest = moving_[k].number;
    }
    // The alias sum has no slopes; the period decides how wide it is.
    const double unresolved = std::max(value_.real.radius(), value_.imag.radius());
    const auto is_period = [](const MovingParameter& moving) {
      return moving.number == Loop::place_of_period;
    };
    if (unresolved > most && std::any_of(moving_.begin(), moving_.end(), is_period))
      return Loop::place_of_period;
    return heaviest;
  }

  /// The corner of the box at which F, extrapolated by its slopes, is nearest to 0 on the last arc.
  Parameters<double> nearest_corner(const ParameterBox<parameters>& box) const {
    Parameters<double> corner = middle_loop_;
    for (std::size_t k = 0; k < slopes_.size(); ++k) {
      const std::size_t number = moving_[k].number;
      const bool falls = std::real(std::conj(middle_) * middle_of(slopes_[k])) < 0.0;
      corner[number] = falls ? box.highest[number] : box.lowest[number];
    }
    return corner;
  }

 private:
  using Complex = std::complex<double>;
  static constexpr Complex turn_ = {0.0, 1.0};

  static Complex middle_of(const Parts<Enclosure>& z) { return {z.real.middle(), z.imag.middle()}; }
  static double weight(const Parts<Enclosure>& z) {
    return std::max(z.real.magnitude(), z.imag.magnitude());
  }
  static Enclosure along(const Complex& u, const Parts<Enclosure>& z) {
    return Enclosure(u.real()) * z.real + Enclosure(u.imag()) * z.imag;
  }

  /// Enclosures of a box's parameters, for all decimals that round to the ends of the box.
  static Parameters<Enclosure> all_of(const ParameterBox<parameters>& box) {
    Parameters<Enclosure> all;
    for (std::size_t k = 0; k < parameters; ++k)
      all[k] = Enclosure::of_decimals(box.lowest[k], box.highest[k]);
    return all;
  }

  void place(const Enclosure& arc) {
    const double v = arc.middle();
    const double period = middle_loop_[Loop::place_of_period];
    auto frame = loop_.frame_at(middle_loop_, v / period);
    const auto angle = [&](const Parameters<EnclosedSlope>& x, const EnclosedSlope& at) {
      return angle_at(at, x[Loop::place_of_period], frame.tuning(x), period);
    };
    const auto base = [&](const Parameters<EnclosedSlope>& x, const EnclosedSlope& at) {
      return loop_.base(x, angle(x, at), frame);
    };
    loop_.sum_modes(middle_values_, angle(at_middle_, {Enclosure(v), 0.0}).tuned.value, frame);
    value_ = values_of(base(at_middle_, {Enclosure(v), 0.0}));
    const auto all = angle(over_box_, {arc, 0.0});
    loop_.sum_modes(all_, all.tuned.value, frame);
    slopes_.clear();
    for (const MovingParameter& moving : moving_) {
      over_box_[moving.number].slope = 1.0;
      slopes_.push_back(slopes_of(base(over_box_, {arc, 0.0})));
      over_box_[moving.number].slope = 0.0;
    }
    rate_ = slopes_of(base(over_box_, {arc, 1.0}));
    take_aliases({all.theta.value, all.omega.value, all.tuned.value}, frame);
    middle_ = middle_of(value_);
  }

  /// Subtracts Δ A from the value of F, and ∂(Δ A)/∂P and ∂(Δ A)/∂D from the slopes by P and D.
  template <class Frame>
  void take_aliases(const CircleAngle<Enclosure>& at, const Frame& frame) {
    const AliasSum sum = aliases_(at.theta);
    const Parts<Enclosure> factor = loop_.factor(all_, at, frame);
    const Parts<Enclosure> by_p = factor * sum.proportional, by_d = factor * sum.differential;
    value_ = value_ - middle_values_[Loop::place_of_p] * by_p;
    value_ = value_ - middle_values_[Loop::place_of_d] * by_d;
    for (std::size_t k = 0; k < moving_.size(); ++k) {
      if (moving_[k].number == Loop::place_of_p) slopes_[k] = slopes_[k] - by_p;
      if (moving_[k].number == Loop::place_of_d) slopes_[k] = slopes_[k] - by_d;
    }
  }

  /// Whether Re(ū F) ≠ 0 is proved for all loops of the box on the arc |v − v₀| ≤ `half`.
  bool holds_along(Complex u, double half) {
    const double size = std::abs(u);
    if (!(size > 0.0 && std::isfinite(size))) return false;
    u /= size;
    if (std::real(std::conj(u) * middle_) < 0.0) u = -u;
    Enclosure left = along(u, value_);
    for (std::size_t k = 0; k < slopes_.size(); ++k)
      left -= Enclosure(along(u, slopes_[k]).magnitude()) * Enclosure(moving_[k].reach);
    return (left - Enclosure(along(u, rate_).magnitude()) * Enclosure(half)).is_positive();
  }

  const Loop& loop_;
  Parameters<double> middle_loop_;
  Parameters<EnclosedSlope> at_middle_, over_box_;
  Parameters<Enclosure> all_, middle_values_;
  decltype(std::declval<const Loop&>().aliases(Parameters<Enclosure>())) aliases_;
  std::vector<MovingParameter> moving_;
  Parts<Enclosure> value_;                // F(x⁰, v₀), Δ A over box and arc
  Complex middle_;                        // about that
  std::vector<Parts<Enclosure>> slopes_;  // ∂F/∂x_k over box and arc
  Parts<Enclosure> rate_;                 // ∂F/∂v, likewise
};

/// Verdict on a box, with an unstable loop if found, else the parameter along which to halve.
template <std::size_t N>
struct LoopVerdict {
  ProvedStability stability;
  std::array<double, N> loop;
  std::size_t heaviest;
  bool is_stable_in_middle;  // of both halves, which share it
};

/// The verdict on a box. It is unstable if its loop in the middle or `nearest_corner` is unstable.
/// It is stable if one of its loops is stable and none has a root on the unit circle, since then no
/// root crosses the circle within the box. Otherwise it is undecided.
/// @param has_stable_loop  whether a loop of the box is proved stable already; if not, the loop in
///                         the middle is tested first
template <class Loop, std::size_t N>
LoopVerdict<N> judged(const Loop& loop, const ParameterBox<N>& box, bool has_stable_loop) {
  const std::array<double, N> middle = box.middle();
  ProvedStability of_middle = has_stable_loop ? ProvedStability::stable : loop.verdict_on(middle);
  if (of_middle == ProvedStability::unstable) return {of_middle, middle, 0, false};
  ArcExclusion<Loop> exclusion(loop, box);
  constexpr std::size_t most_arcs = 4000;
  // From v = π k w to π (k + 1) w, k and width w being exact. Depth first finds a failing arc soon.
  std::vector<std::pair<double, double>> arcs = {{0.0, 1.0}};
  for (std::size_t count = 0; !arcs.empty(); ++count) {
    const auto [number, width] = arcs.back();
    arcs.pop_back();
    const Enclosure arc = pi<Enclosure> * Enclosure(number * width, number * width + width);
    if (exclusion.holds(arc)) continue;
    if (count > most_arcs || width < 0x1p-40 || !exclusion.holds(Enclosure(arc.middle()))) {
      if (has_stable_loop) of_middle = loop.verdict_on(middle);
      if (of_middle == ProvedStability::unstable) return {of_middle, middle, 0, false};
      const std::array<double, N> corner = exclusion.nearest_corner(box);
      if (loop.verdict_on(corner) == ProvedStability::unstable)
        return {ProvedStability::unstable, corner, 0, false};
      return {ProvedStability::undecided, middle, exclusion.heaviest(),
              of_middle == ProvedStability::stable};
    }
    arcs.emplace_back(2.0 * number + 1.0, 0.5 * width);
    arcs.emplace_back(2.0 * number, 0.5 * width);
  }
  return {of_middle, middle, exclusion.heaviest(), of_middle == ProvedStability::stable};
}

/// Box still to be examined, with its share of the volume of the initial box.
template <std::size_t N>
struct LoopPart {
  ParameterBox<N> box;
  double share;
  bool has_stable_loop;
};

/// The two halves of a box along a parameter; none if no double is between the parameter's ends.
template <std::size_t N>
std::vector<ParameterBox<N>> halves_of(const ParameterBox<N>& box, std::size_t along) {
  const double cut = 0.5 * box.lowest[along] + 0.5 * box.highest[along];
  if (!(box.lowest[along] < cut && cut < box.highest[along])) return {};
  std::vector<ParameterBox<N>> halves(2, box);
  halves[0].highest[along] = cut;
  halves[1].lowest[along] = cut;
  return halves;
}

}  // namespace detail

/// Proves that every loop of a box is stable, or finds an unstable loop in it.
///
/// A box is stable if one of its loops is stable and none has a root on the unit circle. Undecided
/// boxes are halved along the parameter that changes the characteristic function most. The proof
/// includes all decimal numbers that round to the ends of the box.
/// @param loop    family of loops: TwoMassFamily or StringFamily
/// @param box     box of the family's parameters
/// @param limits  limits on the work
/// @param go_on   function called before each box is examined; an exception from it ends the work
/// @throws InvalidParameter where a loop of the box is not admissible
/// Source: R. E. Moore, R. B. Kearfott, M. J. Cloud, Introduction to Interval Analysis, SIAM 2009;
/// J. Ackermann, Robust Control, Springer 1993 (zero exclusion principle).
template <class Loop, class GoOn>
ProvedFamily<Loop::parameters> prove_family(const Loop& loop,
                                            const ParameterBox<Loop::parameters>& box,
                                            const FamilyLimits& limits, const GoOn& go_on) {
  constexpr std::size_t n = Loop::parameters;
  for (std::size_t k = 0; k < n; ++k)
    if (!(box.lowest[k] <= box.highest[k]))
      throw InvalidParameter("upper end of a parameter of the box", box.highest[k], "",
                             "at least the lower end");
  loop.validate(box);
  ProvedFamily<n> family;
  // The largest first, so that a region of unstable loops is met soon.
  std::deque<detail::LoopPart<n>> open = {{box, 1.0, false}};
  while (!open.empty()) {
    go_on();
    const detail::LoopPart<n> part = open.front();
    open.pop_front();
    if (family.parts++ >= limits.parts) {
      family.undecided_share += part.share;
      continue;
    }
    const detail::LoopVerdict<n> verdict = detail::judged(loop, part.box, part.has_stable_loop);
    if (verdict.stability == ProvedStability::unstable) {
      family.unstable_loop = verdict.loop;
      for (const detail::LoopPart<n>& rest : open) family.undecided_share += rest.share;
      family.undecided_share += part.share;
      return family;
    }
    if (verdict.stability == ProvedStability::stable) {
      family.stable_share += part.share;
      continue;
    }
    const auto halves = detail::halves_of(part.box, verdict.heaviest);
    if (halves.empty()) family.undecided_share += part.share;
    for (const ParameterBox<n>& half : halves)
      open.push_back({half, 0.5 * part.share, verdict.is_stable_in_middle});
  }
  return family;
}

/// Family of all sampled loops of two masses, for `prove_family`. Its ten parameters have the order
/// and the units of LoopParameter. Here x is the array of parameters.
struct TwoMassFamily {
  static constexpr std::size_t parameters = 10;  ///< m₁, k₁, c₁, m₂, k₂, c₂, τ, δ, P, D
  static constexpr std::size_t place_of_period = 6;  ///< index of τ
  static constexpr std::size_t place_of_p = 8;       ///< index of P
  static constexpr std::size_t place_of_d = 9;       ///< index of D
  /// Array of one number for each parameter.
  template <class Number>
  using Parameters = std::array<Number, parameters>;
  using Box = ParameterBox<parameters>;  ///< closed box of loops of two masses

  /// The parameters of the given loop, in the order of LoopParameter.
  static Parameters<double> of(OperatingPoint point) {
    Parameters<double> all;
    for (std::size_t k = 0; k < parameters; ++k)
      all[k] = value_of(point, static_cast<LoopParameter>(k));
    return all;
  }
  /// The loop with the given parameters.
  static OperatingPoint point_of(const Parameters<double>& all) {
    OperatingPoint point{};
    for (std::size_t k = 0; k < parameters; ++k)
      value_of(point, static_cast<LoopParameter>(k)) = all[k];
    return point;
  }

  /// Empty counterpart of `StringFamily::Frame`, required by `prove_family`.
  struct Frame {
    /// The number 1: the natural frequencies of two masses have no common ratio between loops.
    static EnclosedSlope tuning(const Parameters<EnclosedSlope>&) { return 1.0; }
  };
  /// Returns the empty Frame.
  static Frame frame_at(const Parameters<double>&, double) { return {}; }
  /// Does nothing, as the characteristic function F of two masses contains no modal sum.
  static void sum_modes(const Parameters<Enclosure>&, const Enclosure&, Frame&) {}

  /// The characteristic polynomial Δ of the plant without control at s = i · `omega` (rad/s):
  ///
  ///     Δ(s) = (m₁ s² + (c₁ + c₂) s + k₁ + k₂)(m₂ s² + c₂ s + k₂) − (c₂ s + k₂)²
  template <class Number>
  static detail::Parts<Number> plant(const Parameters<Number>& x, const Number& omega) {
    const auto& [m1, k1, c1, m2, k2, c2, period, delay, p, d] = x;
    const Number square = omega * omega;
    const Number cubic = m1 * c2 + m2 * (c1 + c2), quadratic = m1 * k2 + m2 * (k1 + k2) + c1 * c2;
    return {(m1 * m2 * square - quadratic) * square + k1 * k2,
            omega * (c1 * k2 + c2 * k1 - cubic * square)};
  }

  /// The characteristic function F(ω) of the loop, without the part due to aliased frequencies
  /// (`alias_sum`). A root e^{iθ}, θ = ωτ, is a zero of F. With sinc x = (sin x)/x, `base` is
  ///
  ///     Δ(iω) + (P + iωD) m₂ ω² sinc(θ/2) e^{−iθ(δ/τ + 1/2)}
  static detail::Parts<EnclosedSlope> base(const Parameters<EnclosedSlope>& x,
                                           const detail::CircleAngle<EnclosedSlope>& at, Frame) {
    const auto& [theta, omega, tuned] = at;
    const auto& [m1, k1, c1, m2, k2, c2, period, delay, p, d] = x;
    const detail::Parts<EnclosedSlope> own = plant(x, omega);
    const EnclosedSlope phase = theta * (delay / period + EnclosedSlope(0.5));
    const EnclosedSlope c = cos(phase), s = sin(phase), rate = omega * d;
    const EnclosedSlope size = m2 * (omega * omega) * sinc(theta * EnclosedSlope(0.5));
    return own + size * detail::Parts<EnclosedSlope>{p * c + rate * s, rate * c - p * s};
  }

  /// The factor Δ(iω) of the alias sum in the characteristic function F = `base` − factor · sum.
  static detail::Parts<Enclosure> factor(const Parameters<Enclosure>& x,
                                         const detail::CircleAngle<Enclosure>& at, Frame) {
    return plant<Enclosure>(x, at.omega);
  }

  /// The function θ → AliasSum that encloses the alias sum (`alias_sum`) of all loops of a box. The
  /// receptance is G = −m₂ω²/Δ(iω). With the coefficients a_k of s^k in Δ and e = m₁m₂ − a₂/ω², its
  /// bounds (`ResponseBounds`) above the frequency ω are
  ///
  ///     g = m₂/e,   μ = 1/m₁,   h = (a₃ + a₂/ω + a₁/ω² + k₁k₂/ω³)/(m₁ e).
  static auto aliases(const Parameters<Enclosure>& x) {
    return [x](const Enclosure& theta) {
      const auto response = [&](const Enclosure& at) -> detail::Parts<Enclosure> {
        const detail::Parts<Enclosure> own = plant<Enclosure>(x, at);
        const Enclosure size = -(x[3] * square(at)) / (square(own.real) + square(own.imag));
        return {size * own.real, -(size * own.imag)};
      };
      const auto bounds = [&](const Enclosure& slowest) -> detail::ResponseBounds {
        const auto& [m1, k1, c1, m2, k2, c2, period, delay, p, d] = x;
        const Enclosure cubic = m1 * c2 + m2 * (c1 + c2);
        const Enclosure quadratic = m1 * k2 + m2 * (k1 + k2) + c1 * c2;
        const Enclosure least = m1 * m2 - quadratic / square(slowest);
        if (!least.is_positive()) return {Enclosure(-1.0), Enclosure(), Enclosure()};
        const Enclosure slower = quadratic + (c1 * k2 + c2 * k1 + k1 * k2 / slowest) / slowest;
        return {m2 / least, Enclosure(1.0) / m1, (cubic + slower / slowest) / (m1 * least)};
      };
      return detail::alias_sum(theta, x[6], x[7], response, bounds);
    };
  }

  /// The verdict on a single loop with the given parameters, by Hurwitz's conditions.
  static ProvedStability verdict_on(const Parameters<double>& all) {
    const OperatingPoint x = point_of(all);
    return gain_box_proof(x.plant, x.sampling)(
        {x.gains.proportional, x.gains.proportional, x.gains.differential, x.gains.differential});
  }

  /// Validates the box. @throws InvalidParameter where a loop of the box is not admissible
  static void validate(const Box& box) {
    const OperatingPoint lowest = point_of(box.lowest), highest = point_of(box.highest);
    for (const OperatingPoint& point : {lowest, highest}) {
      holdfast::validate(point.plant);
      holdfast::validate(point.gains);
    }
    holdfast::validate(Sampling<double>{lowest.sampling.period, highest.sampling.processing_delay});
  }
};

}  // namespace holdfast
