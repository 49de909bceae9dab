#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "holdfast/core/compiler.hpp"

namespace holdfast {

/// The safe border line of CIGRE Study Committee 22, Working Group 04 (Electra 63, 1979): a lower
/// bound on the fatigue life N (cycles) of a conductor at its clamps, below all measured failures.
///
///     σ = A N^{−α} up to N₀ cycles,  σ = B N^{−β} beyond     (σ in MPa, zero to peak)
///
/// At N₀ the stress σ jumps from A N₀^{−α} down to B N₀^{−β}. For a stress between these two values
/// N is the smaller of (A/σ)^{1/α} and (B/σ)^{1/β}.
struct SafeBorderLine {
  double steep_stress;     ///< factor A (MPa) of the steep branch
  double steep_exponent;   ///< exponent α of the steep branch
  double flat_stress;      ///< factor B (MPa) of the flat branch
  double flat_exponent;    ///< exponent β of the flat branch
  double change_of_slope;  ///< number N₀ of cycles at which the flat branch begins

  /// The fatigue life N (cycles) at a stress amplitude σ (Pa); infinity for σ = 0, NaN for σ < 0.
  double cycles(double stress) const {
    const double megapascal = stress / 1e6;
    if (!(megapascal > 0.0))
      return megapascal == 0.0 ? std::numeric_limits<double>::infinity() : std::nan("");
    const double steep = std::pow(megapascal / steep_stress, -1.0 / steep_exponent);
    const double flat = std::pow(megapascal / flat_stress, -1.0 / flat_exponent);
    if (steep <= change_of_slope) return steep;
    return flat >= change_of_slope ? flat : std::min(steep, flat);
  }
};

/// The safe border line of conductors with several layers of aluminium wires.
inline constexpr SafeBorderLine several_layers{450.0, 0.20, 263.0, 0.17, 1.56e7};
/// The safe border line of conductors with a single layer of aluminium wires.
inline constexpr SafeBorderLine single_layer{730.0, 0.20, 430.0, 0.17, 2.0e7};

}  // namespace holdfast
