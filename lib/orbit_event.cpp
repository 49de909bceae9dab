// Explicit instantiations of orbit/event, for every contact that a loop may have.
#include "holdfast/orbit/event/event_orbit_search.hpp"

namespace holdfast {

template HybridOrbitResult<SampledContactMotion> find_hybrid_orbit(
    const HybridMotion<SampledContactMotion>&, const Rational&, const OrbitLimits&);
template HybridOrbitResult<ExactDeadZone> find_hybrid_orbit(const HybridMotion<ExactDeadZone>&,
                                                            const Rational&, const OrbitLimits&);
template HybridOrbitResult<ExactBacklash> find_hybrid_orbit(const HybridMotion<ExactBacklash>&,
                                                            const Rational&, const OrbitLimits&);

}  // namespace holdfast
