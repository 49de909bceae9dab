#pragma once

#include <complex>
#include <string>
#include <vector>

#include "case/case.hpp"

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

}  // namespace holdfast::program
