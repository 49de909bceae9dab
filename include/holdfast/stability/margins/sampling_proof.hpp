#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <vector>

#include "holdfast/control/gains.hpp"
#include "holdfast/math/enclosure/complex_enclosure.hpp"
#include "holdfast/math/enclosure/enclosed_curve.hpp"
#include "holdfast/math/enclosure/enclosure.hpp"
#include "holdfast/plant/enclosed_poles.hpp"
#include "holdfast/stability/response/enclosed_response.hpp"
#include "holdfast/stability/response/modal_response.hpp"

namespace holdfast {

/// One-parameter family of sampling periods τ and delays δ. The parameter, `position` (s), is τ
/// with δ/τ constant, or δ with τ constant. The number of delayed commands is constant.
struct EnclosedSamplings {
  Enclosure fixed_period;  ///< period τ (s) if the delay δ varies; 0 if τ varies
  Enclosure last_share;    ///< δ/τ − (k − 1), 0 … 1, if τ varies; 0 if δ varies
  int commands = 1;        ///< number k of delayed commands

  /// The family with varying τ and constant δ/τ, for all decimals that round to the given doubles.
  static EnclosedSamplings of_period(const Sampling<double>& sampling) {
    const int commands = held_commands(sampling);
    const Enclosure share =
        Enclosure::of_decimal(sampling.processing_delay) / Enclosure::of_decimal(sampling.period) -
        Enclosure(static_cast<double>(commands - 1));
    return {
        0.0, {std::clamp(share.lower(), 0.0, 1.0), std::clamp(share.upper(), 0.0, 1.0)}, commands};
  }
  /// The family with δ varying from (k − 1) τ to k τ, for τ = `period` (s) and k = `commands`.
  static EnclosedSamplings of_delay(double period, int commands) {
    return {Enclosure::of_decimal(period), 0.0, commands};
  }

  /// The enclosure of all samplings with a position in the interval `positions` (s).
  EnclosedSampling over(const Enclosure& positions) const {
    if (!moves_period()) return EnclosedSampling::of_delay(fixed_period, positions, commands);
    return {positions, last_share * positions, (Enclosure(1.0) - last_share) * positions, commands};
  }
  /// The sampling at a position (s) in double precision, for the midpoints of the enclosures.
  Sampling<double> next_to(double position) const {
    if (!moves_period()) return {fixed_period.middle(), std::max(position, 0.0)};
    return {position, (commands - 1 + last_share.middle()) * position};
  }

  /// Enclosure of a time that depends on the position, and of its derivative.
  struct Time {
    Enclosure at;    ///< value of the time (s)
    Enclosure rate;  ///< derivative of the time (s) with respect to the position (s)
  };
  /// The period τ at a position (s).
  Time period_at(const Enclosure& position) const {
    return moves_period() ? Time{position, 1.0} : Time{fixed_period, 0.0};
  }
  /// The time k τ − δ at a position (s): the part of a sample in which the latest command acts.
  Time present_at(const Enclosure& position) const {
    const Enclosure share = 1.0 - last_share, all = static_cast<double>(commands) * fixed_period;
    return moves_period() ? Time{share * position, share} : Time{all - position, -1.0};
  }

