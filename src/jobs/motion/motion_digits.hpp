#pragma once

#include <cstdint>
#include <optional>
#include <variant>

#include "case/case.hpp"
#include "case/model/moving_loop.hpp"
#include "holdfast/motion/ideal_loop.hpp"
#include "holdfast/motion/trajectory.hpp"
#include "holdfast/plant/reduction.hpp"
#include "jobs/motion/case_motion.hpp"
#include "output/trusted_digits.hpp"

namespace holdfast::program {

/// Largest number of samples, from the first on, that are compared to find the trusted digits.
inline constexpr std::int64_t most_compared_samples = 100'000;

/// Motion of a case with one more rounding error per sample: z1 is moved up or down by 2⁻⁵² of the
/// largest |z1| so far. It is the reference where the motion cannot be computed in long double.
class RoundedMotion {
 public:
  explicit RoundedMotion(const CaseMotion& motion) : motion_(motion) {}

  EventSample sense();
  void advance() { motion_.advance(); }
  void displace_conductor(double by) { motion_.displace_conductor(by); }

 private:
  CaseMotion motion_;
  double largest_ = 0.0;  // |z1|, m
};

/// Observer that finds the trusted digits of a motion: it compares the states with a reference, the
/// same motion in long double or with other rounding errors. Differences are relative to the
/// largest displacement or velocity so far, so that zero crossings do not reduce the digits.
class MotionDigits {
 public:
  /// Observer with a reference in long double, for a motion of the paper's model.
  /// @param loop           loop of the motion
  /// @param initial_state  z₀, 4 × 1 (m, m/s, m, m/s)
  /// @param kick           kick given to run_trajectory()
  /// @param from           time (s) before which differences do not count
  MotionDigits(const IdealLoop<double>& loop, const Vector<double, 4>& initial_state,
               const std::optional<Kick>& kick = std::nullopt, double from = 0.0);

  /// Observer with a reference with other rounding errors, for any motion of two masses.
  MotionDigits(const CaseMotion& motion, const std::optional<Kick>& kick, double from);

  /// Compares one sample; must be called for every sample from the first on.
  void operator()(const MotionSample<double>& sample);

  TrustedDigits result() const;

 private:
  using Wide = long double;

  /// Difference of one sample as a share of the largest values so far.
  Wide share_of(const Vector<double, 4>& state, const Vector<Wide, 4>& reference);

  std::variant<SampledMotion<Wide>, RoundedMotion> reference_;
  std::optional<Kick> kick_;
  double from_;
  Vector<Wide, 2> scale_ = Vector<Wide, 2>::Zero();  // largest displacement (m), velocity (m/s)
  Wide largest_ = 0.0L;                              // share
  double until_ = 0.0;
  bool lost_ = false;  // fewer digits than digits_taken_for_granted
  std::int64_t compared_ = 0;
};

/// Observer of the trusted digits of a motion from the time `from` (s) on. Reference: long double
/// for the paper's model, else other rounding errors. nullopt for plants other than two masses.
std::optional<MotionDigits> digits_beside(const MovingLoop& moving, const std::optional<Kick>& kick,
                                          double from);

/// Trusted digits of the first `samples` samples of a motion; differences before `from` (s) do not
/// count. The motion is computed here by events, from `built`. 17 digits where there is no check.
TrustedDigits trusted_digits_of_motion(const MovingLoop& moving, const BuiltLoop& built,
                                       std::int64_t samples, double from);

/// Trusted digits of the difference between two motions whose z₁ initially differs by `offset` (m);
/// 17 digits where it cannot be checked.
TrustedDigits trusted_digits_of_deviation(const MovingLoop& moving, double offset,
                                          std::int64_t samples);

/// Trusted digits of the results of a reduction: both roots, discriminant, largest absorber mass.
/// Throws what reduce_to_frequencies() throws.
TrustedDigits trusted_digits_of_reduction(const FrequencyReduction<double>& asked);

}  // namespace holdfast::program
