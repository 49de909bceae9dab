#include "io/file/input.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <vector>

#include "io/file/descriptor.hpp"
#include "process/errors.hpp"
#include "process/interrupt.hpp"
#include "process/system_words.hpp"

namespace holdfast::program {
namespace {

/// A pipe waits here for its writer, until a signal comes.
Descriptor open_to_read(const std::filesystem::path& file) {
  for (;;) {
    Descriptor opened(open(file.c_str(), O_RDONLY | O_CLOEXEC));
    if (opened.is_open()) return opened;
    if (errno != EINTR) refuse_to_read(file, system_words(errno));
    throw_if_interrupted();
  }
}

}  // namespace

std::string read_input(const std::filesystem::path& file) {
  constexpr std::size_t largest = std::size_t{1} << 31;  // an endless device shall end
  const Descriptor opened = open_to_read(file);
  std::string text;
  std::vector<char> chunk(std::size_t{1} << 16);
  for (;;) {
    const ssize_t count = ::read(opened.number(), chunk.data(), chunk.size());
    if (count == 0) return text;
    if (count < 0 && errno != EINTR) refuse_to_read(file, system_words(errno));
    throw_if_interrupted();
    if (count > 0) text.append(chunk.data(), static_cast<std::size_t>(count));
    if (text.size() > largest) refuse_to_read(file, "too large");
  }
}

void require_not_overwritten(const std::filesystem::path& input,
                             const std::optional<std::filesystem::path>& output) {
  std::error_code ignored;
  const bool same = output && *output != "-" &&
                    std::filesystem::is_regular_file(*output, ignored) &&
                    std::filesystem::equivalent(input, *output, ignored);
  if (same)
    throw WrongInput("--output " + output->string() +
                     ": the job reads this file, and its result would take the place of it");
}

}  // namespace holdfast::program
