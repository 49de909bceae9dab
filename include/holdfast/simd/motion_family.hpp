#pragma once

#include "holdfast/contact/hysteresis.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/excitation/forcing.hpp"
#include "holdfast/motion/ideal_loop.hpp"
#include "holdfast/motion/sampled_motion.hpp"
#include "holdfast/simd/pack.hpp"

namespace holdfast::simd::detail {

/// Makes the motions of a loop on scalars and on packs.
/// @tparam Forcing  PeriodicForcing<double> or HarmonicForcing<double>
template <class Forcing>
struct MotionFamily {
  using Number = Pack<double>;
  template <class Scalar>
  using Motion = SampledMotion<Scalar, Backlash<Scalar>, SharedForcing<Scalar, Forcing>>;

  SampledLoop<double> loop;
  IdealLoop<double> parameters;
  Forcing forcing;

  template <class Scalar>
  Motion<Scalar> motion(const Vector<Scalar, 4>& initial_state) const {
    const PdGains<double>& gains = parameters.gains;
    return {converted<Scalar>(loop),
            {Scalar(gains.proportional), Scalar(gains.differential)},
            SharedForcing<Scalar, Forcing>(forcing),
            Backlash<Scalar>(Scalar(parameters.backlash_width)),
            initial_state};
  }
};

}  // namespace holdfast::simd::detail
