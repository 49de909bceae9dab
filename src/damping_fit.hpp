#pragma once

#include "case.hpp"
#include "holdfast/cable/decay_measures.hpp"
#include "holdfast/ceres/decay_question.hpp"
#include "holdfast/plant/two_dof.hpp"

namespace holdfast::program {

/// Throws NoAnswer, naming the package to install, in a program built without Ceres Solver.
void require_ceres();

/// `fit::fit_decay`; throws what require_ceres() throws, and NoAnswer where no start led to a
/// minimum.
fit::DecayFit fit_record(const DecayRecord& record, const TwoDof<double>& plant,
                         const fit::DecayQuestion& question);

/// The decay of the case's continuous cable that a fit without data reads: 0.2 N (or, for a
/// heavier absorber, an eighth of its weight) removed, six periods of the first frequency.
DecayRecord record_for_fit(const Case& the_case);

/// c2 of a plant reduced from the conductor, all minima: fitted to the first peak and the period of
/// that decay, or to its time history where the cable's motion has no such peaks.
fit::DecayFit fit_absorber_damping(const Case& the_case, const TwoDof<double>& plant);

/// Completes a case whose plant is not given: reduces it from the conductor and fits c2.
/// Throws NoAnswer where there is no such plant, or a package is missing.
void settle_plant(Case& the_case);

}  // namespace holdfast::program
