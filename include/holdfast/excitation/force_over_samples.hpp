#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "holdfast/core/types.hpp"
#include "holdfast/excitation/harmonic_excitation.hpp"
#include "holdfast/excitation/harmonic_input.hpp"
#include "holdfast/excitation/multi_harmonic_force.hpp"
#include "holdfast/excitation/phasor_table.hpp"
#include "holdfast/math/roots/series.hpp"

namespace holdfast {

/// Upper bounds, over all times, of a force and its first and second time derivatives.
struct ForceBounds {
  double value,     ///< bound of |F| (N)
      rate,         ///< bound of |Ḟ| (N/s)
      second_rate;  ///< bound of |F̈| (N/s²)
};

/// An instant at a fixed time after every sample, with precomputed cosines and sines of harmonics.
struct PeriodInstant {
  double after;  ///< time after the sample (s)
  /// Cosine and sine of the angle ω_l · `after` + φ_l of each harmonic l.
  std::vector<ExcitationSample<double>> turned;
};

/// The excitation force F in each sampling period, as a function of the time since the sample. It
/// is held at its value at the sample or follows F(t) (`ForceHold`).
class ForceOverSamples {
 public:
  /// @param force            excitation F(t), admissible
  /// @param hold             `sampled`: F, also its record, is held between samples; `exact`: F(t)
  /// @param sampling_period  sampling period τ (s), > 0
  ForceOverSamples(const MultiHarmonicForce& force, ForceHold hold, double sampling_period)
      : force_(force), hold_(hold) {
    if (hold == ForceHold::sampled) return;
    for (const Harmonic& line : force.harmonics)
      turning_.emplace_back(HarmonicExcitation<double>{line.amplitude, line.frequency},
                            sampling_period);
    phases_.resize(turning_.size());
  }

  /// Starts the sampling period of sample j = `index` at t_j = `time` (s); call it at every sample.
  void begin_sample(std::int64_t index, double time) {
    time_ = time;
    if (hold_ == ForceHold::sampled) {
      held_ = force_.at(time);
      return;
    }
    const std::size_t k = static_cast<std::size_t>(index) % RotatingPhasor<double>::block;
    for (std::size_t l = 0; l < turning_.size(); ++l) {
      if (k == 0 || index != last_ + 1) turning_[l].turn_to(index - static_cast<std::int64_t>(k));
      phases_[l] = turning_[l].at(k);
    }
    last_ = index;
  }

  /// The force F (N) at t_j + `after` (s), which must precede the next sample.
  double at(double after) const {
    return hold_ == ForceHold::sampled ? held_ : force_.at(time_ + after);
  }

  /// Prepares the instant `after` (s) after every sample for at(const PeriodInstant&).
  PeriodInstant instant(double after) const {
    PeriodInstant instant{after, {}};
    for (const Harmonic& line : force_.harmonics) {
      const double angle = line.angular_frequency() * after + line.phase;
      instant.turned.push_back({std::cos(angle), std::sin(angle)});
    }
    return instant;
  }

  /// The force F (N) at a prepared instant, by two multiply-adds per harmonic. It is valid only
  /// without jitter; otherwise call at(double).
  double at(const PeriodInstant& instant) const {
    if (hold_ == ForceHold::sampled) return held_;
    if (force_.record) return force_.at(time_ + instant.after);
    double sum = 0.0;
    for (std::size_t l = 0; l < phases_.size(); ++l)
      sum +=
          instant.turned[l].cosine * phases_[l].cosine - instant.turned[l].sine * phases_[l].sine;
    return sum;
  }

  /// The force (N) that is held over the sampling period; 0 if the force is not held.
  double held() const { return hold_ == ForceHold::sampled ? held_ : 0.0; }

  /// The phasors F_l cos(ω_l j τ), F_l sin(ω_l j τ) of all harmonics l, without their phases φ_l,
  /// at sample j; empty if the force is held.
  const std::vector<ExcitationSample<double>>& phases() const { return phases_; }

  /// Whether `held()` and `phases()` give the whole force; false only if a record is not held.
  bool is_regular() const { return hold_ == ForceHold::sampled || !force_.record; }

  /// Computes the Taylor coefficients F_k (N) of F(t_j + after + x length) = Σ_k F_k xᵏ. The times
  /// `after` and `length` are in s.
  void expand(double after, double length, Series& coefficients) const {
    if (hold_ == ForceHold::exact) return force_.expand(time_ + after, length, coefficients);
    coefficients.setZero();
    coefficients[0] = held_;
  }

  /// The first time after the sample (s), later than `after`, at which the force may jump or kink
  /// because of its record; +∞ if there is none or the force is held.
  double next_break(double after) const {
    if (hold_ == ForceHold::sampled || !force_.record)
      return std::numeric_limits<double>::infinity();
    const double length = force_.next_break(time_ + after) - time_;
    return length > after ? length : std::nextafter(after, std::numeric_limits<double>::infinity());
  }

  /// Largest angular frequency ω (rad/s) of the harmonics; 0 where the force is held.
  double highest_angular_frequency() const {
    return hold_ == ForceHold::exact ? force_.highest_angular_frequency() : 0.0;
  }

  /// The bounds of F and its derivatives; those of the derivatives are valid only if is_regular().
  ForceBounds bounds() const {
    ForceBounds bounds{0.0, 0.0, 0.0};
    const double rate = hold_ == ForceHold::exact ? 1.0 : 0.0;
    for (const Harmonic& line : force_.harmonics) {
      const double omega = rate * line.angular_frequency();
      bounds.value += line.amplitude;
      bounds.rate += omega * line.amplitude;
      bounds.second_rate += omega * omega * line.amplitude;
    }
    if (!force_.record) return bounds;
    double largest = 0.0;
    for (const double row : force_.record->forces()) largest = std::max(largest, std::abs(row));
    bounds.value += largest;
    return bounds;
  }

 private:
  MultiHarmonicForce force_;
  ForceHold hold_;
  std::vector<RotatingPhasor<double>> turning_;
  std::vector<ExcitationSample<double>> phases_;
  double time_ = 0.0, held_ = 0.0;
  std::int64_t last_ = -1;
};

}  // namespace holdfast
