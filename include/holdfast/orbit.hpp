#pragma once

/// Periodic orbits, their certificates and continuation.

#include "holdfast/orbit/cyclic_system.hpp"
#include "holdfast/orbit/event/event_motion_region.hpp"
#include "holdfast/orbit/event/event_orbit.hpp"
#include "holdfast/orbit/event/event_orbit_search.hpp"
#include "holdfast/orbit/event/return_map.hpp"
#include "holdfast/orbit/itinerary_maps.hpp"
#include "holdfast/orbit/loop_orbit.hpp"
#include "holdfast/orbit/modal/modal_attraction.hpp"
#include "holdfast/orbit/modal/modal_itinerary_maps.hpp"
#include "holdfast/orbit/modal/modal_orbit_search.hpp"
#include "holdfast/orbit/motion_border.hpp"
#include "holdfast/orbit/motion_region.hpp"
#include "holdfast/orbit/orbit_continuation.hpp"
#include "holdfast/orbit/orbit_search.hpp"
#include "holdfast/orbit/periodic_orbit.hpp"
#include "holdfast/orbit/region_of_attraction.hpp"
#include "holdfast/orbit/return_search.hpp"
#include "holdfast/orbit/state_scale.hpp"
#include "holdfast/orbit/switching_borders.hpp"
