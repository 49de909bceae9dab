#pragma once

#include <string_view>

namespace holdfast::program {

/// Text of data/kollar2022.toml, the case that stands where no file is given. Its definition is
/// generated from that file when the program is built.
extern const std::string_view builtin_case_text;

}  // namespace holdfast::program
