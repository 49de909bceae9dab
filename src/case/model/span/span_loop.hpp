#pragma once

#include <vector>

#include "case/case.hpp"
#include "case/model/modal/conductor_modes.hpp"
#include "holdfast/plant/modal_plant.hpp"
#include "holdfast/plant/plant_poles.hpp"

namespace holdfast::program {

/// Poles from the drive's force to the displacement at the absorber, for a taut string with the
/// case's devices and the modes and bundles of `conductor`. Results are cached. Throws WrongInput
/// for a hanging cable or a measured device, NoAnswer if two poles nearly coincide.
std::vector<PlantPole> poles_with_devices(const Case& the_case, const ConductorModes& conductor,
                                          const Absorber<double>& absorber);

/// Whether the loop of a case's absorber and computer is stable on the string with its devices, by
/// `judged_loop_of`. Throws what judged_loop_of() throws.
bool is_stable_span(const Case& the_case);

/// Whether the control loop on a span is unstable, so that no vibration is steady. False without
/// control or absorber, and with a measured device (unknown). Throws what judged_loop_of() throws.
bool is_growing_span(const Case& the_case, bool controlled);

}  // namespace holdfast::program
