#pragma once

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "holdfast/control/gains.hpp"
#include "holdfast/math/enclosure/complex_enclosure.hpp"
#include "holdfast/math/enclosure/disc_matrix.hpp"
#include "holdfast/math/enclosure/enclosure.hpp"
#include "holdfast/plant/enclosed_poles.hpp"
#include "holdfast/stability/response/enclosed_response.hpp"

namespace holdfast {

namespace detail {

/// All decimals to which one of two doubles is the nearest, and what is between.
inline Enclosure decimals_between(double from, double to) {
  return {Enclosure::of_decimal(from).lower(), Enclosure::of_decimal(to).upper()};
}

}  // namespace detail

/// A line through the samplings of one loop, along which a position (s) moves: τ, δ/τ being kept,
/// or δ, τ being kept, as long as the number of commands on their way stays.
struct EnclosedSamplings {
  Enclosure fixed_period;  ///< τ (s) where δ moves, else 0
  Enclosure last_share;    ///< φ − (k − 1) of δ = φ τ where τ moves, within 0 … 1
  int commands = 1;        ///< k

  /// τ moves from that of a sampling, as EnclosedSampling::of takes it.
  static EnclosedSamplings of_period(const Sampling<double>& sampling) {
    const int commands = held_commands(sampling);
    const Enclosure share =
        Enclosure::of_decimal(sampling.processing_delay) / Enclosure::of_decimal(sampling.period) -
        Enclosure(static_cast<double>(commands - 1));
    return {
        0.0, {std::clamp(share.lower(), 0.0, 1.0), std::clamp(share.upper(), 0.0, 1.0)}, commands};
  }
  /// δ moves within (k − 1) τ … k τ.
  static EnclosedSamplings of_delay(double period, int commands) {
    return {Enclosure::of_decimal(period), 0.0, commands};
  }

  /// The samplings at some positions together.
  EnclosedSampling over(const Enclosure& positions) const {
    return moves_period() ? EnclosedSampling::of_period(positions, last_share, commands)
                          : EnclosedSampling::of_delay(fixed_period, positions, commands);
  }
  /// How fast τ grows with the position.
  Enclosure period_rate() const { return moves_period() ? 1.0 : 0.0; }
  /// How fast k τ − δ does.
  Enclosure present_rate() const {
    return moves_period() ? Enclosure(1.0) - last_share : Enclosure(-1.0);
  }

 private:
  bool moves_period() const { return fixed_period.upper() == 0.0; }
};

/// Proves that a loop is stable at all samplings of a stretch of a line.
///
/// In the coordinates of the plant's poles the map of a sample is
///
///     ξ_j⁺ = e^{s_j τ} ξ_j + γ₁_j u_{i−k} + γ₀_j u_{i−k+1},   u_i = Σ_j (P + D s_j) r_j ξ_j
///     γ₀ = (e^{s h} − 1)/s,   γ₁ = (e^{s τ} − e^{s h})/s,   h = k τ − δ
///
/// and moves with the position x = x₀ + ϱ t, |t| ≤ 1, as M(t) = M₀ + M₁ t + R, |R| ≤ ϱ²/2 |M″| over
/// the stretch. With V of approximate eigenvectors and C near V⁻¹ let B(t) = C M(t) V and
/// C V = I + E. Where a vector w > 0 has
///
///     (max_t |B(t)| + |E|) w < w    entry by entry
///
/// no |λ| ≥ 1 makes λ (I + E) − B(t) singular, and the loop is stable. |B₀ + B₁ t| is largest at an
/// end. Work: for n states an eigenvalue problem and 9 products of matrices.
/// @tparam Scalar  double; a template so that only who calls it compiles it
template <class Scalar>
class SamplingProof {
 public:
  /// @param poles  as EnclosedResponse takes them
  /// @param gains  P and D of the decimals
  /// @param line   of the samplings it is asked for
  SamplingProof(const std::vector<EnclosedPole>& poles, const PdGains<double>& gains,
                EnclosedSamplings line)
      : line_(line) {
    const Enclosure p = Enclosure::of_decimal(gains.proportional),
                    d = Enclosure::of_decimal(gains.differential);
    for (const EnclosedPole& pole : poles) {
      add(pole.s, pole.residue, pole.is_pair, p, d);
      if (pole.is_pair) add(conj(pole.s), conj(pole.residue), false, p, d);
    }
  }

