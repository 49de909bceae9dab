#include "compiled_once/hybrid_orbit.hpp"

#include "compiled_once/periodic_orbit.hpp"
#include "compiled_once/sampled_loop.hpp"

namespace holdfast {

template HybridOrbitResult<SampledContactMotion> find_hybrid_orbit(
    const HybridMotion<SampledContactMotion>&, const Rational&, const OrbitLimits&);
template HybridOrbitResult<ExactDeadZone> find_hybrid_orbit(const HybridMotion<ExactDeadZone>&,
                                                            const Rational&, const OrbitLimits&);
template HybridOrbitResult<ExactBacklash> find_hybrid_orbit(const HybridMotion<ExactBacklash>&,
                                                            const Rational&, const OrbitLimits&);

}  // namespace holdfast
