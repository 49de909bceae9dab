#pragma once

#include <vector>

#include "case/case.hpp"
#include "report/figures/figure.hpp"

namespace holdfast::program {

/// Figs. 2–13 of Kollár 2022, with the settings that their captions give, and some beyond them.
std::vector<Figure> paper_figures();

/// The same kinds of figure for a case of one's own, with the case's settings.
std::vector<Figure> case_figures(const Case& the_case);

/// For which delays, backlashes and frequencies control still helps: maps by the job sweep, around
/// the case's frequency of excitation (with [wind]: of its vortices).
///
/// The ranges follow the case: f the frequency, the sampling periods are fractions of 1/f but not
/// shorter than the processing delay, the backlash goes up to where it would swallow the whole
/// motion without control, the durations are numbers of forcing periods.
std::vector<Figure> success_figures(const Case& the_case);

/// The same for the built-in case, with what there is to see in them.
std::vector<Figure> paper_success_figures();

}  // namespace holdfast::program