 private:
  bool moves_period() const { return fixed_period.upper() == 0.0; }
};

/// Proof that a loop is stable for all τ, or all δ, of a segment of a family `EnclosedSamplings`.
///
/// The plant has poles s_j with residues r_j. k commands are delayed, and h = k τ − δ is the time
/// for which the latest one acts in a sample. The loop's roots λ are those of the polynomial
///
///     p(λ) = q(λ) Π_j (λ − e_j),   q(λ) = λᵏ − Σ_j (P + D s_j) r_j (γ₀_j λ + γ₁_j)/(λ − e_j)
///     e_j = e^{s_j τ},   γ₀_j = (e^{s_j h} − 1)/s_j,   γ₁_j = (e^{s_j τ} − e^{s_j h})/s_j
///
/// Let z_i be distinct nodes, as many as roots. Both p and Π_i (λ − z_i) have the leading
/// coefficient 1. Lagrange's interpolation of their difference gives
///
///     p(λ)/Π_i (λ − z_i) = 1 + Σ_i W_i/(λ − z_i),   W_i = p(z_i)/Π_{l≠i} (z_i − z_l)
///
/// Let all |z_i| < 1, and Σ |W_i|/|λ − z_i| < 1 on the unit circle and hence outside it. Then no
/// root is on or outside the circle. Nodes near the roots have small W_i (K. Weierstrass, 1891). On
/// a segment of τ or δ, x₀ + ϱ t for |t| ≤ 1, each node follows a root on a spiral z_i(t), and
/// p(z_i(t)) is enclosed with two derivatives. Work: order N² for N roots; 2 ms for 40 modes.
template <class Scalar>
class SamplingProof {
 public:
  /// @param poles  poles of `enclosed_poles`, at least one, none of which may be 0
  /// @param gains  P (N/m) and D (N s/m), exactly the given decimal numbers
  /// @param line   family of samplings with varying τ or varying δ
  SamplingProof(const std::vector<EnclosedPole>& poles, const PdGains<double>& gains,
                EnclosedSamplings line)
      : line_(line), gains_(gains) {
    const ComplexEnclosure p(Enclosure::of_decimal(gains.proportional)),
        d(Enclosure::of_decimal(gains.differential));
    const auto add = [&](const ComplexEnclosure& s, const ComplexEnclosure& residue) {
      motions_.push_back({s, (p + s * d) * residue / s});
      const std::complex<double> r = residue.middle();
      residues_.push_back({s.middle(), r, r * s.middle()});
    };
    // As loop_roots() leaves what has died out within a sample to the end.
    std::vector<EnclosedPole> slow_first = poles;
    std::stable_sort(slow_first.begin(), slow_first.end(), [](const auto& one, const auto& other) {
      return one.s.middle().real() > other.s.middle().real();
    });
    for (const EnclosedPole& pole : slow_first) {
      add(pole.s, pole.residue);
      if (pole.is_pair) add(conj(pole.s), conj(pole.residue));
    }
  }

  /// Node z_i of the interpolation on a segment; t is −1 at the segment's start and 1 at its end.
  struct Node {
    EnclosedSpiral path;  ///< path z_i(t) of the node
    double correction;    ///< upper bound of |W_i(t)| for all t
  };

  /// The nodes for a proof at all τ (or δ) from `from` to `to` (s); empty if the roots of the loop
  /// in the middle of this interval are not found.
  std::vector<Node> nodes_over(double from, double to) const;

  /// Whether the loop is proved to be stable for all τ (or δ) from `from` to `to` (s).
  bool is_stable(double from, double to) const {
    const std::vector<Node> nodes = nodes_over(from, to);
    return !nodes.empty() && are_held_inside(nodes);
  }

 private:
  using Nodes = std::vector<EnclosedSpiral>;

  struct Motion {
    ComplexEnclosure s, reading;  // (P + D s) r/s
  };
  /// Term of one pole in the sum of q over a segment: (`present` λ + `past`)/(λ − `pole`).
  struct Part {
    EnclosedSpiral pole;  // e^{sτ}
    EnclosedCurve past, present;

    /// The numerator of the term at λ = `node`.
    EnclosedCurve over(const EnclosedCurve& node) const { return present * node + past; }
  };

  /// A `Part` at t = 0 and a node z, in double precision, with derivatives by t (`…_moves`).
  struct PartInDoubles {
    std::complex<double> pole, pole_moves, present, over, over_moves;

    PartInDoubles(const Part& part, const std::complex<double>& z)
        : pole(part.pole.start().middle()),
          pole_moves(part.pole.rate().middle() * pole),
          present(part.present.value().middle()),
          over(present * z + part.past.value().middle()),
          over_moves(part.present.slope().middle() * z + part.past.slope().middle()) {}
  };

  /// The terms of all poles over a segment with centre `position` (s), half length `reach` = ϱ (s).
  std::vector<Part> parts_at(const Enclosure& position, const Enclosure& reach) const {
    const auto period = line_.period_at(position), present = line_.present_at(position);
    std::vector<Part> parts;
    for (const auto& [s, reading] : motions_) {
      const EnclosedSpiral whole{exponential(s * period.at), s * (period.rate * reach)};
      const EnclosedSpiral late{exponential(s * present.at), s * (present.rate * reach)};
      parts.push_back({whole, difference(whole, late) * reading,
                       (late.curve() - ComplexEnclosure(1.0)) * reading});
    }
    return parts;
  }

  static ComplexEnclosure exact(const std::complex<double>& z) { return {z, 0.0}; }

