#pragma once

/// Umbrella header for the sampled-data loop: gains, zero-order hold, delay, quantisation, clock.

#include "holdfast/control/controlled_plant.hpp"
#include "holdfast/control/controller.hpp"
#include "holdfast/control/digital_loop.hpp"
#include "holdfast/control/enclosed_loop.hpp"
#include "holdfast/control/gains.hpp"
#include "holdfast/control/late_controller.hpp"
#include "holdfast/control/loop_input.hpp"
#include "holdfast/control/loop_map.hpp"
#include "holdfast/control/quantiser.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/control/sampling_clock.hpp"
#include "holdfast/control/zero_order_hold.hpp"
