#pragma once

#include "holdfast/core/errors.hpp"
#include "holdfast/core/select.hpp"

namespace holdfast {

/// The memory of a `Backlash`: the gap in terms of Δz = z₂ − z₁, and the last relative velocity.
template <class Scalar>
struct BacklashMemory {
  Mask<Scalar> inside;       ///< whether the drive has been in its gap since the last sample
  Scalar lower,              ///< lower end of the gap, Δz (m); valid while inside
      upper;                 ///< upper end of the gap, Δz (m); valid while inside
  Scalar previous_velocity;  ///< Δż of the last sample (m/s); zero before the first one
};

/// Whether the drive may leave its gap and enter the next gap at the same sample.
enum class EntryTest {
  after_exit,  ///< no: an entry is possible from the sample after the exit on
  at_exit,     ///< yes: an entry is possible at the sample of the exit too
};

/// The backlash of the drive as a discrete-time hysteresis. It depends only on the samples of Δz =
/// z₂ − z₁ and Δż, displacement and velocity of the absorber relative to the conductor.
///
/// At every sample j, in this order:
///  1. the drive was in the gap and lower ≤ Δz ≤ upper: it stays there, no force is transmitted;
///  2. the drive was in the gap and Δz is outside [lower, upper]: it leaves the gap; the force acts
///     from this sample on, and rule 3 is not applied at this sample;
///  3. the drive was outside, Δż_{j−1} ≠ 0, and Δż_j is 0 or has the other sign: the drive reverses
///     and enters a gap of width r₀, [Δz − r₀, Δz] if Δż_{j−1} > 0, [Δz, Δz + r₀] if Δż_{j−1} < 0.
///
/// r₀ = 0 means a drive without backlash. It never enters a gap: rule 3 is not applied, as it would
/// interrupt the force for one sample at each reversal.
///
/// Source: Kollár 2022, Eqs. (7)–(8), interpreted so that the switching instants of Fig. 8 are
/// reproduced (docs/reading-the-paper.md). `Scalar` may be a scalar or a SIMD pack; a step takes
/// about 12 comparisons and selects.
/// @tparam Entry  `at_exit` changes rule 2: see ImmediateBacklash
template <class Scalar, EntryTest Entry = EntryTest::after_exit>
class Backlash {
 public:
  /// Constructs an engaged backlash before its first sample. @param width  gap width r₀ (m), ≥ 0
  explicit Backlash(const Scalar& width)
      : Backlash(width, {Scalar(0) > Scalar(0), Scalar(0), Scalar(0), Scalar(0)}) {}

  /// Constructs a backlash of width r₀ (m), ≥ 0, with the memory of an earlier one of this width.
  Backlash(const Scalar& width, const BacklashMemory<Scalar>& memory)
      : width_(width), memory_(memory) {}

  /// Processes one sample, Δz (m) and Δż (m/s). @return true where the force is then transmitted
  Mask<Scalar> step(const Scalar& relative_displacement, const Scalar& relative_velocity) {
    const Scalar zero(0);
    const Mask<Scalar> stays = memory_.inside & (relative_displacement >= memory_.lower) &
                               (relative_displacement <= memory_.upper);
    const Scalar& before = memory_.previous_velocity;
    const Mask<Scalar> from_positive = (before > zero) & (relative_velocity <= zero);
    const Mask<Scalar> from_negative = (before < zero) & (relative_velocity >= zero);
    const Mask<Scalar>& not_tested = Entry == EntryTest::at_exit ? stays : memory_.inside;
    const Mask<Scalar> enters = (!not_tested) & (width_ > zero) & (from_positive | from_negative);

    const Scalar reach_down = select(from_positive, width_, zero);
    const Scalar reach_up = width_ - reach_down;
    memory_.lower = select(enters, Scalar(relative_displacement - reach_down), memory_.lower);
    memory_.upper = select(enters, Scalar(relative_displacement + reach_up), memory_.upper);
    memory_.inside = stays | enters;
    memory_.previous_velocity = relative_velocity;
    return !memory_.inside;
  }

  /// Whether the drive has been in its gap since the last step.
  Mask<Scalar> inside() const { return memory_.inside; }
  /// The lower end of the current gap, Δz (m); valid while inside.
  const Scalar& lower() const { return memory_.lower; }
  /// The upper end of the current gap, Δz (m); valid while inside.
  const Scalar& upper() const { return memory_.upper; }
  /// Gap width r₀ (m).
  const Scalar& width() const { return width_; }
  /// The memory of the backlash; decisions at later samples depend on it and on these samples only.
  const BacklashMemory<Scalar>& memory() const { return memory_; }

 private:
  Scalar width_;
  BacklashMemory<Scalar> memory_;
};

/// The law of `Backlash`, except that a sample that leaves the gap may enter the next one.
///
/// Rule 2 of `Backlash` is changed: rule 3 is applied also to a sample j that leaves the gap. With
/// Δż_{j−1} ≠ 0 and Δż_{j−1} Δż_j ≤ 0 the drive enters the next gap without transmitting. For equal
/// memories the two laws differ only at such samples. The text of Kollár 2022 permits both laws,
/// but the switching instants of its Fig. 8 exclude `ImmediateBacklash`.
template <class Scalar>
using ImmediateBacklash = Backlash<Scalar, EntryTest::at_exit>;

/// Validates a gap width. @throws InvalidParameter unless 0 ≤ width < ∞
inline void validate_backlash_width(double width) {
  require_non_negative("backlash width r0", width, "m");
}

}  // namespace holdfast
