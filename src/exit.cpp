#include "exit.hpp"

#include <chrono>
#include <cstdio>
#include <exception>
#include <holdfast/core/errors.hpp>
#include <new>
#include <thread>

#include "errors.hpp"
#include "interrupt.hpp"
#include "mpi_launch.hpp"
#include "text.hpp"

namespace holdfast::program {
namespace {

int failed(int code, const std::string& message) {
  report_error(message);
  return code;
}

/// Whether the first of the processes that a launcher started together tells of a wrong input that
/// all of them were given. The launcher ends the others when it has, and would end it too if one of
/// them exited before: hence they wait. Where nothing ends them the input is wrong here alone.
bool told_by_first_process() {
  if (mpi_launch().rank == 0) return false;
  const auto patience_ends = std::chrono::steady_clock::now() + std::chrono::seconds(5);
  while (!interrupted() && std::chrono::steady_clock::now() < patience_ends)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  return interrupted();
}

int refused(const std::string& message) {
  if (!told_by_first_process()) report_error(message);
  return exit_code::wrong_input;
}

}  // namespace

void report_error(const std::string& message) {
  const std::string line = "holdfast: " + one_line(message) + "\n";
  std::fwrite(line.data(), 1, line.size(), stderr);
  std::fflush(stderr);
}

void report_warning(const std::string& message, bool quiet) {
  if (!message.empty() && !quiet) report_error("warning: " + message);
}

int run_guarded(const std::function<int()>& work) {
  install_signal_handlers();
  try {
    return work();
  } catch (const ToldElsewhere& told) {
    return told.exit_code();
  } catch (const Interrupted& stopped) {
    return failed(exit_code::interrupted, stopped.what());
  } catch (const WrongInput& error) {
    return refused(error.what());
  } catch (const InvalidParameter& error) {
    return refused(error.what());
  } catch (const NoAnswer& error) {
    return failed(exit_code::no_answer, error.what());
  } catch (const OutputError& error) {
    return failed(exit_code::no_answer, error.what());
  } catch (const std::bad_alloc&) {
    return failed(exit_code::no_answer, "the computation needs more memory than there is");
  } catch (const std::exception& error) {
    return failed(exit_code::no_answer, std::string("unexpected failure: ") + error.what());
  } catch (...) {
    return failed(exit_code::no_answer, "unexpected failure");
  }
}

}  // namespace holdfast::program
