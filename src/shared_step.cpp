#include "shared_step.hpp"

#include <exception>
#include <string>
#include <vector>

#include "errors.hpp"
#include "exit.hpp"
#include "holdfast/core/errors.hpp"
#include "interrupt.hpp"

namespace holdfast::program {
namespace {

int exit_code_of(const std::exception_ptr& fault) {
  try {
    std::rethrow_exception(fault);
  } catch (const Interrupted&) {
    return exit_code::interrupted;
  } catch (const WrongInput&) {
    return exit_code::wrong_input;
  } catch (const InvalidParameter&) {
    return exit_code::wrong_input;
  } catch (...) {
    return exit_code::no_answer;
  }
}

}  // namespace

void take_shared_step(ProcessGroup& group, const std::function<void()>& step) {
  std::exception_ptr fault;
  try {
    step();
  } catch (...) {
    fault = std::current_exception();
  }
  const std::vector<std::string> codes =
      group.exchange(fault ? std::to_string(exit_code_of(fault)) : "");
  if (fault) std::rethrow_exception(fault);
  for (const std::string& code : codes)
    if (!code.empty()) throw ToldElsewhere(std::stoi(code));
}

}  // namespace holdfast::program
