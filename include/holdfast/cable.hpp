#pragma once

/// Umbrella header for the suspended cable: static equilibrium, bar elements, natural modes.

#include "holdfast/cable/bar_chain.hpp"
#include "holdfast/cable/cable_place_modes.hpp"
#include "holdfast/cable/chain_modes.hpp"
#include "holdfast/cable/conductor.hpp"
#include "holdfast/cable/elements.hpp"
#include "holdfast/cable/hanging_cable.hpp"
#include "holdfast/cable/modes.hpp"
#include "holdfast/cable/statics.hpp"
#include "holdfast/cable/taut_string.hpp"
