#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "case/case.hpp"

namespace holdfast::program {

/// File text and overrides of a case, from which it can be loaded again with further overrides.
struct CaseSource {
  std::optional<std::string> text;     // of the case file; none: the built-in case
  std::string name;                    // of that file, for messages
  std::vector<std::string> overrides;  // "control.sampling_period=0.002", in their order

  std::shared_ptr<const RecordedForce> force_record;  // recorded force, passed to every loaded case

  std::shared_ptr<const OwnParts> own;  // user-defined parts, passed to every loaded case

  // Impedance tables of measured devices, by file name.
  std::map<std::string, std::shared_ptr<const ImpedanceTable>> tables;

  /// Reads excitation.record, if given, and the impedance tables of measured devices, for this case
  /// and every case loaded later. Throws what read_force_record() and read_impedance_table() throw.
  void attach_record(Case& the_case);

  /// Loads the case with further overrides after its own; the plant is not reduced yet. Throws what
  /// load_case(), require_consistent() and, for a new impedance file, read_impedance_table() throw.
  Case load(const std::vector<std::string>& further = {}) const;

 private:
  void attach_tables(Case& the_case) const;
};

/// Doubt about a recorded force that begins after 0, has a gap, or has rows more than 300 sampling
/// periods apart (perhaps with times in ms); empty otherwise.
std::string record_doubt(const Case& the_case);

}  // namespace holdfast::program
