#pragma once

#include <string>
#include <vector>

#include "case/case.hpp"

namespace holdfast::program {

/// Question about a case: a job with options. Each option is listed by its name ("--prove") and, if
/// it has a value, also with the value ("--switching exact").
struct Asked {
  std::string job;
  std::vector<std::string> options;

  /// Whether the question has the job and all options of a text such as "margins --prove".
  bool has(const std::string& words) const;
};

/// Result of the rules of texts/support.toml for a question about a case.
struct Support {
  std::string refusal;     ///< why the question is refused; empty: it is answered
  std::string idealised;   ///< what the answer leaves out; empty: nothing
  std::string reason;      ///< reason of the refusal alone, without job and feature
  std::string refused_by;  ///< feature that the job refuses with any options; else empty
};

/// Support of a question. @param the_case  case, whose plant need not be computed yet
Support support_of(const Case& the_case, const Asked& asked);

/// Cell of the support table: a question about a case with some features.
struct SupportCell {
  std::string question;               ///< question in an example: "margins --prove"
  std::vector<std::string> features;  ///< descriptions of the features
  std::vector<std::string> settings;  ///< settings KEY=VALUE by which a case has the features
  bool can_be_asked;                  ///< whether a command line can give the features
  Support support;
};

/// Cells of docs/support.md, with one feature each, for two masses and for plant.model = "string";
/// grouped by question, with the features in a fixed order.
std::vector<SupportCell> support_cells();

/// Cells of all possible pairs of features, with two masses unless a feature is another plant.
std::vector<SupportCell> support_pairs();

/// Text of docs/support.md.
std::string support_page();

}  // namespace holdfast::program
