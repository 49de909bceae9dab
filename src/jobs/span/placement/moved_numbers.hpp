#pragma once

#include <functional>
#include <string>
#include <vector>

#include "case/case.hpp"
#include "holdfast/ceres/device_placement_options.hpp"
#include "jobs/span/placement/placement_question.hpp"

namespace holdfast::program {

/// One number of a case that a placement moves, by its modulus where it has a sign.
struct MovedNumber {
  std::string quantity;                    ///< "damping"
  std::string unit;                        ///< of the quantity
  placement::MovableValue value;           ///< its bounds, and where it stands
  std::function<void(Case&, double)> put;  ///< gives a case another one
  double sign = 1.0;                       ///< of the case's number over the value
};

/// Where a device may be: its distance from the nearer support, from 0.2 m, or 0.002 of a short
/// span, to a quarter of the longest wave of the band or a tenth of the span, and where it is now.
/// @param shortest, longest  waves of the band (m)
MovedNumber moved_position(const Case& the_case, const PlacementQuestion& question, double shortest,
                           double longest);

/// What of a passive device may move: its place, unless the question keeps it, and its strength, of
/// a Stockbridge damper and a measured device none, which are as their makers made them. Throws
/// WrongInput where nothing may.
/// @param lowest, highest  of the band (Hz)
std::vector<MovedNumber> moved_numbers(const Case& the_case, const PlacementQuestion& question,
                                       double lowest, double highest);

/// The case with other values of those numbers.
Case with_values(Case the_case, const std::vector<MovedNumber>& numbers,
                 const std::vector<double>& values);

}  // namespace holdfast::program
