#pragma once

#include <csignal>
#include <exception>

namespace holdfast::program {

/// Request to end the program by the user (SIGINT, SIGHUP) or the system (SIGTERM): exit code 130.
class Interrupted : public std::exception {
 public:
  const char* what() const noexcept override { return "interrupted"; }
};

/// Installs the signal handlers; call in the thread that writes results. That thread takes all
/// signals; other threads pass theirs on to it. SIGINT, SIGTERM and SIGHUP (a closed terminal) set
/// a flag. A closed pipe, or a file beyond the size limit of the system, becomes an error of
/// write(). The program ends at once after a second signal, or if a computation, for example in a
/// library, has not checked the flag for three seconds. Unfinished files are removed in every case.
void install_signal_handlers();

/// Removes the files named by RemovedBySignal. May be called in a signal handler.
void remove_unfinished_files();

/// Restores the default action of ignored signals; for a child that will become another program.
void restore_signals_of_child();

/// Whether a signal or request_stop() came. A long loop checks this, or throw_if_interrupted().
bool interrupted();

/// Throws Interrupted if interrupted().
void throw_if_interrupted();

/// Asks the computation to end as after a signal; forget_asking() withdraws the request.
void request_stop();
void forget_asking();

/// Clears the flag of a received signal, so that a test can raise one.
void clear_interrupt();

/// Blocks the signals that end the program while the object exists; they arrive when it is
/// destroyed. For a few steps of which either all or none must be done; in the thread of signals.
class SignalsHeld {
 public:
  SignalsHeld();
  ~SignalsHeld();
  SignalsHeld(const SignalsHeld&) = delete;
  SignalsHeld& operator=(const SignalsHeld&) = delete;

 private:
  sigset_t before_ = {};
};

/// Registers a file, while the object exists, for removal if a signal ends the program at once.
/// Without effect beyond eight files at a time, or for a path of 4096 bytes or more.
class RemovedBySignal {
 public:
  explicit RemovedBySignal(const char* path);
  ~RemovedBySignal();
  RemovedBySignal(const RemovedBySignal&) = delete;
  RemovedBySignal& operator=(const RemovedBySignal&) = delete;

 private:
  int slot_ = -1;
};

}  // namespace holdfast::program
