#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace holdfast::program {

/// The whole text of a file. Throws WrongInput, in the system's words, when it cannot be read.
std::string read_input(const std::filesystem::path& file);

/// Throws WrongInput where a result would take the place of a file that it is computed from.
void require_not_overwritten(const std::filesystem::path& input,
                             const std::optional<std::filesystem::path>& output);

}  // namespace holdfast::program
