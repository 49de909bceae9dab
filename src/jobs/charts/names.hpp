#pragma once

#include "holdfast/stability/boundary/boundary_point.hpp"
#include "holdfast/stability/chart/loop_chart.hpp"
#include "holdfast/stability/chart/proved_chart.hpp"
#include "text/names.hpp"

namespace holdfast::program {

/// Names of the boundary curves in tables.
inline constexpr Named<BoundaryCurve> curve_names[] = {
    {BoundaryCurve::plus_one, "plus_one"},
    {BoundaryCurve::minus_one, "minus_one"},
    {BoundaryCurve::complex_pair, "complex_pair"},
    {BoundaryCurve::zero, "zero"},
    {BoundaryCurve::imaginary_pair, "imaginary_pair"}};

/// Case keys of the parameters that stability depends on.
inline constexpr Named<LoopParameter> parameter_keys[] = {
    {LoopParameter::proportional_gain, "control.proportional_gain"},
    {LoopParameter::differential_gain, "control.differential_gain"},
    {LoopParameter::sampling_period, "control.sampling_period"},
    {LoopParameter::processing_delay, "control.processing_delay"},
    {LoopParameter::conductor_mass, "plant.conductor_mass"},
    {LoopParameter::conductor_stiffness, "plant.conductor_stiffness"},
    {LoopParameter::conductor_damping, "plant.conductor_damping"},
    {LoopParameter::absorber_mass, "plant.absorber_mass"},
    {LoopParameter::absorber_stiffness, "plant.absorber_stiffness"},
    {LoopParameter::absorber_damping, "plant.absorber_damping"}};

/// Names of the results of stability proofs, in tables.
inline constexpr Named<ProvedStability> proved_names[] = {
    {ProvedStability::stable, "stable"},
    {ProvedStability::unstable, "unstable"},
    {ProvedStability::undecided, "undecided"}};

}  // namespace holdfast::program
