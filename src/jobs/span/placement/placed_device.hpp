#pragma once

#include <functional>
#include <string>
#include <vector>

#include "case/case.hpp"
#include "holdfast/ceres/device_placement_options.hpp"
#include "jobs/span/placement/placement_levels.hpp"

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

/// Numbers of a passive device that may move: its place, unless the question keeps it, and its
/// strength, of a Stockbridge damper and a measured device none, which are as their makers made
/// them. Throws WrongInput where nothing may.
/// @param lowest, highest  of the band (Hz)
std::vector<MovedNumber> moved_numbers(const Case& the_case, const PlacementQuestion& question,
                                       double lowest, double highest);

/// The case with other values of those numbers.
Case with_values(Case the_case, const std::vector<MovedNumber>& numbers,
                 const std::vector<double>& values);

/// A device where it is best, the others staying as they are.
struct PlacedDevice {
  Case the_case;                     ///< with the device there
  std::vector<MovedNumber> numbers;  ///< what was moved
  placement::Placement found;        ///< their values, in the same order
  double before;  ///< the goal's number of the case as it was; NaN where its loop is not stable
  double after;   ///< and with the answer
  double worst_frequency;  ///< Hz, of the latter
  bool is_better;          ///< than the case as it was
  /// Whether with a spring that pushes the conductor on by a hundredth more it would hardly rest.
  bool is_at_limit_of_rest;
  std::string range_note;  ///< where the laws of the wind end, of its worst vibration; else empty
};

/// Throws NoAnswer, naming the package to install, in a program built without Ceres Solver.
void require_placement_search();

/// Places a device. Gains of the absorber are such that its loop is stable on the string with all
/// devices, at the margin of the question. Throws WrongInput where nothing may move or the case
/// lacks what the goal needs, NoAnswer where no gains have the margin.
PlacedDevice placed_device(const Case& the_case, const PlacementQuestion& question);

/// Warnings of an answer, a sentence each: that nothing better was found, that a value is at the
/// end of what was searched.
std::vector<std::string> placement_warnings(const PlacedDevice& placed,
                                            const PlacementQuestion& question);

}  // namespace holdfast::program
