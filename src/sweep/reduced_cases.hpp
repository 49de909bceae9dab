#pragma once

#include <future>
#include <map>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "case/case.hpp"
#include "case/case_source.hpp"
#include "case/model/resolved_plant.hpp"

namespace holdfast::program {

/// The variants of a case whose plants differ, each read and reduced once: a reduction takes some
/// tenths of a second, and many cells of a sweep share theirs. Any thread may ask.
class ReducedCases {
 public:
  explicit ReducedCases(CaseSource source) : source_(std::move(source)) {}

  /// The case with further overrides, its plant reduced where it is not given. Throws what
  /// load_case() and settle_plant() throw, each time it is asked.
  Case with(const std::vector<std::string>& overrides) const {
    constexpr std::size_t most_known = 1000;  // a few megabytes
    const auto reduced = [source = source_, overrides] {
      Case the_case = source.load(overrides);
      settle_plant(the_case);
      return the_case;
    };
    std::shared_future<Case> answer;
    {
      const std::lock_guard<std::mutex> guard(mutex_);
      if (known_.size() >= most_known && known_.count(overrides) == 0) known_.clear();
      std::shared_future<Case>& known = known_[overrides];
      if (!known.valid()) known = std::async(std::launch::deferred, reduced).share();
      answer = known;
    }
    return answer.get();
  }

 private:
  CaseSource source_;
  mutable std::mutex mutex_;
  mutable std::map<std::vector<std::string>, std::shared_future<Case>> known_;
};

}  // namespace holdfast::program
