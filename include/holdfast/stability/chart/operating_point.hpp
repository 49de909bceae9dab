#pragma once

#include "holdfast/control/gains.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/plant/two_mass.hpp"

namespace holdfast {

/// Everything that decides the stability of a sampled loop.
struct OperatingPoint {
  TwoMass<double> plant;      ///< m (kg), k (N/m) and c (N s/m) of both masses
  Sampling<double> sampling;  ///< τ (s) and δ (s)
  PdGains<double> gains;      ///< P (N/m) and D (N s/m)
};

/// The one number of a loop that an axis of a chart varies.
enum class LoopParameter {
  proportional_gain,    ///< P (N/m)
  differential_gain,    ///< D (N s/m)
  sampling_period,      ///< τ (s), > 0; the processing delay keeps its fraction of it
  processing_delay,     ///< δ (s), 0 … τ
  conductor_mass,       ///< m₁ (kg), > 0
  conductor_stiffness,  ///< k₁ (N/m), > 0
  conductor_damping,    ///< c₁ (N s/m), ≥ 0
  absorber_mass,        ///< m₂ (kg), > 0
  absorber_stiffness,   ///< k₂ (N/m), > 0
  absorber_damping,     ///< c₂ (N s/m), ≥ 0
};

/// True for P and D, in which the characteristic polynomial is affine; any other parameter needs a
/// matrix exponential for each of its values.
constexpr bool is_gain(LoopParameter parameter) {
  return parameter == LoopParameter::proportional_gain ||
         parameter == LoopParameter::differential_gain;
}

/// Gives a parameter a value.
inline void set(OperatingPoint& point, LoopParameter parameter, double value) {
  switch (parameter) {
    case LoopParameter::proportional_gain:
      point.gains.proportional = value;
      return;
    case LoopParameter::differential_gain:
      point.gains.differential = value;
      return;
    case LoopParameter::sampling_period:
      point.sampling.processing_delay *= value / point.sampling.period;
      point.sampling.period = value;
      return;
    case LoopParameter::processing_delay:
      point.sampling.processing_delay = value;
      return;
    case LoopParameter::conductor_mass:
      point.plant.conductor_mass = value;
      return;
    case LoopParameter::conductor_stiffness:
      point.plant.conductor_stiffness = value;
      return;
    case LoopParameter::conductor_damping:
      point.plant.conductor_damping = value;
      return;
    case LoopParameter::absorber_mass:
      point.plant.absorber_mass = value;
      return;
    case LoopParameter::absorber_stiffness:
      point.plant.absorber_stiffness = value;
      return;
    case LoopParameter::absorber_damping:
      point.plant.absorber_damping = value;
      return;
  }
}

}  // namespace holdfast
