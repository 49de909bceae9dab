#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "holdfast/excitation/harmonic.hpp"
#include "holdfast/excitation/harmonic_excitation.hpp"
#include "holdfast/excitation/recorded_force.hpp"

namespace holdfast {

namespace detail {

/// Adds lengthᵏ dᵏ/dtᵏ F cos(ω t + φ) at `time` to coefficient k, for all k:
///
///     (ω length)ᵏ (c, −s, −c, s, …),   c, s = F cos, F sin of ω time + φ
template <class Coefficients>
void add_scaled_derivatives(const Harmonic& harmonic, double time, double length,
                            Eigen::MatrixBase<Coefficients>& coefficients) {
  const double angle = harmonic.angle(time);
  const double turn = harmonic.angular_frequency() * length;
  double present = harmonic.amplitude * std::cos(angle);
  double next = -harmonic.amplitude * std::sin(angle) * turn;
  for (Eigen::Index k = 0; k < coefficients.size(); ++k) {
    coefficients[k] += present;
    const double after_next = -turn * turn * present;
    present = next;
    next = after_next;
  }
}

/// Divides the coefficient of each index k by k!.
template <class Coefficients>
void divide_by_factorials(Eigen::MatrixBase<Coefficients>& coefficients) {
  double inverse_factorial = 1.0;
  for (Eigen::Index k = 2; k < coefficients.size(); ++k) {
    // The reciprocals of k do not depend on each other. Divisions of the running value would each
    // wait for the one before.
    inverse_factorial *= 1.0 / static_cast<double>(k);
    coefficients[k] *= inverse_factorial;
  }
}

}  // namespace detail

/// The force F(t) = Σ_i F_i cos(2π f_i t + φ_i) + F_r(t): any number of harmonics, such as those of
/// band-limited noise, and at most one recorded force.
struct MultiHarmonicForce {
  std::vector<Harmonic> harmonics;              ///< harmonics F_i, f_i, φ_i; may be empty
  std::shared_ptr<const RecordedForce> record;  ///< recorded force F_r; null: none

  /// The force F (N) at a time (s), continuous from the right.
  double at(double time) const {
    double force = record ? record->at(time) : 0.0;
    for (const Harmonic& harmonic : harmonics) force += harmonic.at(time);
    return force;
  }

  /// The first instant (s) after `time` (s) at which F may jump or kink; +∞ if there is none.
  double next_break(double time) const {
    return record ? record->next_break(time) : std::numeric_limits<double>::infinity();
  }

  /// Largest angular frequency 2π f_i (rad/s) of the harmonics; 0 without harmonics.
  double highest_angular_frequency() const {
    double highest = 0.0;
    for (const Harmonic& harmonic : harmonics) {
      highest = std::max(highest, harmonic.angular_frequency());
    }
    return highest;
  }

  /// Computes the Taylor coefficients f_k, k = 0 … size − 1, of the force just after an instant:
  ///
  ///     F(time + x length) = Σ_k f_k xᵏ      for 0 ≤ x length < next_break(time) − time
  ///     f_k = lengthᵏ/k! Σ_i ω_iᵏ F_i cos(ω_i time + φ_i + k π/2),   ω_i = 2π f_i
  ///
  /// The recorded force is piecewise linear and adds to f_0 and f_1. For 0 ≤ x ≤ 1 the omitted
  /// terms k ≥ n = size sum up to at most Σ_i F_i (ω_i length)ⁿ/n!. Work: a cosine, a sine and 3 n
  /// multiply-adds per harmonic, and a binary search in the record.
  /// @param time          instant (s)
  /// @param length        time (s) for x = 1; up to about 1/ω_i the series converges fast
  /// @param coefficients  output: f_k (N), a vector of fixed or dynamic size
  template <class Coefficients>
  void expand(double time, double length, Eigen::MatrixBase<Coefficients>& coefficients) const {
    static_assert(Coefficients::IsVectorAtCompileTime, "the coefficients must be a vector");
    coefficients.setZero();
    for (const Harmonic& harmonic : harmonics) {
      detail::add_scaled_derivatives(harmonic, time, length, coefficients);
    }
    detail::divide_by_factorials(coefficients);
    if (!record) return;
    const LinearPiece piece = record->piece(time);
    if (coefficients.size() > 0) coefficients[0] += piece.value;
    if (coefficients.size() > 1) coefficients[1] += piece.slope * length;
  }
};

/// The force F_m cos(2π f t) of a harmonic excitation, without a recorded force.
inline MultiHarmonicForce multi_harmonic_force(const HarmonicExcitation<double>& excitation) {
  return {{Harmonic{excitation.amplitude, excitation.frequency}}, nullptr};
}

/// Validates a force; the record was checked by its constructor.
/// @throws InvalidParameter unless every harmonic is admissible
inline void validate(const MultiHarmonicForce& force) {
  for (const Harmonic& harmonic : force.harmonics) validate(harmonic);
}

}  // namespace holdfast
