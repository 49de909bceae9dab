#pragma once

/// Umbrella header for basins of attraction, Poincaré sections and orbit diagrams.

#include "holdfast/phase_space/attractor_set.hpp"
#include "holdfast/phase_space/basins.hpp"
#include "holdfast/phase_space/coverage.hpp"
#include "holdfast/phase_space/deviation.hpp"
#include "holdfast/phase_space/event_basins.hpp"
#include "holdfast/phase_space/lane_scheduler.hpp"
#include "holdfast/phase_space/modal_basins.hpp"
#include "holdfast/phase_space/motion_batch.hpp"
#include "holdfast/phase_space/motion_map.hpp"
#include "holdfast/phase_space/orbit_diagram.hpp"
#include "holdfast/phase_space/section.hpp"
