#pragma once

/// Motions of the loop: sampled map and event-driven flow.

#include "holdfast/motion/dense_output.hpp"
#include "holdfast/motion/divergence.hpp"
#include "holdfast/motion/event_motion.hpp"
#include "holdfast/motion/ideal_loop.hpp"
#include "holdfast/motion/implemented_loop.hpp"
#include "holdfast/motion/instant.hpp"
#include "holdfast/motion/modal/modal_deviations.hpp"
#include "holdfast/motion/modal/modal_motion.hpp"
#include "holdfast/motion/modal/natural_motions.hpp"
#include "holdfast/motion/mode_motion.hpp"
#include "holdfast/motion/next_event.hpp"
#include "holdfast/motion/no_event_bound.hpp"
#include "holdfast/motion/observers.hpp"
#include "holdfast/motion/saltation.hpp"
#include "holdfast/motion/sampled_motion.hpp"
#include "holdfast/motion/subinterval_step.hpp"
#include "holdfast/motion/taylor_step.hpp"
#include "holdfast/motion/trajectory.hpp"
#include "holdfast/motion/variational_flow.hpp"
