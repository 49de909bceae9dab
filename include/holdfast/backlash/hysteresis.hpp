#pragma once

#include "holdfast/core/errors.hpp"
#include "holdfast/core/select.hpp"

namespace holdfast {

/// Backlash of the drive, as a hysteresis that steps on sampled Δz = z₂ − z₁ and Δż = ż₂ − ż₁
/// alone.
///
/// At every sample j, in this order:
///  1. inside the gap with lower ≤ Δz ≤ upper: stay inside, no force is transmitted;
///  2. inside the gap with Δz outside it: leave; the force acts again from this sample on, and
///  entry is not
///     tested at this same sample;
///  3. outside, Δż_{j−1} ≠ 0 and Δż changed its sign or became zero since: the drive reverses and
///  enters the
///     gap [Δz − r₀, Δz] if Δż_{j−1} > 0, [Δz, Δz + r₀] if Δż_{j−1} < 0.
///
/// r₀ = 0 means a drive without backlash: it never enters. (The rule itself would drop the force
/// for one sample at each reversal however small r₀ is.)
///
/// Source: Kollár 2022, Eqs. (7)–(8), read so that Fig. 8's switching instants come out
/// (docs/reading-the-paper.md). One kernel for scalars and SIMD packs: about 12 comparisons and
/// selects.
template <class Scalar>
class Backlash {
 public:
  /// @param width  r₀ (m), ≥ 0
  explicit Backlash(const Scalar& width)
      : width_(width),
        lower_(0),
        upper_(0),
        previous_velocity_(0),
        inside_(Scalar(0) > Scalar(0)) {}

  /// Takes in one sample. @return true where the force is transmitted during the coming period
  Mask<Scalar> step(const Scalar& relative_displacement, const Scalar& relative_velocity) {
    const Scalar zero(0);
    const Mask<Scalar> stays =
        inside_ & (relative_displacement >= lower_) & (relative_displacement <= upper_);
    const Mask<Scalar> from_positive = (previous_velocity_ > zero) & (relative_velocity <= zero);
    const Mask<Scalar> from_negative = (previous_velocity_ < zero) & (relative_velocity >= zero);
    const Mask<Scalar> enters = (!inside_) & (width_ > zero) & (from_positive | from_negative);

    const Scalar reach_down = select(from_positive, width_, zero);
    lower_ = select(enters, Scalar(relative_displacement - reach_down), lower_);
    upper_ = select(enters, Scalar(relative_displacement + (width_ - reach_down)), upper_);
    inside_ = stays | enters;
    previous_velocity_ = relative_velocity;
    return !inside_;
  }

  /// True where the drive is in its gap since the last step.
  Mask<Scalar> inside() const { return inside_; }
  /// Lower end of the current gap, Δz in m; meaningful while inside.
  const Scalar& lower() const { return lower_; }
  /// Upper end of the current gap, Δz in m; meaningful while inside.
  const Scalar& upper() const { return upper_; }
  /// r₀ (m).
  const Scalar& width() const { return width_; }

 private:
  Scalar width_;
  Scalar lower_;
  Scalar upper_;
  Scalar previous_velocity_;  // zero before the first sample, so that j = 0 cannot enter
  Mask<Scalar> inside_;
};

/// @throws InvalidParameter unless 0 ≤ width < ∞
inline void validate_backlash_width(double width) {
  require_non_negative("backlash width r0", width, "m");
}

}  // namespace holdfast
