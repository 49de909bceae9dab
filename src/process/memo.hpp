#pragma once

#include <cstddef>
#include <map>
#include <mutex>
#include <utility>

namespace holdfast::program {

/// Remembers what was computed of a key, for any thread: what a job, the cells of a sweep or the
/// questions of a report ask for again and again. All is forgotten where more than `most` are
/// known.
template <class Key, class Value>
class Memo {
 public:
  explicit Memo(std::size_t most) : most_(most) {}

  /// The value of a key, by `compute` where it is not known. Threads that ask for one key at once
  /// may compute it each, and all get the first value; what `compute` throws is not remembered.
  template <class Compute>
  Value of(const Key& key, const Compute& compute) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      const auto known = known_.find(key);
      if (known != known_.end()) return known->second;
    }
    Value value = compute();
    const std::lock_guard<std::mutex> lock(mutex_);
    if (known_.size() >= most_) known_.clear();
    return known_.emplace(key, std::move(value)).first->second;
  }

 private:
  std::size_t most_;
  std::mutex mutex_;
  std::map<Key, Value> known_;
};

}  // namespace holdfast::program
