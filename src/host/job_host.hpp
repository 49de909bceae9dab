#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "host/received_table.hpp"

namespace holdfast::program {

struct CaseSource;

/// Surroundings of a job that another program runs in its own memory, in place of files, standard
/// error and a terminal: where its case comes from, and what takes its tables, its warnings and how
/// far it is.
///
///     JobHost host;
///     host.source = std::make_shared<CaseSource>();   // the built-in case
///     const HostScope here(host);
///     do_job({"orbit"});
///     host.tables.front().columns …
struct JobHost {
  /// The host of this thread; null where jobs run by themselves.
  static JobHost* current() { return innermost; }

  std::shared_ptr<CaseSource> source;  // in place of --case and --set
  std::vector<ReceivedTable> tables;   // of those that go to no file
  std::vector<std::string> warnings;
  std::atomic<std::uint64_t> steps_done{0}, steps{0};  // of the job that counts them; 0: none yet

 private:
  friend class HostScope;
  static inline thread_local JobHost* innermost = nullptr;
};

/// Makes a host that of the thread while it lives; hosts may be nested.
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
