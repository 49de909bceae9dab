#pragma once

#include <filesystem>
#include <functional>

namespace holdfast::program {

/// Makes and opens for writing a file that was not there before, under the first free one of some
/// names: a name left over by a process that was killed and had our number is passed over.
/// @param next_name  a name that it has not given before
/// @return the descriptor, and `file` is its name; or −1, and the reason is in errno
int open_new_file(const std::function<std::filesystem::path()>& next_name,
                  std::filesystem::path& file);

}  // namespace holdfast::program
