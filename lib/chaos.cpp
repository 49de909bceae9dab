// Explicit instantiations of chaos for double, for every contact that a loop may have.
#include "holdfast/chaos/event_classification.hpp"
#include "holdfast/chaos/event_lyapunov.hpp"
#include "holdfast/chaos/sampled_classification.hpp"

namespace holdfast {

template LyapunovResult run_hybrid_lyapunov(HybridMotion<SampledContactMotion>&, const LyapunovRun&,
                                            const std::function<void()>&);
template LyapunovResult run_hybrid_lyapunov(HybridMotion<ExactDeadZone>&, const LyapunovRun&,
                                            const std::function<void()>&);
template LyapunovResult run_hybrid_lyapunov(HybridMotion<ExactBacklash>&, const LyapunovRun&,
                                            const std::function<void()>&);

template MotionVerdict classify_motion(const ForcedLoop<double>&, const Vector<double, 4>&,
                                       const OrbitLimits&);
template HybridVerdict classify_motion(const RealLoop&, const Vector<double, 4>&,
                                       const OrbitLimits&);

}  // namespace holdfast
