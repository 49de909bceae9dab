#include "jobs/cable/reduced_cases.hpp"

#include <utility>

#include "case/model/resolved_plant.hpp"

namespace holdfast::program {
namespace {

constexpr std::size_t most_known = 1000;  // a few megabytes

}  // namespace

ReducedCases::ReducedCases(CaseSource source) : source_(std::move(source)) {}

Case ReducedCases::with(const std::vector<std::string>& overrides) const {
  const auto find = [&] {
    const std::lock_guard<std::mutex> guard(mutex_);
    const auto found = known_.find(overrides);
    return found == known_.end() ? std::pair(false, Answer()) : std::pair(true, found->second);
  };
  auto [known, answer] = find();
  if (!known) {
    answer = reduced(overrides);
    const std::lock_guard<std::mutex> guard(mutex_);
    if (known_.size() >= most_known) known_.clear();
    known_.emplace(overrides, answer);
  }
  if (answer.fault) std::rethrow_exception(answer.fault);
  return answer.the_case;
}

ReducedCases::Answer ReducedCases::reduced(const std::vector<std::string>& overrides) const {
  Answer answer;
  try {
    answer.the_case = source_.load(overrides);
    settle_plant(answer.the_case);
  } catch (const std::exception&) {
    answer.fault = std::current_exception();
  }
  return answer;
}

}  // namespace holdfast::program
