#pragma once

/// Umbrella header for spans of overhead lines and for stay cables, both with dampers: waves,
/// damping, wind, fatigue life.

#include "holdfast/span/device/active_absorber.hpp"
#include "holdfast/span/device/dynamic_stiffness.hpp"
#include "holdfast/span/device/lumped_device.hpp"
#include "holdfast/span/device/measured_impedance.hpp"
#include "holdfast/span/device/span_device.hpp"
#include "holdfast/span/end_response.hpp"
#include "holdfast/span/life/clamp_bending.hpp"
#include "holdfast/span/life/miner_damage.hpp"
#include "holdfast/span/life/safe_border_line.hpp"
#include "holdfast/span/modes_at_places.hpp"
#include "holdfast/span/perfect_absorption.hpp"
#include "holdfast/span/span_poles.hpp"
#include "holdfast/span/span_roots.hpp"
#include "holdfast/span/wind/energy_balance.hpp"
#include "holdfast/span/wind/self_damping_law.hpp"
#include "holdfast/span/wind/turbulence.hpp"
#include "holdfast/span/wind/wind_power_law.hpp"
