#include "compiled_once/hybrid_lyapunov.hpp"

#include "compiled_once/sampled_loop.hpp"

namespace holdfast {

template LyapunovResult run_hybrid_lyapunov(HybridMotion<SampledContactMotion>&, const LyapunovRun&,
                                            const std::function<void()>&);
template LyapunovResult run_hybrid_lyapunov(HybridMotion<ExactDeadZone>&, const LyapunovRun&,
                                            const std::function<void()>&);
template LyapunovResult run_hybrid_lyapunov(HybridMotion<ExactBacklash>&, const LyapunovRun&,
                                            const std::function<void()>&);

}  // namespace holdfast
