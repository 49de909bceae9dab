#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "case/case.hpp"
#include "holdfast/core/axis.hpp"
#include "jobs/span/aeolian_amplitudes.hpp"

namespace holdfast::program {

/// Goals of the placement of a device.
enum class PlacementGoal {
  strain,  ///< the least of the largest strains in the wind over a band
  ratio,   ///< the most of the least inverse standing-wave ratios over a band
  modes    ///< the most of the least damping ratios of some modes
};

/// Question about the placement of one device of a case.
struct PlacementQuestion {
  std::size_t device = 0;  ///< its number from 1; 0: the absorber with its computer
  PlacementGoal goal = PlacementGoal::strain;
  Axis frequencies{5.0, 60.0, 56};    ///< Hz, of the band
  int first_mode = 1, last_mode = 1;  ///< of the goal `modes`
  bool moves_position = true;         ///< else it stays where it is
  double margin = 0.5;                ///< modulus margin that gains must keep, 0 … 1
  bool is_absorber() const { return device == 0; }
};

/// Levels that a placement makes small, at each frequency of its band or for each of its modes.
class PlacementLevels {
 public:
  /// Throws WrongInput where the case lacks what the goal needs.
  PlacementLevels(const Case& the_case, const PlacementQuestion& question);

  /// One level (> 0) for each, the same for all variants of the case: the smaller, the better.
  /// Empty where the devices push the conductor away from its rest.
  std::vector<double> of(const Case& variant) const;

  /// The number that a level stands for: a strain, a ratio; and what it is called.
  double value_of(double level) const;
  std::string name() const;  ///< "largest_strain"
  std::string unit() const;  ///< of the value

  /// Hz, of a level by its number; of a mode that of the bare conductor.
  double frequency_of(std::size_t number) const { return frequencies_[number]; }
  const std::vector<double>& frequencies() const { return frequencies_; }  ///< Hz, ascending

  /// That the vibration at a frequency (Hz) is beyond what the law of the wind was measured for;
  /// empty where it is not, or the goal is another.
  std::string range_note(const Case& variant, double frequency) const;

 private:
  std::vector<double> wind_levels(const std::vector<SpanDevice>& devices) const;
  std::vector<double> damping_levels(const Case& variant) const;

  PlacementQuestion question_;
  bool knows_strain_;
  TautString<double> string_;
  std::vector<double> frequencies_;
  std::optional<LargestVibration> wind_;
};

}  // namespace holdfast::program
