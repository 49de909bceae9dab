#pragma once

#include <optional>
#include <string>

#include "job.hpp"
#include "jobs/cable/cable_decay.hpp"

namespace holdfast::program {

/// Options that the jobs about the continuous cable share.
struct CableOptions {
  std::optional<double> duration;
  double interval = 0.001;
  int elements = 100;
  std::string absorber = "weight";
  bool equal_displacement = false;

  /// @param usual_duration  s, where none is given
  /// Throws WrongInput for an interval beyond the duration, or so short that the rows are too many.
  CableDecayOptions question(double force, double usual_duration) const;
};

/// `--elements`, `--absorber`, `--equal-displacement`, `--duration` and `--interval`.
/// @param usual_duration  what the help says of the time where none is given
void add_cable_options(const Job& job, CableOptions& options, const std::string& usual_duration);

/// Where the plant starts (m) beside a cable that a force (N) has displaced: as far as the cable,
/// or where the same force holds it, F/k1.
double plant_start(const JobContext& context, const CableOptions& options, double force,
                   double cable_displacement);

/// The plant's decay from there at the instants of the cable's.
DecayRecord plant_decay(const JobContext& context, double start, const DecayRecord& cable);

}  // namespace holdfast::program
