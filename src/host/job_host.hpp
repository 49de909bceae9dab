#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "host/received_table.hpp"

namespace holdfast::program {

struct CaseSource;

/// Environment of a job that another program runs in its memory, instead of files, standard error
/// and a terminal. It provides the case and receives the job's tables, warnings and progress.
///
///     JobHost host;
///     host.source = std::make_shared<CaseSource>();   // the built-in case
///     const HostScope here(host);
///     do_job({"orbit"});
///     host.tables.front().columns …
struct JobHost {
  /// The host of this thread; null if there is none.
  static JobHost* current() { return innermost; }

  std::shared_ptr<CaseSource> source;  // in place of --case and --set
  std::vector<ReceivedTable> tables;   // results that go to no file
  std::vector<std::string> warnings;
  std::atomic<std::uint64_t> steps_done{0}, steps{0};  // of a job that counts steps; 0: none yet

 private:
  friend class HostScope;
  static inline thread_local JobHost* innermost = nullptr;
};

/// Makes a host the current host of this thread while the object exists; scopes may be nested.
class HostScope {
 public:
  explicit HostScope(JobHost& host) : outer_(JobHost::innermost) { JobHost::innermost = &host; }
  ~HostScope() { JobHost::innermost = outer_; }
  HostScope(const HostScope&) = delete;
  HostScope& operator=(const HostScope&) = delete;

 private:
  JobHost* outer_;
};

}  // namespace holdfast::program
