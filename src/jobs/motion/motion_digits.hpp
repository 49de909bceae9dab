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

/// Most samples of a motion that are computed twice; beyond, the first ones stand for the rest.
inline constexpr std::int64_t most_compared_samples = 100'000;

/// A motion of a case, rounded once more at every sample: its z1 is moved up or down by 2⁻⁵² of the
/// largest so far. It stands for the motion in another number type where there is none.
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

/// Observer of a motion that runs the same motion beside it, in long double or rounded otherwise.
/// Displacements and velocities of both masses are compared relative to the largest so far, so that
/// passing through zero is no loss.
class MotionDigits {
 public:
  /// In long double, of a motion of the paper's model.
  /// @param loop           of the motion
  /// @param initial_state  z₀, 4 × 1 (m, m/s, m, m/s)
  /// @param kick           that run_trajectory() is given
  /// @param from           s; earlier samples are no rows of the table
  MotionDigits(const IdealLoop<double>& loop, const Vector<double, 4>& initial_state,
               const std::optional<Kick>& kick = std::nullopt, double from = 0.0);

  /// Rounded otherwise, of any motion of two masses.
  MotionDigits(const CaseMotion& motion, const std::optional<Kick>& kick, double from);

  /// Takes every sample of the motion, from the first on.
  void operator()(const MotionSample<double>& sample);

  TrustedDigits result() const;

 private:
  using Wide = long double;

  /// The difference of one sample as a share of what is large.
  Wide share_of(const Vector<double, 4>& state, const Vector<Wide, 4>& reference);

  std::variant<SampledMotion<Wide>, RoundedMotion> reference_;
  std::optional<Kick> kick_;
  double from_;
  Vector<Wide, 2> scale_ = Vector<Wide, 2>::Zero();  // largest displacement (m), velocity (m/s)
  Wide largest_ = 0.0L;                              // share
  double until_ = 0.0;
  bool lost_ = false;  // fewer digits than are taken for granted
  std::int64_t compared_ = 0;
};

/// The observer of the digits of a motion while it runs, of the samples from `from` (s) on: in long
/// double where it is of the paper's model, else rounded otherwise; nothing of a conductor by its
/// modes.
std::optional<MotionDigits> digits_beside(const MovingLoop& moving, const std::optional<Kick>& kick,
                                          double from);

/// Digits of the first `samples` samples of a motion as the event-driven flow of `built`, the same
/// loop, which is run here; 17 where nothing looks after them.
TrustedDigits trusted_digits_of_motion(const MovingLoop& moving, const BuiltLoop& built,
                                       std::int64_t samples, double from);

/// Digits of the deviation of a neighbour whose z₁ starts `offset` (m) away, relative to the
/// deviation itself; 17 as above.
TrustedDigits trusted_digits_of_deviation(const MovingLoop& moving, double offset,
                                          std::int64_t samples);

/// Digits with the largest exponent of the motion over its first samples, 10⁵ at most, where there
/// are fewer than six; of two masses under control.
TrustedDigits with_rate(TrustedDigits trusted, const MovingLoop& moving, std::int64_t samples);

/// Digits of what a reduction says of its plant: both roots, the discriminant, the largest absorber
/// mass. Throws what reduce_to_frequencies() throws.
TrustedDigits trusted_digits_of_reduction(const FrequencyReduction<double>& asked);

}  // namespace holdfast::program
