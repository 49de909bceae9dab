#pragma once

/// Umbrella header for linear plants: matrices, poles, modes and responses without control.

#include "holdfast/plant/affine_dynamics.hpp"
#include "holdfast/plant/conductor_with_absorber.hpp"
#include "holdfast/plant/decaying_norm.hpp"
#include "holdfast/plant/enclosed_poles.hpp"
#include "holdfast/plant/energy.hpp"
#include "holdfast/plant/free_decay.hpp"
#include "holdfast/plant/linear_plant.hpp"
#include "holdfast/plant/loop_hardware.hpp"
#include "holdfast/plant/modal_plant.hpp"
#include "holdfast/plant/natural_modes.hpp"
#include "holdfast/plant/plant_poles.hpp"
#include "holdfast/plant/port_readings.hpp"
#include "holdfast/plant/ports.hpp"
#include "holdfast/plant/reduction.hpp"
#include "holdfast/plant/two_mass.hpp"
