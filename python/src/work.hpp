#pragma once

#include <nanobind/nanobind.h>

#include <functional>

namespace holdfast::python {

/// Does long work in a thread of its own and without the interpreter's lock, one after the other
/// where several threads ask, while the calling thread looks after signals and calls `watch` about
/// twenty times a second, with the lock. A signal's exception, or that of `watch`, ends the work as
/// soon as it looks at the program's flag, and is thrown then.
/// Throws what the work throws; std::runtime_error in a process that was forked from one that had
/// worked: its threads and locks did not come along; and std::runtime_error at once where a
/// computation is what calls: it would wait for itself.
void do_without_lock(const std::function<void()>& work, const std::function<void()>& watch);

/// Does work in the calling thread, without the interpreter's lock and in its turn as above: a few
/// milliseconds at most, or work that calls Python again and again, which looks after signals then.
/// Throws what the work throws, and likewise in a forked process and from a computation.
void do_here(const std::function<void()>& work);

/// While it lives a computation calls Python in this thread.
class CallsPython {
 public:
  CallsPython();
  ~CallsPython();
  CallsPython(const CallsPython&) = delete;
  CallsPython& operator=(const CallsPython&) = delete;

 private:
  bool outer_;
};

}  // namespace holdfast::python
