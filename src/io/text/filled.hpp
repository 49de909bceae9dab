#pragma once

#include <string>
#include <utility>
#include <vector>

namespace holdfast::program {

/// The text with another one wherever a part stands.
std::string replaced(std::string text, const std::string& part, const std::string& other);

/// What @KEY@ stands for in a text, key by key.
using Values = std::vector<std::pair<std::string, std::string>>;

/// The text with every @KEY@ replaced by its first value, which stays as it is; an unknown KEY
/// stays too.
std::string filled(const std::string& text, const Values& values);

}  // namespace holdfast::program
