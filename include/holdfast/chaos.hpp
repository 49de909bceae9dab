#pragma once

/// Umbrella header for Lyapunov exponents, indicators of chaos and the classification of motions.

#include "holdfast/chaos/block_spectrum.hpp"
#include "holdfast/chaos/chaos_indicators.hpp"
#include "holdfast/chaos/classification.hpp"
#include "holdfast/chaos/event_lyapunov.hpp"
#include "holdfast/chaos/itinerary_blocks.hpp"
#include "holdfast/chaos/lyapunov_run.hpp"
#include "holdfast/chaos/lyapunov_spectrum.hpp"
#include "holdfast/chaos/modal_classification.hpp"
#include "holdfast/chaos/modal_lyapunov.hpp"
#include "holdfast/chaos/motion_classification.hpp"
#include "holdfast/chaos/neighbour_distance.hpp"
#include "holdfast/chaos/recurrence.hpp"
#include "holdfast/chaos/switching_complexity.hpp"
#include "holdfast/chaos/zero_one_test.hpp"
