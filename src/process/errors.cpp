#include "process/errors.hpp"

#include <cerrno>
#include <system_error>

#include "text/text.hpp"

namespace holdfast::program {

Refusal::Refusal(const std::string& message) : std::runtime_error(one_line(message)) {}

std::string system_words(int error) { return std::generic_category().message(error); }

void refuse_to_read(const std::filesystem::path& path, const std::string& why) {
  throw WrongInput("cannot read " + path.string() + ": " + why);
}

void refuse_to_write(const std::filesystem::path& path, int error) {
  const std::string message = "cannot write " + path.string() + ": " + system_words(error);
  const bool machine = error == ENOSPC || error == EDQUOT || error == EIO || error == EMFILE ||
                       error == ENFILE || error == ENOMEM || error == EFBIG;
  if (machine) throw OutputError(message);
  throw WrongInput(message);
}

}  // namespace holdfast::program
