#pragma once

/// Umbrella header for the whole library except its adapters for Ceres, SUNDIALS and SIMD packs.

#include "holdfast/cable.hpp"
#include "holdfast/chaos.hpp"
#include "holdfast/contact.hpp"
#include "holdfast/control.hpp"
#include "holdfast/core.hpp"
#include "holdfast/excitation.hpp"
#include "holdfast/math.hpp"
#include "holdfast/motion.hpp"
#include "holdfast/orbit.hpp"
#include "holdfast/phase_space.hpp"
#include "holdfast/plant.hpp"
#include "holdfast/span.hpp"
#include "holdfast/stability.hpp"
#include "holdfast/sweep.hpp"
