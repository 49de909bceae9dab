#pragma once

#include "holdfast/chaos/event_lyapunov.hpp"
#include "holdfast/motion/real_loop.hpp"

// Compiled in hybrid_lyapunov.cpp for all files of the program, for every contact that a loop may
// have.

namespace holdfast {

extern template LyapunovResult run_hybrid_lyapunov(HybridMotion<SampledContactMotion>&,
                                                   const LyapunovRun&,
                                                   const std::function<void()>&);
extern template LyapunovResult run_hybrid_lyapunov(HybridMotion<ExactDeadZone>&, const LyapunovRun&,
                                                   const std::function<void()>&);
extern template LyapunovResult run_hybrid_lyapunov(HybridMotion<ExactBacklash>&, const LyapunovRun&,
                                                   const std::function<void()>&);

}  // namespace holdfast