  /// The nodes: approximate roots of the loop, first one for each pole in the order of the poles.
  /// Empty where the roots are not found. Inaccurate nodes do not make the proof invalid.
  Nodes nodes_at(double position, const std::vector<Part>& parts) const {
    using Complex = std::complex<double>;
    const Sampling<double> sampling = line_.next_to(position);
    if (!(sampling.period > 0.0)) return {};
    const ModalResponse<double> response(residues_, sampling);
    auto roots = loop_roots(response, gains_);
    const std::size_t poles = parts.size(), all = poles + static_cast<std::size_t>(line_.commands);
    if (roots.size() + 1 == all) roots.insert(roots.begin(), Complex(0.0));  // of γ₁ = 0
    if (roots.size() != all) return {};
    std::rotate(roots.begin(), roots.end() - static_cast<std::ptrdiff_t>(poles), roots.end());
    Nodes nodes;
    for (std::size_t i = 0; i < all; ++i)
      nodes.emplace_back(exact(roots[i]), exact(rate_of(i, roots[i], parts)));
    return nodes;
  }

  /// The rate σ of root i, which moves on z e^{σt} along the segment, from G(z e^{σt}; t) = 0. For
  /// the root that belongs to pole i, G = (z − e_i) q, which is finite at the pole; else G = q.
  std::complex<double> rate_of(std::size_t i, const std::complex<double>& z,
                               const std::vector<Part>& parts) const {
    using Complex = std::complex<double>;
    Complex rest = 1.0;
    for (int k = 1; k < line_.commands; ++k) rest *= z;
    Complex by_root = static_cast<double>(line_.commands) * rest, by_time = 0.0;
    rest *= z;
    for (std::size_t j = 0; j < parts.size(); ++j) {
      if (j == i) continue;
      const PartInDoubles part(parts[j], z);
      const Complex inverse = 1.0 / (z - part.pole), quotient = part.over * inverse;
      rest -= quotient;
      by_root -= (part.present - quotient) * inverse;
      by_time -= (part.over_moves + quotient * part.pole_moves) * inverse;
    }
    if (i < parts.size()) {
      const PartInDoubles own(parts[i], z);
      const Complex away = z - own.pole;
      by_time = away * by_time - own.pole_moves * rest - own.over_moves;
      by_root = away * by_root + rest - own.present;
    }
    const Complex rate = -by_time / (by_root * z);
    return std::abs(rate) < 0.5 ? rate : 0.0;
  }

  /// Distance and relative motion of a node and a point that must not coincide on the segment.
  struct Encounter {
    std::complex<double> away, drift;  // node minus point, and its derivative by t

    Encounter(const EnclosedSpiral& node, const EnclosedSpiral& other)
        : away(node.start().middle() - other.start().middle()),
          drift(node.rate().middle() * node.start().middle() -
                other.rate().middle() * other.start().middle()) {}

    bool is_near(double room) const {
      return std::abs(away) < std::min(room, std::max(2.5 * std::abs(drift), 1e-3 * room));
    }
    /// The unit vector normal to `drift` from `point` towards 0; arbitrary for drift 0.
    std::complex<double> aside_from(const std::complex<double>& point, std::size_t i) const {
      if (!(std::abs(drift) > 0.0)) return std::polar(1.0, static_cast<double>(i));
      const std::complex<double> across = drift / std::abs(drift) * std::complex<double>(0.0, 1.0);
      return std::real(across * std::conj(point)) > 0.0 ? -across : across;
    }
  };

  /// Moves apart nodes that would meet on the segment, as roots do on the real axis, and moves node
  /// i away from the poles j ≠ i. A shift is at most 0.3 of a node's distance from the unit circle.
  static void make_room(Nodes& nodes, const std::vector<Part>& parts) {
    const auto room_of = [](const EnclosedSpiral& node) {
      return 0.3 * (1.0 - std::abs(node.start().middle()));
    };
    for (std::size_t i = 0; i < nodes.size(); ++i)
      for (std::size_t l = 0; l < i; ++l) {
        const Encounter meeting(nodes[i], nodes[l]);
        const double room = std::min(room_of(nodes[i]), room_of(nodes[l]));
        if (!meeting.is_near(room)) continue;
        const std::complex<double> middle = nodes[i].start().middle() - 0.5 * meeting.away;
        const std::complex<double> half = 0.5 * room * meeting.aside_from(middle, i);
        const auto rate = exact(0.5 * (nodes[i].rate().middle() + nodes[l].rate().middle()));
        nodes[i] = {exact(middle + half), rate};
        nodes[l] = {exact(middle - half), rate};
      }
    for (std::size_t i = 0; i < nodes.size(); ++i)
      for (std::size_t j = 0; j < parts.size(); ++j) {
        const double room = room_of(nodes[i]);
        const Encounter meeting(nodes[i], parts[j].pole);
        if (j == i || !meeting.is_near(0.5 * room)) continue;
        const std::complex<double> node = nodes[i].start().middle();
        nodes[i] = {exact(node + room * meeting.aside_from(node, i)), nodes[i].rate()};
      }
  }

