#pragma once

#include <memory>

#include "holdfast/chaos/block_spectrum.hpp"
#include "holdfast/chaos/itinerary_blocks.hpp"
#include "holdfast/chaos/lyapunov_spectrum.hpp"
#include "holdfast/control/gains.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/motion/sampled_motion.hpp"

namespace holdfast {

/// Observer of a trajectory that accumulates its Lyapunov spectrum: S where the force is
/// transmitted, S* in the backlash.
///
/// The consistent tangent comes from the loop of the motion itself. Kollár 2022 prints S and S*
/// with δ = τ beside a trajectory with δ = 0; passing the loop of δ = τ here gives the exponents of
/// Table 2.
/// @tparam Scalar  `double`, that of the loop
template <class Scalar>
class LyapunovObserver {
 public:
  /// @param tangent_loop  whose S and S* are the tangents
  /// @param gains         P (N/m) and D (N s/m) of the motion
  LyapunovObserver(const SampledLoop<Scalar>& tangent_loop, const PdGains<Scalar>& gains)
      : engine_(std::make_shared<const ItineraryBlocks>(tangent_loop, gains)) {}

  /// Takes the contact of the next sample, and nothing else of it.
  void operator()(const MotionSample<Scalar>& sample) {
    open_[0] = followed_by(open_[0], sample.engaged);
    if (!is_whole(open_[0])) return;
    engine_.push(open_);
    open_ = empty_blocks<Scalar>();
  }

  /// The spectrum over the samples seen so far, as of QR at every one of them. Reading it, however
  /// often, changes nothing.
  LyapunovSpectrum<Scalar, 5> spectrum() const { return engine_.spectrum(open_); }

 private:
  BlockSpectrum<Scalar> engine_;
  LaneBlocks<Scalar> open_ = empty_blocks<Scalar>();
};

}  // namespace holdfast
