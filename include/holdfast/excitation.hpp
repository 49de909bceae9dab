#pragma once

/// Umbrella header for forces on the conductor: harmonic, recorded and random forces.

#include "holdfast/excitation/band_limited_noise.hpp"
#include "holdfast/excitation/force_over_samples.hpp"
#include "holdfast/excitation/forcing.hpp"
#include "holdfast/excitation/harmonic.hpp"
#include "holdfast/excitation/harmonic_excitation.hpp"
#include "holdfast/excitation/harmonic_input.hpp"
#include "holdfast/excitation/multi_harmonic_force.hpp"
#include "holdfast/excitation/phasor_table.hpp"
#include "holdfast/excitation/recorded_force.hpp"
