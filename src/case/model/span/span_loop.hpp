#pragma once

#include <vector>

#include "case/case.hpp"
#include "case/model/modal/conductor_modes.hpp"
#include "holdfast/plant/modal_plant.hpp"
#include "holdfast/plant/plant_poles.hpp"

namespace holdfast::program {

/// The poles from the absorber's drive to its place, of a taut string with the case's devices; as
/// many modes kept apart as `conductor` has, and the rest bundled where it bundles. Those found
/// last are remembered. Throws WrongInput for a hanging cable and for a measured device, and
/// NoAnswer where two natural motions cannot be told apart.
std::vector<PlantPole> poles_with_devices(const Case& the_case, const ConductorModes& conductor,
                                          const Absorber<double>& absorber);

/// Whether the loop of a case's absorber and computer is stable on the string with its devices, by
/// `judged_loop_of`. Throws as above.
bool is_stable_span(const Case& the_case);

/// Whether the vibration of a span with its computer grows by itself, so that no steady one can be
/// told. Not without control or absorber; beside a measured device nobody knows. Throws as above.
bool is_growing_span(const Case& the_case, bool controlled);

}  // namespace holdfast::program
