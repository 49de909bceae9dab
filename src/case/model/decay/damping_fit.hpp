#pragma once

#include <string>

#include "case/case.hpp"
#include "holdfast/ceres/decay_fit_options.hpp"
#include "holdfast/math/signal/decay_measures.hpp"
#include "holdfast/plant/two_mass.hpp"

namespace holdfast::program {

/// Throws NoAnswer, naming the package to install, in a program built without Ceres Solver.
void require_ceres();

/// `fit::fit_decay`; throws what require_ceres() throws, and NoAnswer where no start led to a
/// minimum.
fit::DecayFit fit_record(const DecayRecord& record, const TwoMass<double>& plant,
                         const fit::DecayFitOptions& options);

/// The usual decay of the case's continuous cable, which a fit without data reads.
DecayRecord record_for_fit(const Case& the_case);

/// c2 of a plant reduced from the conductor, and how sure it is.
struct AbsorberDampingFit {
  fit::DecayTarget target;  ///< what was met
  fit::DecayFit fit;        ///< all minima
  double peak_misfit;       ///< what c2 misses of peak and period at best, relative; NaN: no peak
  double history_misfit;    ///< and of the time history over six periods, of z(0); NaN likewise
  /// The least and the largest c2 (N s/m) over all readings of that decay: first peak and period,
  /// and the time history over 1, 2, 3 and 6 periods.
  double lowest, highest;
};

/// Fits c2 to the first peak and the period of that decay where the plant meets them to a tenth,
/// else to its time history. Throws NoAnswer where neither determines it.
AbsorberDampingFit fit_absorber_damping(const Case& the_case, const TwoMass<double>& plant);

/// Warning where the plant's decay is not the cable's, whose first peak and period it cannot meet.
/// Empty otherwise.
std::string misfit_warning(const AbsorberDampingFit& found);

}  // namespace holdfast::program
