#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "holdfast/control/harmonic_input.hpp"
#include "holdfast/core/lanes.hpp"
#include "holdfast/core/rational.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/motion/excitation.hpp"

namespace holdfast {

/// What the excitation adds to the state over each sampling period, one period after the other:
///
///     F_m (g_c cos ω t_j + g_s sin ω t_j),   j = 0, 1, 2, …
///
/// The cosine and sine are computed once in `block` periods; between them they are turned by fixed
/// angles, e^{iω(J+k)τ} = e^{iωJτ} e^{iωkτ}, so that a period costs eight multiply-adds and the
/// rounding does not grow with j.
template <class Scalar>
class HarmonicForcing {
 public:
  HarmonicForcing(const HarmonicInput<Scalar>& input, const HarmonicExcitation<Scalar>& excitation,
                  const Scalar& sampling_period)
      : excitation_(excitation), sampling_period_(sampling_period) {
    const HarmonicExcitation<Scalar> unit{Scalar(1), excitation.frequency};
    for (std::size_t k = 0; k < block; ++k) {
      const auto turn = sample_excitation(unit, sampling_period, static_cast<std::int64_t>(k));
      in_phase_[k] = input.cosine * turn.cosine + input.sine * turn.sine;
      quadrature_[k] = input.sine * turn.cosine - input.cosine * turn.sine;
    }
  }

  /// The addition (4 × 1) of the present sampling period; goes on to the next one.
  Vector<Scalar, 4> next() {
    const std::size_t k = static_cast<std::size_t>(index_) % block;
    if (k == 0) base_ = sample_excitation(excitation_, sampling_period_, index_);
    ++index_;
    return in_phase_[k] * base_.cosine + quadrature_[k] * base_.sine;
  }

 private:
  static constexpr std::size_t block = 16;

  HarmonicExcitation<Scalar> excitation_;
  Scalar sampling_period_;
  std::array<Vector<Scalar, 4>, block> in_phase_;
  std::array<Vector<Scalar, 4>, block> quadrature_;
  ExcitationSample<Scalar> base_{Scalar(0), Scalar(0)};
  std::int64_t index_ = 0;
};

/// The same where sampling and excitation coincide every q samples, f τ = p/q: a table of q
/// additions, repeated for ever. Copies share the table.
/// @tparam Scalar  a pack gets the same addition in every lane
template <class Scalar>
class PeriodicForcing {
  using Value = typename Lanes<Scalar>::Value;

 public:
  /// @param ratio  f τ = p/q in lowest terms, q ≥ 1; it replaces the product of the two, whose
  ///               rounding would let them drift apart
  PeriodicForcing(const HarmonicInput<Value>& input, const Value& amplitude, const Rational& ratio)
      : PeriodicForcing(table_of(input, amplitude, ratio)) {}

  /// @param additions  one for each of the q sampling periods of a coincidence, not empty
  explicit PeriodicForcing(std::vector<Vector<Value, 4>> additions)
      : additions_(std::make_shared<const std::vector<Vector<Value, 4>>>(std::move(additions))) {}

  /// The addition (4 × 1) of the present sampling period; goes on to the next one.
  Vector<Scalar, 4> next() {
    const Vector<Value, 4>& addition = (*additions_)[phase_];
    if (++phase_ == additions_->size()) phase_ = 0;
    return addition.template cast<Scalar>();
  }

  /// q.
  std::size_t samples() const { return additions_->size(); }
  /// Sampling periods since the last coincidence, 0 … q − 1.
  std::size_t phase() const { return phase_; }
  const std::vector<Vector<Value, 4>>& additions() const { return *additions_; }

 private:
  static std::vector<Vector<Value, 4>> table_of(const HarmonicInput<Value>& input,
                                                const Value& amplitude, const Rational& ratio) {
    using std::cos;
    using std::sin;
    std::vector<Vector<Value, 4>> additions(static_cast<std::size_t>(ratio.denominator));
    std::int64_t turned = 0;  // p k modulo q
    for (auto& addition : additions) {
      const Value phase = Value(2) * pi<Value> * Value(static_cast<double>(turned)) /
                          Value(static_cast<double>(ratio.denominator));
      addition =
          input.cosine * Value(amplitude * cos(phase)) + input.sine * Value(amplitude * sin(phase));
      turned = (turned + ratio.numerator) % ratio.denominator;
    }
    return additions;
  }

  std::shared_ptr<const std::vector<Vector<Value, 4>>> additions_;
  std::size_t phase_ = 0;
};

}  // namespace holdfast
