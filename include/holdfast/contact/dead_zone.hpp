#pragma once

#include "holdfast/core/select.hpp"

namespace holdfast {

/// The backlash of the drive as a dead zone: a fixed gap of width r₀ about Δz = 0, with a stop at
/// each end. Δz = z₂ − z₁ is the absorber's displacement relative to the conductor. Whether a
/// sample transmits depends on this sample only. k_c and c_c: stiffness and damping of a stop.
///
///     side σ = +1 for Δz > r₀/2, −1 for Δz < −r₀/2, 0 for −r₀/2 ≤ Δz ≤ r₀/2
///     the control force is transmitted where σ ≠ 0
///     the stop adds f = k_c (Δz − σ r₀/2) + c_c Δż where σ ≠ 0 (`dynamics_on_stop`)
///
/// f acts like the plant's spring k₂ and damper c₂: +f on the conductor, −f on the absorber. Its
/// elastic part is continuous in Δz. The damper's part jumps by c_c Δż at the ends of the gap.
/// Unlike a real stop, f pulls during separation where c_c |Δż| > k_c (|Δz| − r₀/2).
///
/// r₀ = 0 means no gap: σ is never 0 (it is +1 at Δz = 0), the force is always transmitted and the
/// stops are a spring and a damper between the masses.
///
/// Source: Shaw and Holmes, A periodically forced piecewise linear oscillator, Journal of Sound and
/// Vibration 90 (1983); Nordin and Gutman, Controlling mechanical systems with backlash – a survey,
/// Automatica 38 (2002), which compares the dead zone with and without damping to other models.
template <class Scalar>
class DeadZone {
 public:
  /// Constructs a dead zone before its first sample. @param width  gap width r₀ (m), ≥ 0
  explicit DeadZone(const Scalar& width)
      : width_(width),
        half_width_(width / Scalar(2)),
        touched_side_(0),
        inside_(Scalar(0) > Scalar(0)) {}

  /// Processes one sample of the relative displacement Δz (m); Δż is not used.
  /// @return true where the control force is transmitted until the next sample
  Mask<Scalar> step(const Scalar& relative_displacement, const Scalar& /*relative_velocity*/) {
    touched_side_ = side(relative_displacement);
    inside_ = !((touched_side_ > Scalar(0)) | (touched_side_ < Scalar(0)));
    return !inside_;
  }

  /// The side σ of the stop touched at Δz (m): −1 lower, +1 upper, 0 none.
  Scalar side(const Scalar& relative_displacement) const {
    const Scalar zero(0), one(1);
    const Mask<Scalar> closed = !(width_ > zero);
    const Mask<Scalar> at_upper =
        (relative_displacement > half_width_) | (closed & (relative_displacement >= half_width_));
    const Mask<Scalar> at_lower = relative_displacement < -half_width_;
    return select(at_upper, one, select(at_lower, Scalar(-one), zero));
  }

  /// Whether Δz was in the gap at the last step; false before the first step.
  Mask<Scalar> inside() const { return inside_; }
  /// Side σ of the stop touched at the last step: −1, +1 or 0 for none; 0 before the first step.
  const Scalar& touched_side() const { return touched_side_; }

 private:
  Scalar width_;
  Scalar half_width_;
  Scalar touched_side_;
  Mask<Scalar> inside_;
};

}  // namespace holdfast
