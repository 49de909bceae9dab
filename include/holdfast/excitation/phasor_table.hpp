#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "holdfast/core/lanes.hpp"
#include "holdfast/core/select.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/excitation/harmonic_excitation.hpp"
#include "holdfast/excitation/harmonic_input.hpp"

namespace holdfast {

namespace detail {

/// Computes cos 2πx and sin 2πx by Taylor's series, for a type no wider than `double`.
template <class Scalar>
ExcitationSample<Scalar> unit_phasor_series(const Scalar& x) {
  using std::floor;
  const Scalar quarters = floor(Scalar(4) * x + Scalar(0.5));
  const Scalar angle = Scalar(2 * pi<double>) * (x - Scalar(0.25) * quarters);
  const Scalar square = angle * angle;
  Scalar sine(-1.0 / 1307674368000.0), cosine(1.0 / 20922789888000.0);  // 1/15! and 1/16!
  for (const double factor : {1.0 / 6227020800.0, -1.0 / 39916800.0, 1.0 / 362880.0, -1.0 / 5040.0,
                              1.0 / 120.0, -1.0 / 6.0})
    sine = sine * square + Scalar(factor);
  for (const double factor : {-1.0 / 87178291200.0, 1.0 / 479001600.0, -1.0 / 3628800.0,
                              1.0 / 40320.0, -1.0 / 720.0, 1.0 / 24.0, -0.5})
    cosine = cosine * square + Scalar(factor);
  sine = angle + angle * (square * sine);
  cosine = Scalar(1) + square * cosine;

  const Mask<Scalar> first = quarters == Scalar(1), second = quarters == Scalar(2),
                     third = quarters == Scalar(3), odd = first | third;
  const Scalar along = select(odd, sine, cosine), across = select(odd, cosine, sine);
  return {select(first | second, Scalar(-along), along),
          select(second | third, Scalar(-across), across)};
}

}  // namespace detail

/// Computes cos 2πx and sin 2πx for scalars and SIMD packs, with an error of about 2·10⁻¹⁶. A type
/// of more digits than `double` uses its own cos and sin.
///
/// Whole quarter turns are subtracted from x without rounding. For the remaining |x| ≤ 1/8 Taylor's
/// series up to the sixteenth power has an error below 5·10⁻¹⁷. Work: 22 multiply-adds, 10
/// comparisons and selects.
/// @param x  number of cycles, 0 … 1
template <class Scalar>
ExcitationSample<Scalar> unit_phasor(const Scalar& x) {
  using Value = typename Lanes<Scalar>::Value;
  if constexpr (std::numeric_limits<Value>::digits > std::numeric_limits<double>::digits) {
    using std::cos;
    using std::sin;
    const Scalar whole = Scalar(2) * pi_of<Scalar>() * x;
    return {cos(whole), sin(whole)};
  } else {
    return detail::unit_phasor_series(x);
  }
}

/// The phasor F_m cos ω t_j, F_m sin ω t_j of a harmonic at the instants t_j = j τ of the samples
/// j = 0, 1, 2, …. A SIMD pack has one harmonic in each lane.
///
/// The phasor is computed directly at the samples J that are multiples of `block`, and by rotation
/// at the samples J + k, e^{iω(J+k)τ} = e^{iωJτ} e^{iωkτ}. Thus rounding errors do not grow with j.
template <class Scalar>
class RotatingPhasor {
 public:
  static constexpr std::size_t block = 16;  ///< number of periods that turn_to() prepares

  /// Constructs the phasor; `turn_to` is to be called before the first `at`.
  /// @param excitation       amplitude F_m and frequency f
  /// @param sampling_period  sampling period τ (s), > 0
  RotatingPhasor(const HarmonicExcitation<Scalar>& excitation, const Scalar& sampling_period)
      : amplitude_(excitation.amplitude), cycles_(excitation.frequency * sampling_period) {
    for (std::size_t k = 0; k < block; ++k) turns_[k] = turn_at(static_cast<std::int64_t>(k));
  }

  /// Prepares the `block` sampling periods from j = `index` on; `index` is a multiple of `block`.
  void turn_to(std::int64_t index) {
    const ExcitationSample<Scalar> turn = turn_at(index);
    base_ = {amplitude_ * turn.cosine, amplitude_ * turn.sine};
  }

  /// The phasor at sample `index` + k, 0 ≤ k < `block`, after turn_to(index): 4 multiply-adds.
  ExcitationSample<Scalar> at(std::size_t k) const {
    const ExcitationSample<Scalar>& turn = turns_[k];
    return {turn.cosine * base_.cosine - turn.sine * base_.sine,
            turn.cosine * base_.sine + turn.sine * base_.cosine};
  }

 private:
  /// Unit phasor at sample `index`. Whole cycles are removed first, so that `index` may be large.
  ExcitationSample<Scalar> turn_at(std::int64_t index) const {
    using std::floor;
    const Scalar turned = Scalar(static_cast<double>(index)) * cycles_;
    return unit_phasor(Scalar(turned - floor(turned)));
  }

  Scalar amplitude_;  // F_m (N)
  Scalar cycles_;     // f τ
  std::array<ExcitationSample<Scalar>, block> turns_;
  ExcitationSample<Scalar> base_{Scalar(0), Scalar(0)};
};

/// The contributions of a harmonic force to the plant's state, one for each sampling period j. In a
/// SIMD pack every lane has its own plant input, amplitude, frequency and sampling period:
///
///     F_m (g_c cos ω t_j + g_s sin ω t_j),   j = 0, 1, 2, …
/// @tparam States  N, the order of the plant
template <class Scalar, int States = 4>
class PhasorTable {
 public:
  /// Number of sampling periods that one call of turn_to() prepares.
  static constexpr std::size_t block = RotatingPhasor<Scalar>::block;

  /// Constructs the table; `turn_to` is to be called before the first `addition`.
  /// @param input            responses g_c and g_s of the state per newton, N × 1
  /// @param excitation       amplitude F_m and frequency f
  /// @param sampling_period  sampling period τ (s), > 0
  PhasorTable(const HarmonicInput<Scalar, States>& input,
              const HarmonicExcitation<Scalar>& excitation, const Scalar& sampling_period)
      : input_(input), phase_(excitation, sampling_period) {}

  /// Prepares the `block` sampling periods from j = `index` on; `index` is a multiple of `block`.
  void turn_to(std::int64_t index) { phase_.turn_to(index); }

  /// The contribution (N × 1) of sampling period `index` + k, 0 ≤ k < `block`, with the `index` of
  /// the last turn_to(). Work: 4 + 2 N multiply-adds.
  Vector<Scalar, States> addition(std::size_t k) const {
    const ExcitationSample<Scalar> now = phase_.at(k);
    return input_.cosine * now.cosine + input_.sine * now.sine;
  }

 private:
  HarmonicInput<Scalar, States> input_;
  RotatingPhasor<Scalar> phase_;
};

}  // namespace holdfast
