#include <cstddef>
#include <cstdint>
#include <string>

#include "case/case_file.hpp"
#include "fuzz/require.hpp"
#include "process/errors.hpp"

/// Any text as a case file: it is refused in one line, or what it says can be written and read
/// again.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace holdfast::program;
  const std::string text(reinterpret_cast<const char*>(data), size);
  try {
    const Case the_case = load_case_text(text, "fuzz.toml", {});
    const std::string written = case_to_toml(the_case);
    const std::string again = case_to_toml(load_case_text(written, "again.toml", {}));
    holdfast::fuzz::require(written == again, "a case that was written reads as the same case");
  } catch (const WrongInput& refusal) {
    const std::string line = refusal.what();
    holdfast::fuzz::require(line.rfind("fuzz.toml:", 0) == 0, "a refusal names the file and line");
    holdfast::fuzz::require(line.find('\n') == std::string::npos, "a refusal is one line");
  }
  return 0;
}
