#pragma once

#include <string>

#include "cable_decay.hpp"
#include "job.hpp"

namespace holdfast::program {

/// Options that the jobs about the continuous cable share.
struct CableOptions {
  double duration = 10.0;
  double interval = 0.001;
  int elements = 100;
  std::string absorber = "weight";
  bool equal_displacement = false;

  CableDecayQuestion question(double force) const;
};

/// `--elements`, `--absorber`, `--equal-displacement`, `--duration` and `--interval`.
void add_cable_options(const Job& job, CableOptions& options);

/// Where the plant starts (m) beside a cable that a force (N) has displaced: as far as the cable,
/// or where the same force holds it, F/k1.
double plant_start(const JobContext& context, const CableOptions& options, double force,
                   double cable_displacement);

/// The plant's decay from there at the instants of the cable's.
DecayRecord plant_decay(const JobContext& context, double start, const DecayRecord& cable);

}  // namespace holdfast::program