  /// Makes nodes that are nearly conjugate exactly conjugate, and nearly real nodes real.
  /// @return the partner of each node, which may be itself; empty where a node has no partner
  static std::vector<std::size_t> mirror(Nodes& nodes) {
    constexpr double rounding = 1e-9;
    std::vector<std::size_t> partners(nodes.size(), nodes.size());
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (partners[i] < nodes.size()) continue;
      const std::complex<double> z = nodes[i].start().middle(), rate = nodes[i].rate().middle();
      std::size_t l = i;
      if (std::abs(z.imag()) < rounding) {
        nodes[i] = {exact(z.real()), exact(rate.real())};
      } else {
        const auto is_partner = [&](std::size_t k) {
          return partners[k] == nodes.size() &&
                 std::abs(nodes[k].start().middle() - std::conj(z)) < rounding;
        };
        for (++l; l < nodes.size() && !is_partner(l);) ++l;
        if (l == nodes.size()) return {};
        nodes[l] = conj(nodes[i]);
      }
      partners[i] = l;
      partners[l] = i;
    }
    return partners;
  }

  /// An upper bound of |W_i| on the segment. The factors of pole j and node j are combined first:
  ///
  ///     (z_i − e_j)/(z_i − z_j) = 1/(1 − (z_j − e_j)/(z_i − e_j))
  ///
  /// @param own  differences z_j − e_j
  double correction(std::size_t i, const Nodes& nodes, const std::vector<Part>& parts,
                    const std::vector<EnclosedCurve>& own) const {
    const EnclosedCurve node = nodes[i].curve();
    EnclosedCurve sum = nodes[i].to_the(line_.commands).curve();
    Enclosure divisor = 1.0;
    for (std::size_t j = 0; j < nodes.size(); ++j) {
      if (j == i) continue;
      if (j >= parts.size()) {
        divisor *= difference(nodes[i], nodes[j]).least();
        continue;
      }
      const EnclosedCurve near = inverse(difference(nodes[i], parts[j].pole));
      sum = sum - parts[j].over(node) * near;
      divisor *= (ComplexEnclosure(1.0) - own[j] * near).least();
    }
    if (i < parts.size()) sum = own[i] * sum - parts[i].over(node);
    return (Enclosure(sum.most()) / divisor).upper();
  }

  /// Whether all |z_i| < 1, and Σ |W_i|/|λ − z_i| < 1 on the whole unit circle, are proved.
  static bool are_held_inside(const std::vector<Node>& nodes) {
    std::vector<double> inside;
    Enclosure sum;
    for (const auto& [path, correction] : nodes) {
      inside.push_back((Enclosure(1.0) - path.most()).lower());
      if (!(inside.back() > 0.0)) return false;
      sum += Enclosure(correction) / inside.back();
    }
    if (sum.upper() < 1.0) return true;
    const auto arcs = static_cast<int>(2 * nodes.size());
    const double half = pi<double> / arcs + 1e-12;  // of the angle, and roundings of the middle
    for (int m = 0; m < arcs; ++m) {
      const ComplexEnclosure arc(std::polar(1.0, (2 * m + 1) * pi<double> / arcs), half);
      sum = 0.0;
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        const ComplexEnclosure node(nodes[i].path.start().middle(), nodes[i].path.way());
        sum += Enclosure(nodes[i].correction) / std::max(inside[i], (arc - node).least_modulus());
      }
      if (!(sum.upper() < 1.0)) return false;
    }
    return true;
  }

  EnclosedSamplings line_;
  PdGains<double> gains_;
  std::vector<Motion> motions_;
  std::vector<ModalResponse<double>::Residue> residues_;
};

// Outside the class: code in a class is compiled again in every file that uses it.

template <class Scalar>
auto SamplingProof<Scalar>::nodes_over(double from, double to) const -> std::vector<Node> {
  const Enclosure stretch = Enclosure::of_decimals(from, to);
  const std::vector<Part> parts = parts_at(stretch.middle(), stretch.radius());
  Nodes nodes = nodes_at(stretch.middle(), parts);
  if (nodes.empty()) return {};
  make_room(nodes, parts);
  const std::vector<std::size_t> partners = mirror(nodes);
  std::vector<EnclosedCurve> own;
  for (std::size_t j = 0; j < parts.size(); ++j) own.push_back(difference(nodes[j], parts[j].pole));
  std::vector<Node> held;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const bool is_known = !partners.empty() && partners[i] < i;
    held.push_back(
        {nodes[i], is_known ? held[partners[i]].correction : correction(i, nodes, parts, own)});
  }
  return held;
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template class SamplingProof<double>;
#endif

}  // namespace holdfast
