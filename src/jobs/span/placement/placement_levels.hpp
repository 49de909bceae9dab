#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "case/case.hpp"
#include "holdfast/core/axis.hpp"
#include "jobs/span/aeolian_amplitudes.hpp"

namespace holdfast::program {

/// Goal of the placement of a device.
enum class PlacementGoal {
  strain,  ///< minimise the largest strain (or f × amplitude) in the wind over a band
  ratio,   ///< maximise the least inverse standing-wave ratio over a band
  modes    ///< maximise the least damping ratio of some modes
};

/// Options of the placement of one device of a case.
struct PlacementQuestion {
  std::size_t device = 0;  ///< number of the device, from 1 on; 0: absorber with its computer
  PlacementGoal goal = PlacementGoal::strain;
  Axis frequencies{5.0, 60.0, 56};    ///< frequencies of the band, Hz
  int first_mode = 1, last_mode = 1;  ///< modes of the goal `modes`
  bool moves_position = true;         ///< whether the position varies
  double margin = 0.5;                ///< modulus margin that gains must keep, 0 … 1
  bool is_absorber() const { return device == 0; }
};

/// Objective values (levels), one per frequency or mode; a placement minimises the largest of them.
class PlacementLevels {
 public:
  /// Prepares the levels. Throws WrongInput where the case lacks what the goal needs.
  PlacementLevels(const Case& the_case, const PlacementQuestion& question);

  /// Levels (> 0) of a variant of the case, one per frequency or mode; smaller is better. Empty if
  /// the span is not statically stable with 1.1 times its negative stiffnesses.
  std::vector<double> of(const Case& variant) const;

  /// Physical value of a level: strain, frequency × amplitude, or ratio; see name() and unit().
  double value_of(double level) const;
  std::string name() const;  ///< name of that value: "largest_strain"
  std::string unit() const;  ///< unit of that value

  /// Frequency (Hz) of the level with index `number` from 0; for a mode, of the bare conductor.
  double frequency_of(std::size_t number) const { return frequencies_[number]; }
  const std::vector<double>& frequencies() const { return frequencies_; }  ///< all of these (Hz)

  /// Note that the vibration at a frequency (Hz) is outside the measured range of the wind law;
  /// empty if it is inside or the goal is not strain.
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
