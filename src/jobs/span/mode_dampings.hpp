#pragma once

#include <complex>
#include <string>
#include <vector>

#include "case/case.hpp"
#include "holdfast/core/axis.hpp"

namespace holdfast::program {

/// How a mode of the conductor is damped, alone and with what is clamped to it.
struct ModeRow {
  double frequency;           ///< Hz, of the bare conductor
  double bare;                ///< ζ
  std::complex<double> root;  ///< s (1/s); NaN where it could not be followed
  double first_order;         ///< ζ by the law of light devices
  double asymptotic;          ///< ζ by Krenk's asymptote, of devices near a support

  double damping() const;  ///< −Re s/|s|; negative: the mode grows
};

/// The modes of a case's conductor from the lowest: with [[device]] of the taut string with all
/// that is clamped to it, otherwise of the case's plant with its absorber. Throws WrongInput for a
/// plant without modes.
/// @param count       at most so many
/// @param controlled  with the computer
std::vector<ModeRow> mode_rows_of(const Case& the_case, int count, bool controlled);

/// Which of the modes grow, of a loop that is unstable; empty otherwise.
std::string growth_text(const Case& the_case, const std::vector<ModeRow>& modes);

/// One dashpot strength at one place: the least damping ratio of some modes, and which has it.
struct PlaceStrength {
  double position;  ///< m from the left support
  double damping;   ///< N s/m
  double ratio;     ///< ζ
  int mode;
};

/// The place–strength chart of a device: the damping of the case's taut string with every device as
/// it is but for one, which has another place and another damping. Throws WrongInput where there is
/// no such device, or a measured one.
/// @param number     of the device, from 1
/// @param positions  m, inside the span
/// @param dampings   N s/m, ≥ 0
/// @param modes      1 … so many count
std::vector<PlaceStrength> place_strength_chart(const Case& the_case, int number,
                                                const Axis& positions, const Axis& dampings,
                                                int modes);

}  // namespace holdfast::program
