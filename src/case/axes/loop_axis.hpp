#pragma once

#include <string>
#include <vector>

#include "case/axes/grid.hpp"
#include "case/case.hpp"
#include "holdfast/stability/chart/loop_chart.hpp"

namespace holdfast::program {

/// A chart over two keys of the case, for the library and for the table.
struct CaseChart {
  LoopChart chart;
  GridAxis slow;
  GridAxis fast;
};

/// The chart of two --axis options, the first slowest. A sampling period on an axis takes the
/// processing delay with it in proportion; a tuned P stays that of the case.
/// Throws WrongInput unless there are two axes with different keys of [control] or [plant] and
/// admissible values, and InvalidParameter where a corner is no admissible loop.
CaseChart loop_chart_of(const Case& the_case, const std::vector<std::string>& axes);

}  // namespace holdfast::program
