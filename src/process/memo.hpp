#pragma once

#include <cstddef>
#include <map>
#include <mutex>
#include <utility>

namespace holdfast::program {

/// Cache of values computed by key, for concurrent threads: the cells of a sweep or the parts of a
/// report need equal values repeatedly. When `most` values are stored, a new one clears the cache.
template <class Key, class Value>
class Memo {
 public:
  explicit Memo(std::size_t most) : most_(most) {}

  /// The value of a key, computed by `compute` if it is not stored. Threads with an equal key may
  /// compute it at once; all get the value stored first. Exceptions of `compute` are not stored.
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