  /// Whether the loop is proved to be stable at all positions from … to (s).
  bool is_stable(double from, double to) const;

 private:
  using Dense = Eigen::MatrixXcd;
  using Bound = Eigen::MatrixXd;

  struct Motion {
    ComplexEnclosure s, reading;  // (P + D s) r
    bool is_first_of_pair;        // its partner follows
  };
  /// What multiplies ξ_j and the two commands.
  struct Entries {
    ComplexEnclosure own, past, present;
  };
  using Order = std::vector<Entries>;

  void add(const ComplexEnclosure& s, const ComplexEnclosure& residue, bool is_first_of_pair,
           const Enclosure& p, const Enclosure& d) {
    motions_.push_back({s, (ComplexEnclosure(p) + s * d) * residue, is_first_of_pair});
  }

  Eigen::Index motions() const { return static_cast<Eigen::Index>(motions_.size()); }
  Eigen::Index size() const { return motions() + line_.commands; }

  /// M and ϱ M′ at a position.
  std::pair<Order, Order> entries_at(const Enclosure& position, const Enclosure& reach) const {
    const EnclosedSampling sampling = line_.over(position);
    const Enclosure t = line_.period_rate(), h = line_.present_rate();
    std::pair<Order, Order> result;
    for (const Motion& motion : motions_) {
      const ComplexEnclosure& s = motion.s;
      const ComplexEnclosure whole = exponential(s * sampling.period);
      const ComplexEnclosure late = exponential(s * sampling.present);
      result.first.push_back({whole, (whole - late) / s, (late - 1.0) / s});
      result.second.push_back(
          {s * whole * (t * reach), (whole * t - late * h) * reach, late * (h * reach)});
    }
    return result;
  }

  /// ϱ² M″/2 over all positions of a stretch, as discs about 0.
  Order largest_second(const Enclosure& stretch, const Enclosure& reach) const {
    const EnclosedSampling sampling = line_.over(stretch);
    const Enclosure t = square(line_.period_rate()), h = square(line_.present_rate());
    const Enclosure factor = 0.5 * square(reach);
    // As discs where these are small, which cancel; by moduli where s ϱ is not.
    const auto disc = [&](const ComplexEnclosure& exact, const Enclosure& size) {
      const double least = std::min((exact * factor).magnitude(), (size * factor).magnitude());
      return ComplexEnclosure(0.0, least);
    };
    Order result;
    for (const Motion& motion : motions_) {
      const ComplexEnclosure& s = motion.s;
      const Enclosure rate(s.magnitude());
      const ComplexEnclosure whole = exponential(s * sampling.period) * t;
      const ComplexEnclosure late = exponential(s * sampling.present) * h;
      const Enclosure whole_size = modulus_of_power(s, sampling.period) * t;
      const Enclosure late_size = modulus_of_power(s, sampling.present) * h;
      result.push_back({disc(s * s * whole, square(rate) * whole_size),
                        disc(s * (whole - late), rate * (whole_size + late_size)),
                        disc(s * late, rate * late_size)});
    }
    return result;
  }
  /// |e^{s t}|.
  static Enclosure modulus_of_power(const ComplexEnclosure& s, const Enclosure& time) {
    const Enclosure exponent = s.real() * time;
    const Matrix<Enclosure, 1> largest =
        exponential(Matrix<Enclosure, 1>(Enclosure(exponent.upper())));
    return {0.0, largest(0, 0).upper()};
  }

