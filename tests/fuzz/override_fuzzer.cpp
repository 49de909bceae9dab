#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "case/case_file.hpp"
#include "fuzz/require.hpp"
#include "process/errors.hpp"
#include "text/text.hpp"

/// Texts between zeros, which no argument of a program can hold, as --set options in their order.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace holdfast::program;
  const std::string text(reinterpret_cast<const char*>(data), size);
  std::vector<std::string> overrides;
  for (const std::string_view part : split(text, '\0')) overrides.emplace_back(part);
  try {
    const std::string written = case_to_toml(load_case(std::nullopt, overrides));
    holdfast::fuzz::require(written == case_to_toml(load_case_text(written, "again.toml", {})),
                            "a case that was written reads as the same case");
  } catch (const WrongInput& refusal) {
    const std::string line = refusal.what();
    holdfast::fuzz::require(line.find('\n') == std::string::npos, "a refusal is one line");
    holdfast::fuzz::require(line.rfind("again.toml", 0) != 0, "a case that was written is read");
  }
  return 0;
}
