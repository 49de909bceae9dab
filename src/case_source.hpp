#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "case.hpp"

namespace holdfast::program {

/// Where a case comes from, so that it can be read once more with further values.
struct CaseSource {
  std::optional<std::filesystem::path> file;  // none: the built-in case
  std::vector<std::string> overrides;         // "control.sampling_period=0.002", in their order

  /// The case with further overrides behind the others; a plant that is not given is reduced from
  /// the conductor. Throws what load_case() and settle_plant() throw.
  Case load(const std::vector<std::string>& further) const;
};

}  // namespace holdfast::program
