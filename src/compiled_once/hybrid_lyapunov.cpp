#include "compiled_once/hybrid_lyapunov.hpp"

#include "compiled_once/sampled_loop.hpp"

namespace holdfast {

template LyapunovResult run_hybrid_lyapunov(HybridMotion<DriveContact<>>&, const LyapunovRun&,
                                            const std::function<void()>&);

}  // namespace holdfast
