#include "report/page/command_line.hpp"

#include "io/text/filled.hpp"

namespace holdfast::program {
namespace {

bool is_plain(const std::string& argument) {
  constexpr const char* plain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_=.,:/+@%";
  return !argument.empty() && argument.find_first_not_of(plain) == std::string::npos;
}

std::string quoted(const std::string& argument) {
  return "'" + replaced(argument, "'", "'\\''") + "'";
}

}  // namespace

std::vector<std::string> command_of(const std::vector<std::string>& arguments,
                                    const std::vector<std::string>& case_arguments) {
  std::vector<std::string> command = {arguments.front()};
  command.insert(command.end(), case_arguments.begin(), case_arguments.end());
  command.insert(command.end(), arguments.begin() + 1, arguments.end());
  return command;
}

std::string shell_text(const std::vector<std::string>& arguments,
                       const std::vector<std::string>& case_arguments) {
  std::string text = "holdfast";
  for (const std::string& argument : command_of(arguments, case_arguments))
    text += " " + (is_plain(argument) ? argument : quoted(argument));
  return text;
}

}  // namespace holdfast::program
