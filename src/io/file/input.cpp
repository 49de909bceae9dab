#include "io/file/input.hpp"

#include <cerrno>
#include <cstdio>
#include <memory>
#include <system_error>
#include <vector>

#include "process/errors.hpp"
#include "process/interrupt.hpp"

namespace holdfast::program {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& why) {
  throw WrongInput("cannot read " + file.string() + ": " + why);
}

}  // namespace

std::string read_input(const std::filesystem::path& file) {
  constexpr std::size_t largest = std::size_t{1} << 31;  // an endless device shall end
  using Handle = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;
  const Handle handle(std::fopen(file.c_str(), "rb"), &std::fclose);
  if (!handle) refuse(file, std::generic_category().message(errno));
  std::string text;
  std::vector<char> chunk(std::size_t{1} << 16);
  while (const std::size_t count = std::fread(chunk.data(), 1, chunk.size(), handle.get())) {
    text.append(chunk.data(), count);
    throw_if_interrupted();
    if (text.size() > largest) refuse(file, "too large");
  }
  if (std::ferror(handle.get()) != 0) refuse(file, std::generic_category().message(errno));
  return text;
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
