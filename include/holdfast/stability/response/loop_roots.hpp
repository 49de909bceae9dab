#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "holdfast/control/gains.hpp"
#include "holdfast/math/poly/polynomial.hpp"
#include "holdfast/stability/response/modal_response.hpp"

namespace holdfast {

namespace detail {

/// The roots of a loop whose response is a sum over poles, all at once (Ehrlich 1967, Aberth 1973):
/// each is improved by Newton's step for what is left of the characteristic polynomial when all
/// others are divided out. Each root but those of the commands on their way is kept as its distance
/// d from a pole, in which nothing cancels where the gains hardly move it.
template <class Scalar>
class RootIteration {
 public:
  using Complex = std::complex<Scalar>;
  using Parts = typename ModalResponse<Scalar>::LoopParts;

  /// @param loop   of p(λ) = 1 − λ^{1−k} w(λ) Σ (a + b/λ)/(λ − e)
  /// @param power  k − 1
  /// @param extra  roots beyond those of the poles: the order of the pole at λ = 0
  RootIteration(Parts loop, int power, int extra)
      : parts_(std::move(loop.parts)),
        weight_(loop.weight),
        radius_(loop.radius),
        power_(power),
        distances_(parts_.size()) {
    // Off the axis of symmetry, on which a pair could not leave the real line.
    const Complex turned = std::polar(Scalar(1), Scalar(0.1));
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const Local at = local(i, Complex(0));
      const Complex first = turned * at.own / at.rest;
      distances_[i] = std::isfinite(std::abs(first)) ? first : Complex(1e-3, 1e-3);
    }
    for (int j = 0; j < extra; ++j)
      extras_.push_back(std::polar(
          Scalar(0.3), Scalar(0.7) + Scalar(2) * pi<Scalar> * Scalar(j) / Scalar(extra)));
  }

  /// @return whether all of them settled, and their sum is what the polynomial says
  bool settle() {
    std::vector<char> settled(parts_.size() + extras_.size(), 0);
    for (int sweep = 0; sweep < 200; ++sweep) {
      bool all = true;
      for (std::size_t i = 0; i < settled.size(); ++i) {
        if (settled[i] == 0) settled[i] = improve(i) ? 1 : 0;
        all = all && settled[i] != 0;
      }
      if (all) return has_their_sum();
      // Round-off of roots close to each other, or to 0, hides the last digits.
      if (sweep != 40) continue;
      tolerance_ = Scalar(1e-12);
      floor_ = Scalar(1e-15);
    }
    return false;
  }

  /// λ of all roots.
  std::vector<Complex> roots() const {
    std::vector<Complex> found = extras_;
    for (std::size_t i = 0; i < parts_.size(); ++i)
      found.push_back(Complex(1) + (parts_[i].increment + distances_[i]));
    return found;
  }

 private:
  /// p at λ = e_i + d as rest − own/d, and the derivatives of the two.
  struct Local {
    Complex own, own_slope, rest, rest_slope;
  };

  /// w and its derivative at λ = 1 + μ, 1/λ being `back`.
  struct WeightThere {
    Complex value, slope;
  };
  WeightThere weight_at(const Complex& mu, const Complex& back) const {
    if (weight_.change == Scalar(0)) return {weight_.constant, Complex(0)};
    const Complex change = ((radius_ - Scalar(1)) / radius_ + mu) * back;  // 1 − 1/(rλ)
    return {weight_.constant + weight_.change * change, weight_.change / radius_ * back * back};
  }