  /// What a matrix of these entries makes of some columns.
  DiscMatrix times(const Order& order, bool shifts, const Dense& columns) const {
    const Eigen::Index n = motions(), all = size(), k = line_.commands;
    DiscMatrix image(all, columns.cols());
    for (Eigen::Index l = 0; l < columns.cols(); ++l) {
      ComplexEnclosure command;
      for (Eigen::Index j = 0; j < n; ++j)
        command += motions_[static_cast<std::size_t>(j)].reading * exact(columns(j, l));
      const ComplexEnclosure past = exact(columns(all - 1, l));
      const ComplexEnclosure present = k == 1 ? command : exact(columns(all - 2, l));
      for (Eigen::Index j = 0; j < n; ++j) {
        const Entries& entry = order[static_cast<std::size_t>(j)];
        image.set(j, l,
                  entry.own * exact(columns(j, l)) + entry.past * past + entry.present * present);
      }
      if (!shifts) continue;
      image.set(n, l, command);
      for (Eigen::Index i = n + 1; i < all; ++i) image.set(i, l, exact(columns(i - 1, l)));
    }
    return image;
  }

  static ComplexEnclosure exact(const std::complex<double>& z) { return {z, 0.0}; }

  /// Whether a matrix of entries ≥ 0 has a vector w > 0 with B w < w: a few steps of the power
  /// method propose one.
  static bool contracts(const Bound& bound) {
    if (!bound.allFinite()) return false;
    const Eigen::Index n = bound.rows();
    Eigen::VectorXd w = Eigen::VectorXd::Ones(n);
    for (int step = 0; step < 20; ++step) {
      w = 0.5 * (w + bound * w);
      w = (w / w.maxCoeff()).cwiseMax(1e-6);
    }
    for (Eigen::Index i = 0; i < n; ++i) {
      Enclosure sum;
      for (Eigen::Index j = 0; j < n; ++j) sum += Enclosure(bound(i, j)) * Enclosure(w[j]);
      if (!(sum.upper() < w[i])) return false;
    }
    return true;
  }

  /// Of a matrix that is real in the coordinates Re ξ, Im ξ of each pair, approximately; NaN where
  /// none were found.
  Dense eigenvectors_of(const Dense& matrix) const {
    const std::complex<double> i(0.0, 1.0);
    Dense pairs = Dense::Identity(size(), size()), back = pairs;  // ξ, ξ* of Re ξ, Im ξ
    for (Eigen::Index j = 0; j + 1 < motions(); ++j) {
      if (!motions_[static_cast<std::size_t>(j)].is_first_of_pair) continue;
      pairs.block<2, 2>(j, j) << 1.0, i, 1.0, -i;
      back.block<2, 2>(j, j) << 0.5, 0.5, -0.5 * i, 0.5 * i;
    }
    const Eigen::EigenSolver<Bound> solver(Bound((back * matrix * pairs).real()));
    if (solver.info() != Eigen::Success)
      return Dense::Constant(size(), size(), std::numeric_limits<double>::quiet_NaN());
    return pairs * solver.eigenvectors();
  }

  EnclosedSamplings line_;
  std::vector<Motion> motions_;
};

// Beside the class, so that who links holdfast::compiled is spared it.

template <class Scalar>
bool SamplingProof<Scalar>::is_stable(double from, double to) const {
  const Enclosure stretch = detail::decimals_between(from, to);
  const Enclosure centre(stretch.middle()), reach(stretch.radius());
  const Dense identity = Dense::Identity(size(), size());
  const auto [at_centre, moving] = entries_at(centre, reach);
  const Dense basis = eigenvectors_of(times(at_centre, true, identity).centre);
  const Dense back = basis.partialPivLu().inverse();
  if (!back.allFinite()) return false;
  const DiscMatrix constant = product(back, times(at_centre, true, basis));
  const DiscMatrix linear = product(back, times(moving, false, basis));
  const DiscMatrix rest = product(back, times(largest_second(stretch, reach), false, basis));
  const DiscMatrix unit = product(back, DiscMatrix(basis));
  Bound bound(size(), size());
  for (Eigen::Index j = 0; j < size(); ++j)
    for (Eigen::Index i = 0; i < size(); ++i) {
      const ComplexEnclosure c = constant.at(i, j), a = linear.at(i, j);
      const double most = std::max((c + a).magnitude(), (c - a).magnitude());
      const ComplexEnclosure missing = unit.at(i, j) - (i == j ? 1.0 : 0.0);
      bound(i, j) = (Enclosure(most) + rest.at(i, j).magnitude() + missing.magnitude()).upper();
    }
  return contracts(bound);
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template class SamplingProof<double>;
#endif

}  // namespace holdfast
