#pragma once

#include <complex>
#include <string>
#include <vector>

#include "case/case.hpp"

namespace holdfast::program {

/// Damping of one mode of the conductor, bare and with absorber, controller and devices.
struct ModeRow {
  double frequency;           ///< frequency (Hz) of the bare conductor
  double bare;                ///< damping ratio ζ of the bare conductor
  std::complex<double> root;  ///< eigenvalue s (1/s); NaN where it is not found
  double first_order;         ///< ζ by the approximation for light devices
  double asymptotic;          ///< ζ by Krenk's asymptote for devices near a support

  double damping() const;  ///< −Re s/|s|; negative: the mode grows
};

/// Dampings of the lowest modes of a case's conductor. With [[device]]: modes of the taut string
/// with all devices and the absorber; else of the case's plant with its absorber. Throws WrongInput
/// for a plant without modes.
/// @param count       largest number of modes
/// @param controlled  whether the computer acts
std::vector<ModeRow> mode_rows_of(const Case& the_case, int count, bool controlled);

/// Text that names the growing modes of an unstable loop; empty for a stable loop.
std::string growth_text(const Case& the_case, const std::vector<ModeRow>& modes);

}  // namespace holdfast::program
