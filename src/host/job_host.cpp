#include "host/job_host.hpp"

namespace holdfast::program {
namespace {

thread_local JobHost* innermost = nullptr;

}  // namespace

JobHost* JobHost::current() { return innermost; }

HostedHere::HostedHere(JobHost& host) : outer_(innermost) { innermost = &host; }
HostedHere::~HostedHere() { innermost = outer_; }

}  // namespace holdfast::program
