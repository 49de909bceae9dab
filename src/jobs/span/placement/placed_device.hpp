#pragma once

#include <functional>
#include <string>
#include <vector>

#include "case/case.hpp"
#include "holdfast/ceres/device_placement_options.hpp"
#include "jobs/span/placement/placement_levels.hpp"

namespace holdfast::program {

/// Number that a placement varies: a gain, distance from a support, or |strength| of a device.
struct MovedNumber {
  std::string quantity;                    ///< name of the number: "damping"
  std::string unit;                        ///< unit of the number
  placement::MovableValue value;           ///< its bounds and current value
  std::function<void(Case&, double)> put;  ///< sets the number in a case
  double sign = 1.0;                       ///< the case's number is sign × value
};

/// Numbers of a passive device that a placement varies: its position, unless the question keeps it,
/// and its strength. The maker fixes the strength of a Stockbridge damper or measured device.
/// Throws WrongInput where nothing can vary.
/// @param lowest, highest  frequencies of the band (Hz)
std::vector<MovedNumber> moved_numbers(const Case& the_case, const PlacementQuestion& question,
                                       double lowest, double highest);

/// Case with new values of the varied numbers.
Case with_values(Case the_case, const std::vector<MovedNumber>& numbers,
                 const std::vector<double>& values);

/// Result of the placement of one device, the other devices unchanged.
struct PlacedDevice {
  Case the_case;                     ///< case with the best values
  std::vector<MovedNumber> numbers;  ///< the varied numbers
  placement::Placement found;        ///< best values, in the order of `numbers`
  double before;           ///< goal with the case's own values; NaN where the loop is unstable
  double after;            ///< goal with the best values
  double worst_frequency;  ///< frequency (Hz) of the worst level, with the best values
  bool is_better;          ///< whether `after` is better than `before`
  /// Whether 1 % more negative stiffness would violate the 10 % reserve against static instability.
  bool is_at_limit_of_rest;
  std::string range_note;  ///< note if the worst vibration is outside the wind law's range
};

/// Throws NoAnswer, naming the package to install, in a program built without Ceres Solver.
void require_placement_search();

/// Finds the best values of one device. An absorber's gains keep its loop stable on the string with
/// all devices, with the question's modulus margin. Throws WrongInput where nothing can vary or the
/// case lacks data for the goal, NoAnswer where no gains have the margin.
PlacedDevice placed_device(const Case& the_case, const PlacementQuestion& question);

/// Warnings about a placement, a sentence each: no improvement, a value at a search bound, ….
std::vector<std::string> placement_warnings(const PlacedDevice& placed,
                                            const PlacementQuestion& question);

}  // namespace holdfast::program