  Local local(std::size_t i, const Complex& distance) const {
    const Complex mu = parts_[i].increment + distance, back = inverse(Complex(1) + mu);
    Complex before(1);  // λ^{1−k}
    for (int j = 0; j < power_; ++j) before *= back;
    const WeightThere weight = weight_at(mu, back);
    // With their slopes: λ^{1−k} w (a + b/λ) of the own part and of the sum of the others.
    const auto delayed = [&](const Complex& a, const Complex& b) {
      return weight.value * (before * (a + b * back));
    };
    const auto delayed_slope = [&](const Complex& a, const Complex& b) {
      const Complex bare = -before * back * (Scalar(power_) * a + Scalar(power_ + 1) * b * back);
      return weight.value * bare + weight.slope * (before * (a + b * back));
    };
    Complex sum_a(0), sum_b(0), slope_a(0), slope_b(0);
    for (std::size_t j = 0; j < parts_.size(); ++j) {
      if (j == i) continue;
      const Complex away = inverse(parts_[i].increment - parts_[j].increment + distance);
      const Complex a = parts_[j].present * away, b = parts_[j].past * away;
      sum_a += a;
      sum_b += b;
      slope_a -= a * away;
      slope_b -= b * away;
    }
    return {delayed(parts_[i].present, parts_[i].past),
            delayed_slope(parts_[i].present, parts_[i].past), Complex(1) - delayed(sum_a, sum_b),
            -delayed_slope(sum_a, sum_b) - delayed(slope_a, slope_b)};
  }

  /// Σ (1/(λ − e_j) − 1/(λ − z_j)) over all roots but the i-th.
  /// @param lambda  that root
  Complex divided_out(std::size_t i, const Complex& lambda) const {
    Complex sum(0);
    for (std::size_t j = 0; j < parts_.size(); ++j) {
      if (j == i) continue;
      const Complex away = i < parts_.size()
                               ? parts_[i].increment - parts_[j].increment + distances_[i]
                               : lambda - Complex(1) - parts_[j].increment;
      sum -= distances_[j] * inverse(away * (away - distances_[j]));
    }
    for (std::size_t j = 0; j < extras_.size(); ++j) {
      sum += inverse(lambda);
      if (parts_.size() + j != i) sum -= inverse(lambda - extras_[j]);
    }
    return sum;
  }

  /// @return whether it has settled
  bool improve(std::size_t i) {
    if (i >= parts_.size()) return improve_extra(i - parts_.size());
    Complex& d = distances_[i];
    const Local at = local(i, d);
    // Of d p(λ), whose pole is gone.
    const Complex value = d * at.rest - at.own;
    const Complex slope = at.rest + d * at.rest_slope - at.own_slope;
    const Complex step =
        value / (slope + value * divided_out(i, Complex(1) + parts_[i].increment + d));
    return take(d, step, Complex(1) + (parts_[i].increment + d));
  }

  bool improve_extra(std::size_t j) {
    Complex& root = extras_[j];
    const Complex mu = root - Complex(1), back = inverse(root);
    Complex before(1), sum(0), slope(0);
    for (int k = 0; k < power_; ++k) before *= back;
    for (const auto& part : parts_) {
      const Complex away = inverse(mu - part.increment);
      const Complex a = part.present * away, b = part.past * away * back;
      sum += a + b;
      slope -= (a + b) * away + b * back;
    }
    const WeightThere weight = weight_at(mu, back);
    const Complex value = Complex(1) - weight.value * (before * sum);
    const Complex value_slope = weight.value * (before * (Scalar(power_) * back * sum - slope)) -
                                weight.slope * (before * sum);
    const Complex step = value / (value_slope + value * divided_out(parts_.size() + j, root));
    return take(root, step, root);
  }

  /// Takes a step from a root λ, of which one at 0 has none.
  /// @return whether the root has settled
  bool take(Complex& unknown, const Complex& step, const Complex& lambda) const {
    if (!std::isfinite(std::abs(step))) return std::abs(lambda) < Scalar(1e-15);
    unknown -= step;
    return std::abs(step) <= tolerance_ * std::abs(unknown) + floor_;
  }

  /// Σ z = Σ e + w(∞) Σ a, or Σ e where a command waits for a sample or longer.
  bool has_their_sum() const {
    const Scalar weight = weight_.constant + weight_.change;
    Complex sum(0);
    Scalar size(0);
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      sum += distances_[i];
      size += std::abs(distances_[i]);
      if (power_ == 0) sum -= weight * parts_[i].present;
    }
    for (const Complex& root : extras_) {
      sum += root;
      size += std::abs(root);
    }
    return std::abs(sum) <= Scalar(1e-9) * size + Scalar(1e-14) * Scalar(parts_.size());
  }

