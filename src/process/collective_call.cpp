#include "process/collective_call.hpp"

#include <exception>
#include <string>
#include <vector>

#include "process/errors.hpp"
#include "process/exit.hpp"

namespace holdfast::program {

void make_collective_call(ProcessGroup& group, const std::function<void()>& step) {
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
