#pragma once

#include <string>
#include <vector>

namespace holdfast::program {

/// A place in a drawing in hundredths of a point.
struct SvgPlace {
  long x = 0, y = 0;
  bool begins = false;  ///< the pen goes there without drawing
};

/// The places of a curve as gnuplot writes it, "M60.45,278.47 L70.20,278.47 …"; none where it has
/// other commands.
std::vector<SvgPlace> places_of_curve(const std::string& curve);

/// The place in "60.45,278.47", alone; none where that is no place.
std::vector<SvgPlace> place_of(const std::string& pair);

/// A curve through places by steps, which are shorter than places; those of no length are left out.
/// The places of a long curve are rounded to tenths of a point.
std::string curve_by_steps(const std::vector<SvgPlace>& places);

/// A curve that has a part of no length at each place, in tenths of a point, which ends that are
/// round make a dot of.
std::string dots_by_steps(const std::vector<SvgPlace>& places);

}  // namespace holdfast::program
