#include "exit.hpp"

#include <cstdio>
#include <exception>
#include <holdfast/core/errors.hpp>
#include <new>

#include "errors.hpp"
#include "interrupt.hpp"
#include "text.hpp"

namespace holdfast::program {
namespace {

int failed(int code, const std::string& message) {
  report_error(message);
  return code;
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
  } catch (const Interrupted& stopped) {
    return failed(exit_code::interrupted, stopped.what());
  } catch (const WrongInput& error) {
    return failed(exit_code::wrong_input, error.what());
  } catch (const InvalidParameter& error) {
    return failed(exit_code::wrong_input, error.what());
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
