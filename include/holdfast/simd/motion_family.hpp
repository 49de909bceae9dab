#pragma once

#include "holdfast/contact/hysteresis.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/excitation/forcing.hpp"
#include "holdfast/motion/forced_loop.hpp"
#include "holdfast/motion/sampled_motion.hpp"
#include "holdfast/simd/pack.hpp"

namespace holdfast::simd::detail {

/// The same loop in every lane.
inline SampledLoop<Pack<double>> in_every_lane(const SampledLoop<double>& loop) {
  using Number = Pack<double>;
  return {{Number(loop.sampling.period), Number(loop.sampling.processing_delay)},
          loop.transition.cast<Number>(),
          loop.increment.cast<Number>(),
          loop.previous_force.cast<Number>(),
          loop.present_force.cast<Number>(),
          loop.held_excitation.cast<Number>()};
}

/// A harmonic forcing that is the same in every lane.
template <class Scalar>
class SharedForcing {
 public:
  explicit SharedForcing(const HarmonicForcing<double>& forcing) : forcing_(forcing) {}
  Vector<Scalar, 4> next() { return forcing_.next().template cast<Scalar>(); }

 private:
  HarmonicForcing<double> forcing_;
};

/// Makes the motions of a loop on scalars and on packs.
/// @tparam Forcing  `PeriodicForcing` or `SharedForcing`
template <template <class> class Forcing>
struct MotionFamily {
  using Number = Pack<double>;
  template <class Scalar>
  using Motion = SampledMotion<Scalar, Backlash<Scalar>, Forcing<Scalar>>;

  SampledLoop<double> loop;
  ForcedLoop<double> parameters;
  Forcing<double> on_scalars;
  Forcing<Number> on_packs;

  Motion<double> motion(const Vector<double, 4>& initial_state) const {
    return {loop, parameters.gains, on_scalars, Backlash<double>(parameters.backlash_width),
            initial_state};
  }
  Motion<Number> motion(const Vector<Number, 4>& initial_states) const {
    const PdGains<double>& gains = parameters.gains;
    return {in_every_lane(loop),
            {Number(gains.proportional), Number(gains.differential)},
            on_packs,
            Backlash<Number>(Number(parameters.backlash_width)),
            initial_states};
  }
};

}  // namespace holdfast::simd::detail
