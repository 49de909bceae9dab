#pragma once

#include <string>
#include <vector>

namespace holdfast::program {

/// The arguments of both, one after the other.
std::vector<std::string> joined(std::vector<std::string> first,
                                const std::vector<std::string>& second);

/// gnuplot's commands for the labels of both axes. Blanks beside a change of font are lost in SVG
/// unless they do not break.
std::string axes(const std::string& x, const std::string& y);

}  // namespace holdfast::program
