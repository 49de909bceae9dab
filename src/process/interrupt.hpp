#pragma once

#include <csignal>
#include <exception>

namespace holdfast::program {

/// The user (SIGINT, SIGHUP) or the system (SIGTERM) asked the program to end: exit code 130.
class Interrupted : public std::exception {
 public:
  const char* what() const noexcept override { return "interrupted"; }
};

/// To be called by the thread that writes results, which takes all signals; the others hand theirs
/// on to it. From here on SIGINT, SIGTERM and SIGHUP (a closed terminal) set a flag, and a closed
/// pipe or a file beyond the size that the system allows is an error that write() reports. A second
/// signal ends the program at once, and so do three seconds in which a computation has not looked
/// at the flag, as a library's cannot; unfinished files are removed even then.
void install_signal_handlers();

/// Removes what RemovedBySignal names, for an end without any further step. A signal handler may.
void remove_unfinished_files();

/// For a child process before it becomes another program, which would keep ignoring what this one
/// ignores.
void restore_signals_of_child();

/// Whether a signal has come. A long loop asks, or calls throw_if_interrupted().
bool interrupted();

/// Throws Interrupted when a signal has come.
void throw_if_interrupted();

/// Asks the computation to end as a signal does, without one; and takes that back.
void request_stop();
void forget_asking();

/// Forgets a signal that came, so that tests can raise one.
void clear_interrupt();

/// Holds back what asks the program to end, while the object lives, in the thread that takes the
/// signals: they are seen when it goes. For a few steps of which none or all shall be done.
class SignalsHeld {
 public:
  SignalsHeld();
  ~SignalsHeld();
  SignalsHeld(const SignalsHeld&) = delete;
  SignalsHeld& operator=(const SignalsHeld&) = delete;

 private:
  sigset_t before_ = {};
};

/// Names a file that a second signal shall remove, while the object lives. Beyond a fixed number
/// of files at once, and for paths of 4096 bytes or more, it does nothing.
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
