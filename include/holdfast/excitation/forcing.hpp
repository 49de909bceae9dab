#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "holdfast/core/errors.hpp"
#include "holdfast/core/rational.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/excitation/harmonic_excitation.hpp"
#include "holdfast/excitation/harmonic_input.hpp"
#include "holdfast/excitation/phasor_table.hpp"

namespace holdfast {

/// The contributions of a harmonic excitation to the plant's state, one for each sampling period j:
///
///     F_m (g_c cos ω t_j + g_s sin ω t_j),   j = 0, 1, 2, …
///
/// Work: 4 + 2 N multiply-adds per period; a cosine and a sine per `PhasorTable::block` periods.
/// @tparam States  N, the order of the plant
template <class Scalar, int States = 4>
class HarmonicForcing {
 public:
  /// @param input            responses g_c and g_s of the state per newton, N × 1
  /// @param excitation       amplitude F_m and frequency f
  /// @param sampling_period  sampling period τ (s), > 0
  HarmonicForcing(const HarmonicInput<Scalar, States>& input,
                  const HarmonicExcitation<Scalar>& excitation, const Scalar& sampling_period)
      : table_(input, excitation, sampling_period) {}

  /// Returns the contribution (N × 1) of the present period and advances to the next one.
  Vector<Scalar, States> next() {
    const std::size_t k = static_cast<std::size_t>(index_) % PhasorTable<Scalar, States>::block;
    if (k == 0) table_.turn_to(index_);
    ++index_;
    return table_.addition(k);
  }

 private:
  PhasorTable<Scalar, States> table_;
  std::int64_t index_ = 0;
};

/// The harmonic forcing of a plant of order 4, read from a PhasorTable. The table must outlive this
/// object and may be shared by several motions. The caller advances the table by its turn_to().
template <class Scalar>
class PhasorForcing {
 public:
  /// @param table  table; before each period j divisible by `block`, call table.turn_to(j)
  explicit PhasorForcing(const PhasorTable<Scalar>& table) : table_(&table) {}

  /// Returns the contribution (4 × 1) of the present period and advances to the next one.
  Vector<Scalar, 4> next() { return table_->addition(index_++ % PhasorTable<Scalar>::block); }

 private:
  const PhasorTable<Scalar>* table_;
  std::size_t index_ = 0;
};

/// A harmonic forcing that repeats every q samples: frequency f and sampling period τ have f τ =
/// p/q. The table of the q contributions to the state is shared by all copies of the object.
/// @tparam States  N, the order of the plant
template <class Value, int States = 4>
class PeriodicForcing {
 public:
  /// @param input      responses g_c and g_s of the state per newton, N × 1
  /// @param amplitude  amplitude F_m (N)
  /// @param ratio      periods of the force per sample, f τ = p/q in lowest terms (exact fraction)
  /// @throws InvalidParameter unless 1 ≤ q ≤ 10⁹
  PeriodicForcing(const HarmonicInput<Value, States>& input, const Value& amplitude,
                  const Rational& ratio)
      : PeriodicForcing(table_of(input, amplitude, ratio)) {}

  /// Constructs the forcing from its table. @param additions  the q contributions to the state
  explicit PeriodicForcing(std::vector<Vector<Value, States>> additions)
      : additions_(
            std::make_shared<const std::vector<Vector<Value, States>>>(std::move(additions))) {}

  /// Returns the contribution (N × 1) of the present period and advances to the next one.
  const Vector<Value, States>& next() {
    const Vector<Value, States>& addition = (*additions_)[phase_];
    if (++phase_ == additions_->size()) phase_ = 0;
    return addition;
  }

  /// The number q of sampling periods after which the forcing repeats.
  std::size_t samples() const { return additions_->size(); }
  /// The index, 0 … q − 1, of the contribution that next() returns next.
  std::size_t phase() const { return phase_; }
  /// The q contributions (N × 1), by their index 0 … q − 1.
  const std::vector<Vector<Value, States>>& additions() const { return *additions_; }

 private:
  static std::vector<Vector<Value, States>> table_of(const HarmonicInput<Value, States>& input,
                                                     const Value& amplitude,
                                                     const Rational& ratio) {
    using std::cos;
    using std::sin;
    require_within("denominator of f tau", static_cast<double>(ratio.denominator), "", 1.0, 1e9);
    std::vector<Vector<Value, States>> additions(static_cast<std::size_t>(ratio.denominator));
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

  std::shared_ptr<const std::vector<Vector<Value, States>>> additions_;
  std::size_t phase_ = 0;
};

}  // namespace holdfast
