#pragma once

#include <vector>

#include "case/case.hpp"
#include "report/figures/figure.hpp"

namespace holdfast::program {

/// Figs. 2–13 of Kollár 2022, with the settings that their captions give, and some beyond them.
std::vector<Figure> paper_figures();

/// The same kinds of figure for a case of one's own, with the case's settings.
std::vector<Figure> case_figures(const Case& the_case);

}  // namespace holdfast::program
