#pragma once

#include "holdfast/chaos/event_lyapunov.hpp"
#include "holdfast/contact/contact.hpp"
#include "holdfast/motion/real_loop.hpp"

// Compiled in hybrid_lyapunov.cpp for all files of the program.

namespace holdfast {

extern template LyapunovResult run_hybrid_lyapunov(HybridMotion<DriveContact<>>&,
                                                   const LyapunovRun&,
                                                   const std::function<void()>&);

}  // namespace holdfast