  std::vector<typename ModalResponse<Scalar>::LoopPart> parts_;
  typename ModalResponse<Scalar>::Weight weight_;
  Scalar radius_;
  int power_;
  Scalar tolerance_{1e-14}, floor_{1e-17};
  std::vector<Complex> distances_, extras_;
};

}  // namespace detail

/// The roots λ of the loop 1 = P G_z(λ) + D G_v(λ), all of them: as many as the plant has states
/// and commands are on their way. Some 10 to 30 sweeps of N² operations, where the eigenvalues of
/// the loop's map take N³. A velocity by difference adds the memory of one reading, and a root;
/// with D = 0 that root is 0 and not among them.
/// @param response  of the plant by its poles
/// @param gains     P and D
/// @return nothing where they do not settle or their sum is not that of the polynomial: where roots
///         coincide, the response has no sum over poles, or more than 20 commands are on their way
template <class Scalar>
std::vector<std::complex<Scalar>> loop_roots(const ModalResponse<Scalar>& response,
                                             const PdGains<Scalar>& gains) {
  using Complex = std::complex<Scalar>;
  auto loop = response.loop_parts(gains);
  const auto all = std::exchange(loop.parts, {});
  auto& parts = loop.parts;
  // What has died out within a sample has one pole together, λ = 0, and else roots there.
  typename ModalResponse<Scalar>::LoopPart dead{Complex(-1), Complex(0), Complex(0)};
  std::size_t of_dead = 0;
  for (const auto& part : all) {
    if (std::abs(Complex(1) + part.increment) > Scalar(1e-14)) {
      parts.push_back(part);
      continue;
    }
    ++of_dead;
    dead.present += part.present;
    dead.past += part.past;
  }
  const int power = response.held_commands() - 1;
  const int extra = power + (response.is_late_within_sample() ? 1 : 0) +
                    (loop.weight.change != Scalar(0) ? 1 : 0);
  if (of_dead > 0) parts.push_back(dead);
  if (parts.empty() || power > 19) return {};
  detail::RootIteration<Scalar> iteration(std::move(loop), power, extra);
  if (!iteration.settle()) return {};
  auto roots = iteration.roots();
  for (; of_dead > 1; --of_dead) roots.emplace_back(0);
  return roots;
}

/// The root of a loop of largest modulus.
/// @param response  of the plant by its poles
/// @param gains     P and D
/// @return NaN where `loop_roots` finds none
template <class Scalar>
std::complex<Scalar> largest_loop_root(const ModalResponse<Scalar>& response,
                                       const PdGains<Scalar>& gains) {
  const auto roots = loop_roots(response, gains);
  const auto largest = std::max_element(
      roots.begin(), roots.end(),
      [](const auto& one, const auto& other) { return std::norm(one) < std::norm(other); });
  if (largest == roots.end()) return {std::numeric_limits<Scalar>::quiet_NaN(), Scalar(0)};
  return *largest;
}

/// ρ − 1 of a loop, ρ the largest modulus of its roots; NaN where `loop_roots` finds none.
/// @param response  of the plant by its poles
/// @param gains     P and D
template <class Scalar>
Scalar loop_excess(const ModalResponse<Scalar>& response, const PdGains<Scalar>& gains) {
  const std::complex<Scalar> mu = largest_loop_root(response, gains) - Scalar(1);
  const Scalar squared = Scalar(2) * mu.real() + std::norm(mu);  // |λ|² − 1
  return squared / (Scalar(1) + std::sqrt(Scalar(1) + squared));
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template std::vector<std::complex<double>> loop_roots(const ModalResponse<double>&,
                                                             const PdGains<double>&);
#endif

}  // namespace holdfast
