#pragma once

#include <exception>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "case/case.hpp"
#include "case/case_source.hpp"

namespace holdfast::program {

/// The variants of a case whose plants differ, each read and reduced once: a reduction takes some
/// tenths of a second, and many cells of a sweep share theirs. Any thread may ask.
class ReducedCases {
 public:
  explicit ReducedCases(CaseSource source);

  /// The case with further overrides, its plant reduced where it is not given. Throws what
  /// load_case() and settle_plant() throw, each time it is asked.
  Case with(const std::vector<std::string>& overrides) const;

 private:
  struct Answer {
    Case the_case;
    std::exception_ptr fault;  // in its place
  };
  Answer reduced(const std::vector<std::string>& overrides) const;

  CaseSource source_;
  mutable std::mutex mutex_;
  mutable std::map<std::vector<std::string>, Answer> known_;
};

}  // namespace holdfast::program
