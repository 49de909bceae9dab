#pragma once

#include <filesystem>
#include <string>

namespace holdfast::program {

/// The whole text of a file. Throws WrongInput, in the system's words, when it cannot be read.
std::string read_input(const std::filesystem::path& file);

}  // namespace holdfast::program
