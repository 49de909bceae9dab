#pragma once

#include <string>

namespace holdfast::program {

/// gnuplot's SVG without what no eye sees: its description, indents, blank lines and groups of
/// nothing. Curves go on by steps, those of many places in tenths of a point, and a cloud of dots
/// is one curve.
std::string compact_svg(const std::string& svg);

}  // namespace holdfast::program
