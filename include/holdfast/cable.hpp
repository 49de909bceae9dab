#pragma once

/// The suspended cable: statics, elements, modes.

#include "holdfast/cable/bar_chain.hpp"
#include "holdfast/cable/catenary.hpp"
#include "holdfast/cable/chain_equilibrium.hpp"
#include "holdfast/cable/chain_modes.hpp"
#include "holdfast/cable/condensed_cable.hpp"
#include "holdfast/cable/conductor.hpp"
#include "holdfast/cable/elements.hpp"
#include "holdfast/cable/hanging_cable.hpp"
#include "holdfast/cable/irvine_statics.hpp"
#include "holdfast/cable/modes.hpp"
#include "holdfast/cable/statics.hpp"
#include "holdfast/cable/stiffness_reading.hpp"
