#pragma once

#include <string>
#include <vector>

#include "case/case.hpp"

namespace holdfast::program {

/// Question about a case: a job with the options that it was given, "--prove", and each with its
/// value too, "--switching exact".
struct Asked {
  std::string job;
  std::vector<std::string> options;

  /// Whether all words of "margins --prove" are asked: the job first, then options.
  bool has(const std::string& words) const;
};

/// Answer of texts/support.toml to a question about a case.
struct Support {
  std::string refusal;     ///< why it is not answered; empty where it is
  std::string idealised;   ///< what the answer leaves out, a sentence each; empty: nothing
  std::string reason;      ///< of either, without what it is of
  std::string refused_by;  ///< what alone the job as a whole refuses, by its name in the rules
};

/// @param the_case  of which no plant need be settled
Support support_of(const Case& the_case, const Asked& asked);

/// A question of the table about a case with some of its features.
struct SupportCell {
  std::string question;               ///< with small numbers: "margins --prove"
  std::vector<std::string> features;  ///< in words
  std::vector<std::string> settings;  ///< "KEY=VALUE" that give it the features
  bool can_be_asked;                  ///< whether a command line can
  Support support;
};

/// The cells of the page, of one feature on two masses and on plant.model = "string", a question's
/// together, the features in one order.
std::vector<SupportCell> support_cells();

/// The cells of all pairs of features that one case can have, on two masses where neither is
/// another plant.
std::vector<SupportCell> support_pairs();

/// docs/support.md.
std::string support_page();

}  // namespace holdfast::program
