#pragma once

#include <string>

#include "case/case.hpp"
#include "holdfast/ceres/decay_fit_options.hpp"
#include "holdfast/math/signal/decay_measures.hpp"
#include "holdfast/plant/two_mass.hpp"

namespace holdfast::program {

/// Throws NoAnswer, naming the package to install, in a program built without Ceres Solver.
void require_ceres();

/// Fits a plant to a recorded decay by `fit::fit_decay`. Throws NoAnswer if no initial guess leads
/// to a minimum, and in a program without Ceres Solver.
fit::DecayFit fit_record(const DecayRecord& record, const TwoMass<double>& plant,
                         const fit::DecayFitOptions& options);

/// The usual_decay() of the case's cable in 60 elements, for a fit without measured data.
DecayRecord record_for_fit(const Case& the_case);

/// Fit of the absorber damping c2 (N s/m) of a plant reduced from the conductor.
struct AbsorberDampingFit {
  fit::DecayTarget target;  ///< fitted quantities
  fit::DecayFit fit;        ///< all minima of the fit
  double peak_misfit;       ///< least relative error of first peak and period; NaN: no fit
  double history_misfit;    ///< least error of z over six periods, relative to z(0); NaN: no fit
  /// The least and the largest c2 (N s/m) of all fits: the accepted fit, and the fits of the time
  /// history over 1, 2, 3 and 6 periods.
  double lowest, highest;
};

/// Fits c2 to the first peak and period of the cable's decay if their errors are at most 10 %, else
/// to its time history. Throws NoAnswer if neither determines c2.
AbsorberDampingFit fit_absorber_damping(const Case& the_case, const TwoMass<double>& plant);

/// A warning that no c2 gives the plant the cable's first peak and period; empty otherwise.
std::string misfit_warning(const AbsorberDampingFit& found);

}  // namespace holdfast::program
