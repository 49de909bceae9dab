#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "case/case.hpp"

namespace holdfast::program {

/// Source of a case, to be read once more with further values.
struct CaseSource {
  std::optional<std::string> text;     // of the case file; none: the built-in case
  std::string name;                    // of that file, for messages
  std::vector<std::string> overrides;  // "control.sampling_period=0.002", in their order

  std::shared_ptr<const RecordedForce> force_record;  // every case that is loaded gets it

  std::shared_ptr<const OwnParts> own;  // likewise

  // The impedances of measured devices, by their files.
  std::map<std::string, std::shared_ptr<const ImpedanceTable>> tables;

  /// Reads the recorded force that the case names, if it names one, and the impedances of its
  /// measured devices, for it and for those to be loaded. Throws what read_force_record() and
  /// read_impedance_table() throw.
  void attach_record(Case& the_case);

  /// The case with further overrides behind the others; its plant is not reduced yet.
  /// Throws what load_case() throws, and for a measured device of another file what
  /// read_impedance_table() throws.
  Case load(const std::vector<std::string>& further = {}) const;

 private:
  void attach_tables(Case& the_case) const;
};

/// Doubt about a recorded force that begins after 0, has a gap or has rows hundreds of sampling
/// periods apart, as where its time is in ms; empty of any other.
std::string record_doubt(const Case& the_case);

}  // namespace holdfast::program
