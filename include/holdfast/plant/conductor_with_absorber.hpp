#pragma once

#include <complex>
#include <vector>

#include "holdfast/plant/loop_hardware.hpp"
#include "holdfast/plant/modal_plant.hpp"
#include "holdfast/plant/plant_poles.hpp"
#include "holdfast/plant/ports.hpp"

namespace holdfast {

/// A conductor given by its modes, an absorber, the poles of both together and the hardware lags.
struct ConductorWithAbsorber {
  std::vector<PlaceMode<double>> modes;  ///< modes at the absorber's place
  Absorber<double> absorber;             ///< absorber with its clamp
  std::vector<PlantPole> poles;  ///< `plant_poles` of both together; empty if not all were found
  LoopHardware hardware = {};    ///< measurement filter and drive
  bool has_devices = false;      ///< whether the poles include devices on the span
};

/// Whether the loop of a `ConductorWithAbsorber` is analysed in closed form: no, by its poles.
template <>
inline constexpr bool has_closed_forms<ConductorWithAbsorber> = false;

/// The receptance z/F (m/N) at the absorber's place, without control, at s (1/s, unchecked).
inline std::complex<double> place_receptance(const ConductorWithAbsorber& conductor,
                                             const std::complex<double>& s) {
  if (!conductor.has_devices)
    return place_response(receptance(conductor.modes, s), conductor.absorber, s).to_force;
  std::complex<double> to_drive(0.0);
  for (const PlantPole& pole : conductor.poles) to_drive += pole.residue / (s - pole.s);
  return to_drive / detail::transmitted_share(conductor.absorber, s);
}

/// The linear plant of conductor, absorber and hardware: order 2N + 2 plus the hardware's states.
/// @param conductor  conductor with its absorber and hardware; its poles are not used
/// @throws InvalidParameter where modes, absorber or hardware are inadmissible, or if has_devices
template <class Scalar = double>
LinearPlant<Scalar> linear_plant(const ConductorWithAbsorber& conductor) {
  if (conductor.has_devices)
    throw InvalidParameter("has_devices", 1.0, "",
                           "0: the plant's matrices cannot include devices on the span");
  return with_hardware(modal_plant<Scalar>(conductor.modes, conductor.absorber),
                       conductor.hardware);
}

}  // namespace holdfast
