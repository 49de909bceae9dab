#pragma once

#include <string>

#include "holdfast/ceres/decay_fit_options.hpp"
#include "holdfast/plant/two_mass.hpp"

namespace holdfast::program {

/// A parameter that a fit may free, as the case file names it.
struct FitParameter {
  fit::PlantParameter parameter;
  const char* name;  ///< its key in [plant]
  const char* unit;
};

const FitParameter& description_of(fit::PlantParameter parameter);

/// The question of `--parameters` (keys between commas) and `--target` (history, peak, measures).
/// Throws WrongInput for an unknown, missing or repeated name, or more than the target determines.
fit::DecayFitOptions fit_options(const std::string& parameters, const std::string& target);

/// Parameters are fitted by their logarithms, and all but c2 start from the plant's values: throws
/// WrongInput, naming the key, for one that is 0.
void require_starts(const fit::DecayFitOptions& options, const TwoMass<double>& plant);

}  // namespace holdfast::program
