#pragma once

#include "holdfast/core/select.hpp"

namespace holdfast {

/// The backlash of the drive as the play operator of width r₀ on the sampled Δz = z₂ − z₁, the
/// absorber's displacement relative to the conductor. Its output y (m) changes only if Δz leaves
/// the gap of half-width r₀/2 about y:
///
///     y_j = max(Δz_j − r₀/2, min(Δz_j + r₀/2, y_{j−1}))
///     the force is transmitted from sample j on where y_j ≠ y_{j−1}
///
/// The gap y − r₀/2 ≤ Δz ≤ y + r₀/2 includes its ends: y_j ≠ y_{j−1} only where Δz_j lies outside
/// the gap of y_{j−1}.
///
/// Before the first sample y is unknown. The force is transmitted up to and including the first
/// sample with Δż ≠ 0, which sets y = Δz − r₀/2 for Δż > 0, y = Δz + r₀/2 for Δż < 0. Motion that
/// continues in this direction transmits; reversed motion first crosses the gap. Later Δż has no
/// effect.
///
/// The gap after a reversal is [Δz_max − r₀, Δz_max] or [Δz_min, Δz_min + r₀], where Δz_max or
/// Δz_min is the extreme sample. `Backlash` instead uses Δz of the first sample after the change of
/// sign of Δż, whether or not it is extreme. Where Δz crosses the whole gap within one sampling
/// period, the force is transmitted without a pause. With r₀ = 0 the drive always transmits.
///
/// Source: Krasnosel'skii and Pokrovskii, Systems with Hysteresis, Springer 1989; Visintin,
/// Differential Models of Hysteresis, Springer 1994; Macki, Nistri and Zecca, Mathematical models
/// for hysteresis, SIAM Review 35 (1993). `Scalar` may be a scalar or a SIMD pack.
template <class Scalar>
class PlayBacklash {
 public:
  /// Constructs the play before its first sample. @param width  gap width r₀ (m), ≥ 0
  explicit PlayBacklash(const Scalar& width) : width_(width), half_width_(width / Scalar(2)) {}

  /// Processes one sample, Δz (m) and Δż (m/s). @return true where the force is then transmitted
  Mask<Scalar> step(const Scalar& relative_displacement, const Scalar& relative_velocity) {
    const Scalar zero(0);
    const Mask<Scalar> undecided = !decided_, moves_up = relative_velocity > zero;
    const Scalar behind = select(moves_up, Scalar(relative_displacement - half_width_),
                                 Scalar(relative_displacement + half_width_));
    const Scalar before = select(undecided, behind, far_side_);
    const Scalar least = relative_displacement - half_width_;
    const Scalar largest = relative_displacement + half_width_;
    const Scalar not_above = select(before > largest, largest, before);
    const Scalar after = select(not_above < least, least, not_above);
    // The outer branches are strict, so a far side that was pushed is another number than before.
    const Mask<Scalar> is_pushed = (after > before) | (after < before);

    far_side_ = after;
    decided_ = decided_ | moves_up | (relative_velocity < zero);
    inside_ = (width_ > zero) & !(undecided | is_pushed);
    return !inside_;
  }

  /// Whether no force has been transmitted since the last step.
  Mask<Scalar> inside() const { return inside_; }
  /// The lower end of the current gap, Δz = y − r₀/2 (m); valid once y is determined.
  Scalar lower() const { return far_side_ - half_width_; }
  /// The upper end of the current gap, Δz = y + r₀/2 (m); valid once y is determined.
  Scalar upper() const { return far_side_ + half_width_; }
  /// Gap width r₀ (m).
  const Scalar& width() const { return width_; }

 private:
  Scalar width_;
  Scalar half_width_;
  Mask<Scalar> inside_ = Scalar(0) > Scalar(0);   // transmits nothing since the last sample
  Mask<Scalar> decided_ = Scalar(0) > Scalar(0);  // some sample had Δż ≠ 0
  Scalar far_side_ = Scalar(0);  // y, the far side on the scale of Δz (m); once decided
};

}  // namespace holdfast
